#include "app/gui/dialogs/new_solid_dialog.h"

#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <utility>

#include "app/core/session/new_project.h"
#include "app/gui/base/appearance.h"
#include "app/gui/dialogs/primitive_kinds.h"
#include "modeling/body/body.h"
#include "modeling/error.h"
#include "modeling/shapes/make_primitive.h"
#include "modeling/shapes/outer_size.h"
#include "modeling/shapes/shape_parameters.h"

namespace palpa::gui {
namespace {

constexpr int kRowsOfAllShapes = 2;  // degree and control points, below the shape's lengths
constexpr int kKindsWidth = 160;     // px, of the list of shapes
constexpr int kSizeWidth = 84;       // px, of a field that shows five digits with a unit

/// Prevents a line break before the unit.
QString unbroken(QString length) {
  return length.replace(' ', QChar::Nbsp);
}

}  // namespace

NewSolidDialog::NewSolidDialog(Settings& settings,
                               const std::optional<modeling::Primitive>& present, QWidget* parent)
    : QDialog(parent),
      settings_(settings),
      kinds_(new QListWidget(this)),
      degree_(new QSpinBox(this)),
      controlPoints_(new QSpinBox(this)),
      preview_(new ShapePreview(
          tr("These sizes give no solid.\nThe picture shows the last that did."), this)),
      facts_(new QLabel(this)),
      problem_(new QLabel(this)),
      fit_(this) {
  setObjectName("new solid");
  setWindowTitle(present ? tr("Edit primitive") : tr("New solid"));
  addWidgets(present.has_value());
  connect(&fit_, &FitMeasurement::measured, this, [this](double deviation) {
    const auto [low, high] = modeling::boundingBox(modeling::makePrimitive(primitive_));
    facts_->setText(expected_ + (deviation <= 1e-12 * (high - low).norm()
                                     ? tr("The patches are exactly the shape.")
                                     : tr("The patches are within %1 of the exact shape.")
                                           .arg(unbroken(shown(deviation, Quantity::kLength,
                                                               settings_.units(), 2)))));
  });
  // Kinds are listed in the order of the variant.
  std::size_t first = 1;
  if (present) {
    for (first = 0; first < primitiveKinds().size(); ++first)
      if (primitiveKinds()[first].primitive.shape.index() == present->shape.index()) break;
    primitive_ = *present;
  }
  kinds_->setCurrentRow(static_cast<int>(first));
  if (present) {
    primitive_ = *present;
    showKind(static_cast<int>(first));
  }
  connect(kinds_, &QListWidget::currentRowChanged, this, [this](int row) {
    primitive_ = primitiveKind(row).primitive;
    primitive_.degree = degree_->value();
    preview_->lookAgain();
    showKind(row);
  });
  if (!present) {
    primitive_ = primitiveKind(kinds_->currentRow()).primitive;
    showKind(kinds_->currentRow());
  }
}

void NewSolidDialog::addWidgets(bool isPresent) {
  kinds_->setObjectName("shapes");
  kinds_->setAccessibleName(tr("Shapes"));
  for (const PrimitiveKind& kind : primitiveKinds())
    kinds_->addItem(new QListWidgetItem(icon(kind.icon), kind.title));
  kinds_->setIconSize({22, 22});
  kinds_->setFixedWidth(kKindsWidth);
  kinds_->setVisible(!isPresent);
  degree_->setObjectName("degree");
  degree_->setRange(1, 5);
  degree_->setValue(3);
  controlPoints_->setObjectName("control points");
  controlPoints_->setRange(0, modeling::kMaxControlPoints);
  controlPoints_->setSpecialValueText(tr("automatic"));
  controlPoints_->setToolTip(tr("Per direction and patch; more can be added later with knots"));
  preview_->setMinimumSize(220, 240);
  problem_->setObjectName("problem");
  problem_->setWordWrap(true);
  facts_->setObjectName("facts");
  facts_->setWordWrap(true);

  auto* middle = new QVBoxLayout;
  form_ = new QFormLayout;
  middle->addLayout(form_);
  form_->addRow(tr("&Degree:"), degree_);
  form_->addRow(tr("&Control points:"), controlPoints_);
  middle->addWidget(problem_);
  middle->addStretch(1);
  auto* right = new QVBoxLayout;
  right->addWidget(preview_, 1);
  right->addWidget(facts_);
  auto* row = new QHBoxLayout;
  row->addWidget(kinds_);
  row->addLayout(middle, 2);
  row->addLayout(right, 3);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  ok_ = buttons->button(QDialogButtonBox::Ok);
  ok_->setText(isPresent ? tr("&Change") : tr("&Create"));
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* column = new QVBoxLayout(this);
  column->addLayout(row, 1);
  column->addWidget(buttons);
  for (QSpinBox* field : {degree_, controlPoints_})
    connect(field, &QSpinBox::valueChanged, this, &NewSolidDialog::update);
  resize(900, 520);
}

QString NewSolidDialog::shapeTitle() const {
  return primitiveKind(shownKind_).title;
}

void NewSolidDialog::showKind(int kind) {
  shownKind_ = kind;
  while (form_->rowCount() > kRowsOfAllShapes) form_->removeRow(0);
  lengths_.clear();
  profile_ = nullptr;
  outerSize_ = nullptr;
  ownShape_.reset();
  if (!primitiveKind(kind).profiles.empty()) addProfileRow();
  for (const PrimitiveLength& length : primitiveKind(kind).lengths) {
    auto* row = new NumberRow(Quantity::kLength, settings_, this);
    row->field().setObjectName(QString::fromStdString(length.inWords));
    row->setRange(length.mayBeZero ? 0.0 : modeling::kMinLength, modeling::kMaxLength);
    row->setValue(length.in(primitive_));
    connect(row, &NumberRow::changed, this, &NewSolidDialog::update);
    form_->insertRow(form_->rowCount() - kRowsOfAllShapes, length.label, row);
    lengths_.push_back(row);
  }
  // The lengths of a box are its outer size.
  if (!std::holds_alternative<modeling::BoxShape>(primitive_.shape)) addOuterSizeRow();
  QWidget* before = kinds_;
  if (profile_) {
    setTabOrder(std::exchange(before, profile_), profile_);
    setTabOrder(std::exchange(before, editProfile_), editProfile_);
  }
  for (NumberRow* row : lengths_) setTabOrder(std::exchange(before, &row->field()), &row->field());
  for (int axis = 0; outerSize_ && axis < 3; ++axis)
    setTabOrder(std::exchange(before, &outerSize_->component(axis)), &outerSize_->component(axis));
  setTabOrder(before, degree_);
  setTabOrder(degree_, controlPoints_);
  const QSignalBlocker blockDegree(degree_), blockCount(controlPoints_);
  degree_->setValue(primitive_.degree);
  controlPoints_->setValue(primitive_.controlPoints);
  update();
}

void NewSolidDialog::addOuterSizeRow() {
  outerSize_ = new VectorEdit(Quantity::kLength, settings_, this);
  outerSize_->setObjectName("outerSize");
  outerSize_->setToolTip(
      tr("Width (x), depth (y) and height (z) of the box around the solid; "
         "another one changes the lengths or stretches the profile"));
  const std::array<QString, 3> names{tr("Outer width"), tr("Outer depth"), tr("Outer height")};
  for (int axis = 0; axis < 3; ++axis) {
    outerSize_->component(axis).setAccessibleName(names[static_cast<std::size_t>(axis)]);
    outerSize_->component(axis).setMinimumWidth(kSizeWidth);
    outerSize_->component(axis).setRange(modeling::kMinLength, modeling::kMaxLength);
  }
  connect(outerSize_, &VectorEdit::edited, this, &NewSolidDialog::setOuterSize);
  form_->insertRow(form_->rowCount() - kRowsOfAllShapes, tr("&Outer size:"), outerSize_);
}

void NewSolidDialog::showOuterSize() {
  shownOuterSize_ = modeling::outerSize(primitive_);
  if (outerSize_) outerSize_->setValue(shownOuterSize_);
}

void NewSolidDialog::setOuterSize(const Eigen::Vector3d& size) {
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] == shownOuterSize_[axis]) continue;
    const auto changed = modeling::withOuterSize(primitive_, axis, size[axis]);
    if (!changed) {
      showOuterSize();
      problem_->setText(tr("No such shape has this outer size."));
      return;
    }
    primitive_ = *changed;
    showLengths();
    update();
    return;
  }
}

