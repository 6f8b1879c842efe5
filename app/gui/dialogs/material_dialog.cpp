#include "app/gui/dialogs/material_dialog.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHeaderView>
#include <QVBoxLayout>
#include <cmath>

#include "app/gui/document/editor.h"
#include "modeling/project/material_library.h"

namespace palpa::gui {
namespace {

constexpr double kMinModulus = 1e-9;  // MPa (1 mPa): softer than any gel
constexpr double kMaxModulus = 1e9;   // MPa: stiffer than diamond

const modeling::LibraryMaterial& entryOf(int index) {
  return modeling::materialLibrary()[static_cast<std::size_t>(index)];
}

}  // namespace

MaterialDialog::MaterialDialog(const Settings& settings, const modeling::Material& present,
                               QWidget* parent)
    : QDialog(parent),
      settings_(settings),
      filter_(new QLineEdit(this)),
      list_(new QTreeWidget(this)),
      source_(new QLabel(this)),
      name_(new QLineEdit(this)),
      modulus_(new NumberRow(Quantity::kStress, settings, this)),
      ratio_(new NumberRow(Quantity::kNumber, settings, this)) {
  setObjectName("material");
  setWindowTitle(tr("Material"));
  filter_->setObjectName("filter");
  filter_->setPlaceholderText(tr("Find a material"));
  filter_->setClearButtonEnabled(true);
  filter_->setAccessibleName(tr("Find a material"));
  list_->setObjectName("library");
  list_->setAccessibleName(tr("Materials"));
  source_->setObjectName("source");
  source_->setWordWrap(true);
  source_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  source_->setAlignment(Qt::AlignTop);
  source_->setMinimumHeight(72);
  name_->setObjectName("name");
  modulus_->field().setObjectName("modulus");
  ratio_->field().setObjectName("ratio");
  modulus_->setRange(kMinModulus, kMaxModulus);
  // Excludes -1.
  ratio_->setRange(std::nextafter(-1.0, 0.0), 0.5);

  auto* form = new QFormLayout;
  form->addRow(tr("&Name:"), name_);
  form->addRow(tr("&Young's modulus:"), modulus_);
  form->addRow(tr("&Poisson's ratio:"), ratio_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  ok_ = buttons->button(QDialogButtonBox::Ok);
  auto* column = new QVBoxLayout(this);
  column->addWidget(filter_);
  column->addWidget(list_, 1);
  column->addWidget(source_);
  column->addLayout(form);
  column->addWidget(buttons);
  resize(620, 620);

  fillList();
  const auto& [name, youngsModulus, poissonRatio, density] = present;
  name_->setText(QString::fromStdString(name));
  modulus_->setValue(youngsModulus);
  ratio_->setValue(poissonRatio);
  density_ = density;
  const auto& library = modeling::materialLibrary();
  for (std::size_t i = 0; i < library.size(); ++i)
    if (library[i].material == present) {
      taken_ = static_cast<int>(i);
      list_->setCurrentItem(list_->topLevelItem(taken_));
    }
  connect(filter_, &QLineEdit::textChanged, this, &MaterialDialog::filter);
  connect(list_, &QTreeWidget::currentItemChanged, this, [this](const QTreeWidgetItem* item) {
    if (item) take(item->data(0, Qt::UserRole).toInt());
  });
  connect(list_, &QTreeWidget::itemActivated, this, [this] {
    if (ok_->isEnabled()) accept();
  });
  connect(name_, &QLineEdit::textChanged, this, &MaterialDialog::update);
  for (NumberRow* row : {modulus_, ratio_})
    connect(row, &NumberRow::changed, this, &MaterialDialog::update);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  update();
}

void MaterialDialog::fillList() {
  list_->setHeaderLabels({tr("Material"), tr("Young's modulus"), tr("Poisson's ratio")});
  for (int column : {1, 2})
    list_->headerItem()->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  list_->setRootIsDecorated(false);
  list_->setAlternatingRowColors(true);
  const int count = static_cast<int>(modeling::materialLibrary().size());
  for (int i = 0; i < count; ++i) {
    const modeling::Material& material = entryOf(i).material;
    auto* item = new QTreeWidgetItem(
        list_, {QString::fromStdString(material.name),
                shown(material.youngsModulus, Quantity::kStress, settings_.units(), 4),
                shown(material.poissonRatio, Quantity::kNumber, settings_.units(), 4)});
    item->setData(0, Qt::UserRole, i);
    item->setTextAlignment(1, Qt::AlignRight | Qt::AlignVCenter);
    item->setTextAlignment(2, Qt::AlignRight | Qt::AlignVCenter);
  }
  list_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  list_->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  list_->header()->setSectionResizeMode(2, QHeaderView::ResizeToContents);
  list_->header()->setStretchLastSection(false);
}

void MaterialDialog::filter(const QString& text) {
  for (int i = 0; i < list_->topLevelItemCount(); ++i) {
    QTreeWidgetItem* item = list_->topLevelItem(i);
    const auto& entry = entryOf(item->data(0, Qt::UserRole).toInt());
    const QString all = QString::fromStdString(entry.material.name + " " + entry.note);
    item->setHidden(!all.contains(text.trimmed(), Qt::CaseInsensitive));
  }
}

void MaterialDialog::take(int entry) {
  isTaking_ = true;
  taken_ = entry;
  const modeling::Material& material = entryOf(entry).material;
  name_->setText(QString::fromStdString(material.name));
  modulus_->setValue(material.youngsModulus);
  ratio_->setValue(material.poissonRatio);
  density_ = material.densityKgPerM3;
  isTaking_ = false;
  update();
}

void MaterialDialog::update() {
  if (isTaking_) return;
  const bool areNumbers = modulus_->value() && ratio_->value();
  ok_->setEnabled(areNumbers && !name_->text().trimmed().isEmpty());
  name_->setToolTip(name_->text().trimmed().isEmpty() ? tr("The material needs a name")
                                                      : QString());
  showSource();
}

void MaterialDialog::showSource() {
  if (taken_ >= 0 && modulus_->value() && ratio_->value()) {
    const modeling::LibraryMaterial& entry = entryOf(taken_);
    if (*modulus_->value() == entry.material.youngsModulus &&
        *ratio_->value() == entry.material.poissonRatio) {
      source_->setText(QString::fromStdString(entry.note + "\n" + entry.reference));
      return;
    }
    // Other constants are another material and must not keep the library's name.
    if (name_->text() == QString::fromStdString(entry.material.name)) {
      taken_ = -1;
      name_->setText(tr("%1, changed").arg(name_->text()));
    }
  }
  source_->setText(
      tr("Own values. Poisson's ratio is above -1 and at most 0.5 (incompressible, as "
         "rubber nearly is)."));
}

modeling::Material MaterialDialog::material() const {
  return {name_->text().trimmed().toStdString(), *modulus_->value(), *ratio_->value(), density_};
}

void editMaterial(const Workspace& workspace) {
  Editor& editor = workspace.editor;
  MaterialDialog dialog(workspace.settings, editor.project().material, &workspace.window);
  if (dialog.exec() == QDialog::Accepted) editor.perform(modeling::SetMaterial{dialog.material()});
}

}  // namespace palpa::gui
