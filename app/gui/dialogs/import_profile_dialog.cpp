#include "app/gui/dialogs/import_profile_dialog.h"

#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QVBoxLayout>
#include <cmath>
#include <numbers>

#include "app/gui/base/background_job.h"
#include "app/gui/widgets/form_row.h"
#include "modeling/project/profile_file.h"
#include "modeling/shapes/profile_sketch.h"
#include "modeling/shapes/shape_parameters.h"

namespace palpa::gui {

using Eigen::Vector2d;
using modeling::SketchUse;

namespace {

std::vector<modeling::SketchSection> fromProfileFile(const QString& file, SketchUse use) {
  std::vector<modeling::SketchSection> sections;
  if (use != SketchUse::kLoft) {
    const modeling::ProfileCurve curve = modeling::readProfileCurve(file.toStdString());
    return {{0.0, modeling::ProfileSketch(curve)}};
  }
  for (const auto& section : modeling::readSections(file.toStdString()))
    sections.push_back({section.z, modeling::ProfileSketch(section.profile)});
  return sections;
}

}  // namespace

std::optional<std::vector<modeling::SketchSection>> importSections(Settings& settings,
                                                                   SketchUse use, QWidget& window) {
  const QString file = QFileDialog::getOpenFileName(
      &window, QObject::tr("Import profile"), settings.lastFolder(),
      QObject::tr("Profiles and drawings (*.json *.svg *.dxf);;All files (*)"));
  if (file.isEmpty()) return std::nullopt;
  settings.setLastFolder(QFileInfo(file).absolutePath());
  if (!modeling::isDrawingFile(file.toStdString())) return fromProfileFile(file, use);
  const auto drawing = runInBackground(
      window, QObject::tr("Reading %1").arg(QFileInfo(file).fileName()), [&](const Job& job) {
        return modeling::readProfileDrawing(file.toStdString(), {}, 0.0, job);
      });
  if (!drawing) return std::nullopt;
  ImportProfileDialog dialog(settings, use, *drawing, &window);
  if (dialog.exec() != QDialog::Accepted) return std::nullopt;
  return std::vector<modeling::SketchSection>{{0.0, modeling::ProfileSketch(dialog.curve())}};
}

ImportProfileDialog::ImportProfileDialog(Settings& settings, SketchUse use,
                                         modeling::ProfileDrawing drawing, QWidget* parent)
    : QDialog(parent),
      settings_(settings),
      use_(use),
      drawing_(std::move(drawing)),
      view_(new DrawingView(this)),
      layer_(new QComboBox(this)),
      paths_(new QListWidget(this)),
      position_(new QComboBox(this)),
      tolerance_(new QuantityEdit(Quantity::kLength, settings, this)),
      smooths_(new QCheckBox(tr("&Smooth bends below"), this)),
      angle_(new QSpinBox(this)),
      result_(new QLabel(this)),
      problem_(new QLabel(this)) {
  setObjectName("import profile");
  setWindowTitle(
      tr("Import profile: %1").arg(QFileInfo(QString::fromStdString(drawing_.source)).fileName()));
  auto* form = new QFormLayout;
  layer_->addItem(tr("All layers"));
  for (const std::string& layer : drawing_.layers) layer_->addItem(QString::fromStdString(layer));
  layer_->setEnabled(drawing_.layers.size() > 1);
  addFormRow(form, tr("&Layer:"), layer_, "layer");
  paths_->setMinimumHeight(120);
  addFormRow(form, tr("&Curves:"), paths_, "paths");
  position_->addItem(tr("As drawn"));
  position_->addItem(tr("Centred at the origin"));
  position_->addItem(tr("Left end at x = 0"));
  if (use == SketchUse::kRevolve) position_->setCurrentIndex(kAtAxis);
  addFormRow(form, tr("&Position:"), position_, "position");
  tolerance_->setRange(1e-6, modeling::kMaxLength);
  tolerance_->setValue(QString::number(drawing_.tolerance, 'g', 2).toDouble());
  addFormRow(form, tr("&Tolerance:"), tolerance_, "tolerance",
             tr("Largest distance of the spline from the drawing"));
  angle_->setRange(1, 60);
  angle_->setValue(15);
  angle_->setSuffix("°");
  angle_->setObjectName("angle");
  angle_->setAccessibleName(tr("Angle"));
  smooths_->setObjectName("smooths");
  smooths_->setToolTip(tr("For curves that were drawn as many short lines"));
  auto* bends = new QHBoxLayout;
  bends->addWidget(smooths_);
  bends->addWidget(angle_);
  bends->addStretch(1);
  form->addRow(QString(), bends);
  result_->setObjectName("result");
  result_->setWordWrap(true);
  problem_->setObjectName("problem");
  problem_->setWordWrap(true);
  auto* left = new QVBoxLayout;
  left->addLayout(form);
  left->addWidget(result_);
  left->addWidget(problem_);
  left->addStretch(1);
  auto* row = new QHBoxLayout;
  row->addLayout(left, 1);
  row->addWidget(view_, 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  ok_ = buttons->button(QDialogButtonBox::Ok);
  ok_->setText(tr("&Import"));
  connect(buttons, &QDialogButtonBox::accepted, this, &ImportProfileDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &ImportProfileDialog::reject);
  auto* column = new QVBoxLayout(this);
  column->addLayout(row, 1);
  column->addWidget(buttons);
  connect(layer_, &QComboBox::currentIndexChanged, this, &ImportProfileDialog::readLayer);
  connect(paths_, &QListWidget::currentRowChanged, this, &ImportProfileDialog::fit);
  connect(tolerance_, &QuantityEdit::edited, this, &ImportProfileDialog::fit);
  connect(smooths_, &QCheckBox::toggled, this, &ImportProfileDialog::fit);
  connect(angle_, &QSpinBox::valueChanged, this, &ImportProfileDialog::fit);
  connect(view_, &DrawingView::picked, this, [this](int path) { paths_->setCurrentRow(path); });
  resize(860, 460);
  showPaths();
  paths_->setFocus();
}

void ImportProfileDialog::readLayer() {
  if (layer_->currentIndex() == readLayer_) {
    showPaths();
    return;
  }
  try {
    // Paths of one layer join without the others.
    const std::string layer =
        layer_->currentIndex() > 0 ? layer_->currentText().toStdString() : std::string();
    auto drawing = runInBackground(
        jobParent(), tr("Reading %1").arg(layer_->currentText()),
        [&, source = drawing_.source, tolerance = tolerance_->value()](const Job& job) {
          return modeling::readProfileDrawing(source, layer, tolerance, job);
        });
    if (!drawing) {  // cancelled
      layer_->setCurrentIndex(readLayer_);
      return;
    }
    drawing_ = std::move(*drawing);
    readLayer_ = layer_->currentIndex();
  } catch (const std::exception& error) {
    problem_->setText(QString::fromStdString(error.what()));
    return;
  }
  showPaths();
}

void ImportProfileDialog::showPaths() {
  view_->setPaths(drawing_.paths);
  const QSignalBlocker block(paths_);
  paths_->clear();
  constexpr std::size_t kMaxListed = 200;
  for (std::size_t i = 0; i < std::min(kMaxListed, drawing_.paths.size()); ++i)
    paths_->addItem(QString::fromStdString(modeling::describePath(drawing_.paths[i])));
  paths_->setCurrentRow(0);
  fit();
}

void ImportProfileDialog::fit() {
  fitted_.reset();
  problem_->clear();
  result_->clear();
  angle_->setEnabled(smooths_->isChecked());
  const int path = paths_->currentRow();
  if (path < 0) return;
  try {
    const modeling::FitOptions options{
        tolerance_->value(),
        smooths_->isChecked() ? angle_->value() * std::numbers::pi / 180.0 : 0.0};
    fitted_ = runInBackground(jobParent(), tr("Fitting a spline"), [&](const Job& job) {
      return modeling::fitPath(drawing_, static_cast<std::size_t>(path), options, job);
    });
    if (fitted_)
      showFitted(path);
    else
      result_->setText(tr("The fit was cancelled; change the tolerance to begin it again."));
  } catch (const std::exception& error) {
    problem_->setText(QString::fromStdString(error.what()));
  }
  view_->setChosen(path, fitted_ ? std::optional(fitted_->curve) : std::nullopt);
  ok_->setEnabled(fitted_.has_value());
}

void ImportProfileDialog::showFitted(int path) {
  QString text = tr("%1 control points, within %2 of the drawing.")
                     .arg(fitted_->curve.points.size())
                     .arg(shown(fitted_->deviation, Quantity::kLength, settings_.units(), 2));
  if (fitted_->deviation < 1e-9)
    text = tr("%1 control points, exactly as drawn.").arg(fitted_->curve.points.size());
  text += "\n" + tr("Unit: %1.").arg(QString::fromStdString(drawing_.unit));
  QStringList skipped;
  for (const auto& [kind, count] : drawing_.skipped)
    skipped << QString("%1 %2").arg(count).arg(QString::fromStdString(kind));
  if (!skipped.isEmpty()) text += " " + tr("Not read: %1.").arg(skipped.join(", "));
  result_->setText(text);
  if (use_ != SketchUse::kRevolve && !drawing_.paths[static_cast<std::size_t>(path)].closed)
    problem_->setText(tr("This curve is open; close it in the drawing, or after the import."));
}

modeling::ProfileCurve ImportProfileDialog::curve() const {
  modeling::ProfileCurve curve = fitted_->curve;
  const auto [low, high] = modeling::ProfileSketch(curve).box();
  Vector2d by = Vector2d::Zero();
  if (position_->currentIndex() == kCentred) by = -0.5 * (low + high);
  if (position_->currentIndex() == kAtAxis) by.x() = -low.x();
  for (Vector2d& point : curve.points) {
    point += by;
    // The ends of a revolved profile lie exactly on the axis.
    if (position_->currentIndex() == kAtAxis && std::abs(point.x()) < 1e-9 * (high - low).norm())
      point.x() = 0.0;
  }
  return curve;
}

void ImportProfileDialog::accept() {
  if (fitted_) QDialog::accept();
}

}  // namespace palpa::gui
