#include "app/gui/dialogs/material_dialog.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHeaderView>
#include <QShortcut>
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
      filter_(new QLineEdit(this)),
      list_(new QTreeWidget(this)),
      source_(new QLabel(this)),
      name_(new QLineEdit(this)),
      modulus_(new NumberRow(Quantity::kStress, settings, this)),
      hardness_(new NumberRow(Quantity::kNumber, settings, this)),
      ratio_(new NumberRow(Quantity::kNumber, settings, this)),
      density_(new NumberRow(Quantity::kDensity, settings, this)),
      note_(new QLineEdit(this)) {
  setObjectName("material");
  setWindowTitle(tr("Material"));
  filter_->setObjectName("filter");
  filter_->setPlaceholderText(tr("Find a material"));
  filter_->setClearButtonEnabled(true);
  filter_->setAccessibleName(tr("Find a material"));
  source_->setObjectName("source");
  source_->setWordWrap(true);
  source_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  source_->setAlignment(Qt::AlignTop);
  source_->setMinimumHeight(4 * fontMetrics().lineSpacing());
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  ok_ = buttons->button(QDialogButtonBox::Ok);
  auto* column = new QVBoxLayout(this);
  column->addWidget(filter_);
  column->addWidget(makeList(), 1);
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
  fillList({});
  for (int i = 0; i < list_->topLevelItemCount(); ++i) {
    const modeling::LibraryMaterial& entry = *entryOf(list_->topLevelItem(i));
    if (entry.material != present) continue;
    list_->setCurrentItem(list_->topLevelItem(i));
    take(list_->topLevelItem(i));
    break;
  }
  connectFields();
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  update();
}

QWidget* MaterialDialog::makeList() {
  auto* group = new QWidget(this);
  auto* column = new QVBoxLayout(group);
  column->setContentsMargins(0, 0, 0, 0);
  list_->setObjectName("library");
  list_->setAccessibleName(tr("Materials"));
  list_->setHeaderLabels(
      {tr("Material"), tr("Young's modulus"), tr("Poisson's ratio"), tr("Density")});
  list_->setRootIsDecorated(false);
  list_->setAlternatingRowColors(true);
  list_->setUniformRowHeights(true);
  list_->setEditTriggers(QAbstractItemView::EditKeyPressed);
  QHeaderView* header = list_->header();
  header->setStretchLastSection(false);
  header->setSectionResizeMode(0, QHeaderView::Stretch);
  for (int i : {1, 2, 3}) {
    list_->headerItem()->setTextAlignment(i, Qt::AlignRight | Qt::AlignVCenter);
    header->setSectionResizeMode(i, QHeaderView::ResizeToContents);
  }
  auto* line = new QHBoxLayout;
  save_ = addOwnButton(*line, "saveOwn", tr("&Save as own material"), {});
  rename_ = addOwnButton(*line, "renameOwn", tr("&Rename"), tr("Change the name (F2)"));
  delete_ = addOwnButton(*line, "deleteOwn", tr("&Delete"),
                         tr("Delete the own material (Delete); the fields keep its values"));
  line->addStretch(1);
  column->addWidget(list_, 1);
  column->addLayout(line);
  return group;
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
  connect(filter_, &QLineEdit::textChanged, this, &MaterialDialog::filter);
  connect(list_, &QTreeWidget::currentItemChanged, this, [this](const QTreeWidgetItem* item) {
    if (item && !isFilling_) take(item);
  });
  connect(list_, &QTreeWidget::itemDoubleClicked, this, [this] {
    if (ok_->isEnabled()) accept();
  });
  connect(list_, &QTreeWidget::itemChanged, this, &MaterialDialog::renameOwn);
  auto* erase = new QShortcut(QKeySequence::Delete, list_);
  erase->setContext(Qt::WidgetShortcut);
  connect(erase, &QShortcut::activated, delete_, &QPushButton::click);
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
  connect(rename_, &QPushButton::clicked, this, [this] { list_->editItem(list_->currentItem()); });
  connect(delete_, &QPushButton::clicked, this, &MaterialDialog::deleteOwn);
}

void MaterialDialog::fillList(const std::string& chosen) {
  isFilling_ = true;
  list_->clear();
  entries_ = own_.list();
  const auto ownCount = entries_.size();
  const auto& library = modeling::materialLibrary();
  entries_.insert(entries_.end(), library.begin(), library.end());
  const ShownUnits units = settings_.units();
  constexpr int kDigits = 4;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const auto& [name, youngsModulus, poissonRatio, density] = entries_[i].material;
    auto* item = new QTreeWidgetItem(
        list_,
        {QString::fromStdString(name), shown(youngsModulus, Quantity::kStress, units, kDigits),
         shown(poissonRatio, Quantity::kNumber, units, kDigits),
         density ? shown(*density, Quantity::kDensity, units, kDigits) : tr("unknown")});
    item->setData(0, Qt::UserRole, static_cast<int>(i));
    if (i < ownCount) {
      item->setFlags(item->flags() | Qt::ItemIsEditable);
      item->setIcon(0, icon("material"));
      item->setToolTip(0, tr("Own material"));
    }
    for (int column : {1, 2, 3}) item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
    if (name == chosen) list_->setCurrentItem(item);
  }
  isFilling_ = false;
  filter(filter_->text());
}

const modeling::LibraryMaterial* MaterialDialog::entryOf(const QTreeWidgetItem* item) const {
  return item ? &entries_[item->data(0, Qt::UserRole).toUInt()] : nullptr;
}

void MaterialDialog::filter(const QString& text) {
  for (int i = 0; i < list_->topLevelItemCount(); ++i) {
    QTreeWidgetItem* item = list_->topLevelItem(i);
    const modeling::LibraryMaterial& entry = *entryOf(item);
    const QString all = QString::fromStdString(entry.material.name + " " + entry.note);
    item->setHidden(!all.contains(text.trimmed(), Qt::CaseInsensitive));
  }
}

void MaterialDialog::take(const QTreeWidgetItem* item) {
  isTaking_ = true;
  taken_ = *entryOf(item);
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
    // Four digits: more than the estimate has.
    const double modulus = modeling::youngsModulusOfShoreA(*hardness);
    const double unit = std::pow(10, std::floor(std::log10(modulus)) - 3);
    modulus_->setValue(std::round(modulus / unit) * unit);
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
  const modeling::LibraryMaterial* current = entryOf(list_->currentItem());
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
  fillList(saved.name);
  taken_ = *own_.find(saved.name);
  if (QTreeWidgetItem* item = list_->currentItem()) {
    item->setHidden(false);  // a filter must not hide it
    list_->scrollToItem(item);
  }
  update();
}

void MaterialDialog::renameOwn(QTreeWidgetItem* item) {
  if (isFilling_) return;
  const std::string from = entryOf(item)->material.name;
  const QString to = item->text(0).trimmed();
  const bool isRenamed = own_.rename(from, to.toStdString());
  if (isRenamed && name_->text().toStdString() == from) name_->setText(to);
  const std::string chosen = isRenamed ? to.toStdString() : from;
  // The list cannot be filled while it closes its editor.
  QMetaObject::invokeMethod(
      this,
      [this, chosen, isRenamed, to] {
        fillList(chosen);
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
  const modeling::LibraryMaterial* current = entryOf(list_->currentItem());
  if (!current || !own_.find(current->material.name)) return;
  own_.remove(current->material.name);
  taken_.reset();
  fillList({});
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