void NewSolidDialog::showLengths() {
  for (std::size_t i = 0; i < lengths_.size(); ++i) {
    const QSignalBlocker block(lengths_[i]);
    lengths_[i]->setValue(primitiveKind(shownKind_).lengths[i].in(primitive_));
  }
}

void NewSolidDialog::readFields() {
  for (std::size_t i = 0; i < lengths_.size(); ++i)
    if (const auto value = lengths_[i]->value())
      primitiveKind(shownKind_).lengths[i].in(primitive_) = *value;
  primitive_.degree = degree_->value();
  primitive_.controlPoints = controlPoints_->value();
}

void NewSolidDialog::update() {
  fit_.forget();
  for (const NumberRow* row : lengths_)
    if (!row->value()) {
      problem_->clear();
      setMakable(false);
      return;
    }
  readFields();
  try {
    const modeling::Solid solid = modeling::makePrimitive(primitive_);
    showProblem({});
    preview_->showSolid(solid);
    showOuterSize();
    const auto size = [this](int axis) {
      return unbroken(shown(shownOuterSize_[axis], Quantity::kLength, settings_.units(), 5));
    };
    expected_ = tr("Outer size %1 × %2 × %3. ").arg(size(0), size(1), size(2)) +
                tr("%1 patches, %2 control points. About %3 nodes with edges of %4.\n")
                    .arg(solid.patches().size())
                    .arg(solid.controlPoints().size())
                    .arg(600)
                    .arg(unbroken(shown(app::suitableEdgeLength(solid), Quantity::kLength,
                                        settings_.units())));
    facts_->setText(expected_);
    fit_.ask(primitive_);
  } catch (const std::exception& error) {
    showProblem(QString::fromStdString(error.what()));
  }
}

void NewSolidDialog::showProblem(const QString& problem) {
  setMakable(problem.isEmpty());
  // Show it at the field that the message names first, or below all fields.
  NumberRow* guilty = nullptr;
  qsizetype earliest = problem.size();
  for (std::size_t i = 0; i < lengths_.size(); ++i) {
    lengths_[i]->setProblem({});
    const auto at =
        problem.indexOf(QString::fromStdString(primitiveKind(shownKind_).lengths[i].inWords));
    if (at < 0 || at >= earliest) continue;
    earliest = at;
    guilty = lengths_[i];
  }
  QString sentence = problem.section(": ", 1).isEmpty() ? problem : problem.section(": ", 1);
  if (!sentence.isEmpty()) sentence[0] = sentence[0].toUpper();
  if (guilty) guilty->setProblem(sentence);
  problem_->setText(guilty ? QString() : problem);
}

void NewSolidDialog::setMakable(bool isMakable) {
  ok_->setEnabled(isMakable);
  preview_->setStale(!isMakable);
  facts_->setVisible(isMakable);
}

}  // namespace palpa::gui
