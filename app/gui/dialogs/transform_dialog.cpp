#include "app/gui/dialogs/transform_dialog.h"

#include <QDialogButtonBox>
#include <QPushButton>
#include <QVBoxLayout>
#include <numbers>

#include "app/gui/widgets/form_row.h"

namespace palpa::gui {

TransformDialog::TransformDialog(Editor& editor, const Settings& settings, QWidget* parent)
    : QDialog(parent),
      editor_(editor),
      form_(new QFormLayout),
      kind_(new QComboBox(this)),
      vector_(new VectorEdit(Quantity::kLength, settings, this)),
      axis_(new VectorEdit(Quantity::kNumber, settings, this)),
      angle_(new QuantityEdit(Quantity::kAngle, settings, this)),
      factors_(new VectorEdit(Quantity::kNumber, settings, this)),
      normal_(new VectorEdit(Quantity::kNumber, settings, this)),
      centre_(new VectorEdit(Quantity::kLength, settings, this)),
      problem_(new QLabel(this)) {
  setWindowTitle(tr("Transform solid"));
  setObjectName("transformSolid");
  kind_->addItems({tr("Move"), tr("Rotate"), tr("Scale"), tr("Mirror")});
  addFormRow(form_, tr("&Transformation:"), kind_, "transformation");
  addFormRow(form_, tr("&By:"), vector_, "by", tr("Vector by which the body is moved"));
  addFormRow(form_, tr("&Axis:"), axis_, "axis", tr("Direction of the axis, of any length"));
  addFormRow(form_, tr("A&ngle:"), angle_, "angle",
             tr("Positive turns counter-clockwise seen against the axis"));
  addFormRow(form_, tr("&Factors:"), factors_, "factors", tr("Along x, y and z, each above zero"));
  addFormRow(form_, tr("&Normal:"), normal_, "normal", tr("Normal of the mirror plane"));
  addFormRow(form_, tr("&Centre:"), centre_, "centre", tr("A point that stays where it is"));
  axis_->setValue(Eigen::Vector3d::UnitZ());
  angle_->setValue(std::numbers::pi / 2);
  factors_->setValue(Eigen::Vector3d::Ones());
  normal_->setValue(Eigen::Vector3d::UnitX());
  const auto [low, high] = modeling::boundingBox(editor.project().body);
  centre_->setValue(0.5 * (low + high));
  problem_->setWordWrap(true);
  problem_->setObjectName("problem");
  problem_->hide();
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  connect(buttons, &QDialogButtonBox::accepted, this, &TransformDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &TransformDialog::reject);
  connect(kind_, &QComboBox::currentIndexChanged, this, &TransformDialog::showKind);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(form_);
  layout->addWidget(problem_);
  layout->addStretch();
  layout->addWidget(buttons);
  setMinimumWidth(420);
  showKind();
}

void TransformDialog::showKind() {
  const int kind = kind_->currentIndex();
  const auto setShown = [this](QWidget* field, bool isShown) {
    setFormRowVisible(form_, field, isShown);
  };
  setShown(vector_, kind == kTranslate);
  setShown(axis_, kind == kRotate);
  setShown(angle_, kind == kRotate);
  setShown(factors_, kind == kScale);
  setShown(normal_, kind == kMirror);
  setShown(centre_, kind != kTranslate);
  problem_->hide();
}

modeling::TransformSolid TransformDialog::command() const {
  switch (kind_->currentIndex()) {
    case kTranslate:
      return {modeling::Translation{vector_->value()}};
    case kRotate:
      return {modeling::Rotation{axis_->value(), angle_->value() * 180.0 / std::numbers::pi,
                                 centre_->value()}};
    case kScale:
      return {modeling::Scaling{factors_->value(), centre_->value()}};
    default:
      return {modeling::MirrorPlane{centre_->value(), normal_->value()}};
  }
}

void TransformDialog::accept() {
  QString problem;
  const auto heard =
      connect(&editor_, &Editor::refused, this, [&](const QString& message) { problem = message; });
  const bool isDone = editor_.perform(command());
  disconnect(heard);
  if (isDone) {
    QDialog::accept();
    return;
  }
  problem_->setText(problem);
  problem_->show();
}

}  // namespace palpa::gui
