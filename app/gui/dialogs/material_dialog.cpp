#include "app/gui/dialogs/material_dialog.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "app/gui/base/appearance.h"
#include "app/gui/document/editor.h"
#include "modeling/project/shore_hardness.h"

namespace palpa::gui {
namespace {

constexpr double kMinModulus = 1e-9;  // MPa (1 mPa): softer than any gel
constexpr double kMaxModulus = 1e9;   // MPa: stiffer than diamond
constexpr double kMinDensity = 1e-6;  // kg/m³: lighter than any aerogel
constexpr double kMaxDensity = 1e6;   // kg/m³: heavier than any metal

}  // namespace

MaterialDialog::MaterialDialog(Settings& settings, const modeling::Material& present,
                               QWidget* parent)
    : QDialog(parent),
      settings_(settings),
      own_(settings),
      list_(new MaterialList(own_, settings, this)),
      source_(new QLabel(this)),
      name_(new QLineEdit(this)),
      modulus_(new NumberRow(Quantity::kStress, settings, this)),
      hardness_(new NumberRow(Quantity::kNumber, settings, this)),
      ratio_(new NumberRow(Quantity::kNumber, settings, this)),
      density_(new NumberRow(Quantity::kDensity, settings, this)),
      note_(new QLineEdit(this)) {
  setObjectName("material");
  setWindowTitle(tr("Material"));
  source_->setObjectName("source");
  source_->setWordWrap(true);
  source_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  source_->setAlignment(Qt::AlignTop);
  source_->setMinimumHeight(4 * fontMetrics().lineSpacing());
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  ok_ = buttons->button(QDialogButtonBox::Ok);
  auto* column = new QVBoxLayout(this);
  column->addWidget(list_, 1);
  column->addLayout(makeOwnButtons());
  column->addWidget(source_);
  column->addLayout(makeForm());
  column->addWidget(buttons);
  resize(660, 700);

  const auto& [name, youngsModulus, poissonRatio, density] = present;
  name_->setText(QString::fromStdString(name));
  modulus_->setValue(youngsModulus);
  hardness_->clear();
  ratio_->setValue(poissonRatio);
  density_->setValue(density.value_or(std::numeric_limits<double>::quiet_NaN()));
  if (list_->select(present)) take(*list_->current());
  connectFields();
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  update();
}

QLayout* MaterialDialog::makeOwnButtons() {
  auto* line = new QHBoxLayout;
  save_ = addOwnButton(*line, "saveOwn", tr("&Save as own material"), {});
  rename_ = addOwnButton(*line, "renameOwn", tr("&Rename"), tr("Change the name (F2)"));
  delete_ = addOwnButton(*line, "deleteOwn", tr("&Delete"),
                         tr("Delete the own material (Delete); the fields keep its values"));
  line->addStretch(1);
  return line;
}

QPushButton* MaterialDialog::addOwnButton(QLayout& line, const QString& name, const QString& text,
                                          const QString& tip) {
  auto* button = new QPushButton(text, this);
  button->setObjectName(name);
  button->setToolTip(tip);
  button->setAutoDefault(false);
  line.addWidget(button);
  return button;
}

QFormLayout* MaterialDialog::makeForm() {
  name_->setObjectName("name");
  note_->setObjectName("note");
  note_->setPlaceholderText(tr("Where the values come from; kept with own materials"));
  modulus_->field().setObjectName("modulus");
  hardness_->field().setObjectName("hardness");
  ratio_->field().setObjectName("ratio");
  density_->field().setObjectName("density");
  modulus_->setRange(kMinModulus, kMaxModulus);
  hardness_->setRange(modeling::kMinShoreA, modeling::kMaxShoreA);
  hardness_->setOptional(tr("%1 … %2 Shore A gives an estimate of Young's modulus")
                             .arg(modeling::kMinShoreA)
                             .arg(modeling::kMaxShoreA));
  // Excludes -1.
  ratio_->setRange(std::nextafter(-1.0, 0.0), 0.5);
  density_->setRange(kMinDensity, kMaxDensity);
  density_->setOptional(tr("unknown; gravity needs it"));
  auto* form = new QFormLayout;
  form->addRow(tr("&Name:"), name_);
  form->addRow(tr("&Young's modulus:"), modulus_);
  form->addRow(tr("From &hardness:"), hardness_);
  form->addRow(tr("&Poisson's ratio:"), ratio_);
  form->addRow(tr("D&ensity:"), density_);
  form->addRow(tr("S&ource:"), note_);
  return form;
}

void MaterialDialog::connectFields() {
  connect(list_, &MaterialList::chosen, this, &MaterialDialog::take);
  connect(list_, &MaterialList::doubleClicked, this, [this] {
    if (ok_->isEnabled()) accept();
  });
  connect(list_, &MaterialList::renamed, this, &MaterialDialog::renameOwn);
  connect(list_, &MaterialList::deletePressed, delete_, &QPushButton::click);
  connect(name_, &QLineEdit::textChanged, this, &MaterialDialog::update);
  connect(note_, &QLineEdit::textChanged, this, &MaterialDialog::update);
  connect(modulus_, &NumberRow::changed, this, [this] {
    // Another modulus does not come from the hardness.
    if (!isTaking_ && modulus_->field().isModified()) hardness_->clear();
    update();
  });
  connect(hardness_, &NumberRow::changed, this, &MaterialDialog::applyHardness);
  for (NumberRow* row : {ratio_, density_})
    connect(row, &NumberRow::changed, this, &MaterialDialog::update);
  connect(save_, &QPushButton::clicked, this, &MaterialDialog::saveOwn);
  connect(rename_, &QPushButton::clicked, this, [this] { list_->editName(); });
  connect(delete_, &QPushButton::clicked, this, &MaterialDialog::deleteOwn);
}

void MaterialDialog::take(const modeling::LibraryMaterial& entry) {
  isTaking_ = true;
  taken_ = entry;
  const auto& [name, youngsModulus, poissonRatio, density] = taken_->material;
  name_->setText(QString::fromStdString(name));
  modulus_->setValue(youngsModulus);
  hardness_->clear();
  hardnessNote_.clear();
  ratio_->setValue(poissonRatio);
  density_->setValue(density.value_or(std::numeric_limits<double>::quiet_NaN()));
  note_->setText(own_.find(name) ? QString::fromStdString(taken_->note) : QString());
  isTaking_ = false;
  update();
}

void MaterialDialog::applyHardness() {
  if (isTaking_) return;
  const auto hardness = hardness_->value();
  if (hardness) {
    isTaking_ = true;
    modulus_->setValue(modeling::estimatedModulusOfShoreA(*hardness));
    const QString note = tr("estimated from %1 Shore A (Gent 1958)")
                             .arg(shown(*hardness, Quantity::kNumber, settings_.units()));
    if (note_->text().isEmpty() || note_->text() == hardnessNote_) note_->setText(note);
    hardnessNote_ = note;
    isTaking_ = false;
  }
  update();
}

bool MaterialDialog::holds(const modeling::Material& material) const {
  return modulus_->value() == material.youngsModulus && ratio_->value() == material.poissonRatio &&
         density_->value() == material.densityKgPerM3;
}

void MaterialDialog::update() {
  if (isTaking_) return;
  showSource();
  const bool isNamed = !name_->text().trimmed().isEmpty();
  ok_->setEnabled(modulus_->value() && ratio_->value() && density_->isValid() && isNamed);
  name_->setToolTip(isNamed ? QString() : tr("The material needs a name"));
  const QString obstacle = obstacleToSave();
  save_->setEnabled(obstacle.isEmpty());
  save_->setToolTip(obstacle.isEmpty() ? tr("Keep the values below for all projects") : obstacle);
  const modeling::LibraryMaterial* current = list_->current();
  const bool isOwn = current && own_.find(current->material.name);
  rename_->setEnabled(isOwn);
  delete_->setEnabled(isOwn);
}

QString MaterialDialog::obstacleToSave() const {
  const std::string name = name_->text().trimmed().toStdString();
  if (name.empty()) return tr("The material needs a name");
  if (isOfLibrary(name)) return tr("The library has a material of this name; choose another one");
  if (!modulus_->value() || !ratio_->value() || !density_->isValid())
    return tr("Correct the values below first");
  const modeling::LibraryMaterial* own = own_.find(name);
  if (own && holds(own->material) && own->note == note_->text().trimmed().toStdString())
    return tr("Saved with these values");
  return {};
}

void MaterialDialog::showSource() {
  if (hardness_->value()) {
    source_->setText(
        tr("Estimate from the hardness S by Gent's relation for rubber, E = 0.0981 (56 + 7.62336 "
           "S) / (0.137505 (254 − 2.54 S)) MPa (Rubber Chem. Technol. 31 (1958) 896). Below 40 "
           "Shore A it is coarse; a measured modulus is better."));
    return;
  }
  if (taken_ && modulus_->isValid() && ratio_->isValid() && density_->isValid()) {
    const std::string& name = taken_->material.name;
    const bool isOwn = own_.find(name);
    if (holds(taken_->material) && !isOwn && isOfLibrary(name)) {
      source_->setText(QString::fromStdString(taken_->note + "\n" + taken_->reference));
      return;
    }
    // Other constants are another material and must not keep the library's name.
    if (!isOwn && isOfLibrary(name) && name_->text() == QString::fromStdString(name)) {
      taken_.reset();
      name_->setText(tr("%1, changed").arg(name_->text()));
    }
  }
  source_->setText(
      tr("Own values. Poisson's ratio is above -1 and at most 0.5 (incompressible, as "
         "rubber nearly is)."));
}

void MaterialDialog::saveOwn() {
  if (!obstacleToSave().isEmpty()) return;
  const modeling::Material saved = material();
  own_.put({saved, note_->text().trimmed().toStdString(), {}});
  list_->fill(saved.name);
  taken_ = *own_.find(saved.name);
  list_->reveal();
  update();
}

void MaterialDialog::renameOwn(const std::string& from, const QString& to) {
  const bool isRenamed = own_.rename(from, to.toStdString());
  if (isRenamed && name_->text().toStdString() == from) name_->setText(to);
  const std::string chosen = isRenamed ? to.toStdString() : from;
  // The list cannot be filled while it closes its editor.
  QMetaObject::invokeMethod(
      this,
      [this, chosen, isRenamed, to] {
        list_->fill(chosen);
        if (own_.find(chosen)) taken_ = *own_.find(chosen);
        update();
        if (!isRenamed)
          source_->setText(
              to.isEmpty()
                  ? tr("A name needs at least one letter; the old one stays.")
                  : tr("There is already a material named “%1”; the old name stays.").arg(to));
      },
      Qt::QueuedConnection);
}

void MaterialDialog::deleteOwn() {
  const modeling::LibraryMaterial* current = list_->current();
  if (!current || !own_.find(current->material.name)) return;
  own_.remove(current->material.name);
  taken_.reset();
  list_->fill({});
  update();
}

modeling::Material MaterialDialog::material() const {
  return {name_->text().trimmed().toStdString(), *modulus_->value(), *ratio_->value(),
          density_->value()};
}

void MaterialDialog::enterDensity() {
  density_->field().setFocus();
  density_->field().selectAll();
}

void editMaterial(const Workspace& workspace, bool isForDensity) {
  Editor& editor = workspace.editor;
  MaterialDialog dialog(workspace.settings, editor.project().material, &workspace.window);
  if (isForDensity) dialog.enterDensity();
  if (dialog.exec() == QDialog::Accepted) editor.perform(modeling::SetMaterial{dialog.material()});
}

}  // namespace palpa::gui
