#include "app/gui/dialogs/material_list.h"

#include <QHeaderView>
#include <QShortcut>
#include <QVBoxLayout>

#include "app/gui/base/appearance.h"

namespace palpa::gui {

MaterialList::MaterialList(const OwnMaterials& own, const Settings& settings, QWidget* parent)
    : QWidget(parent),
      own_(own),
      settings_(settings),
      filter_(new QLineEdit(this)),
      tree_(new QTreeWidget(this)) {
  filter_->setObjectName("filter");
  filter_->setPlaceholderText(tr("Find a material"));
  filter_->setClearButtonEnabled(true);
  filter_->setAccessibleName(tr("Find a material"));
  tree_->setObjectName("library");
  tree_->setAccessibleName(tr("Materials"));
  tree_->setHeaderLabels(
      {tr("Material"), tr("Young's modulus"), tr("Poisson's ratio"), tr("Density")});
  tree_->setRootIsDecorated(false);
  tree_->setAlternatingRowColors(true);
  tree_->setUniformRowHeights(true);
  tree_->setEditTriggers(QAbstractItemView::EditKeyPressed);
  QHeaderView* header = tree_->header();
  header->setStretchLastSection(false);
  header->setSectionResizeMode(0, QHeaderView::Stretch);
  for (int i : {1, 2, 3}) {
    tree_->headerItem()->setTextAlignment(i, Qt::AlignRight | Qt::AlignVCenter);
    header->setSectionResizeMode(i, QHeaderView::ResizeToContents);
  }
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(filter_);
  column->addWidget(tree_, 1);
  fill({});
  connect(filter_, &QLineEdit::textChanged, this, &MaterialList::filter);
  connect(tree_, &QTreeWidget::currentItemChanged, this, [this](const QTreeWidgetItem* item) {
    if (item && !isFilling_) Q_EMIT chosen(*entryOf(item));
  });
  connect(tree_, &QTreeWidget::itemDoubleClicked, this, &MaterialList::doubleClicked);
  connect(tree_, &QTreeWidget::itemChanged, this, [this](const QTreeWidgetItem* item) {
    if (!isFilling_) Q_EMIT renamed(entryOf(item)->material.name, item->text(0).trimmed());
  });
  auto* erase = new QShortcut(QKeySequence::Delete, tree_);
  erase->setContext(Qt::WidgetShortcut);
  connect(erase, &QShortcut::activated, this, &MaterialList::deletePressed);
}

void MaterialList::fill(const std::string& chosen) {
  isFilling_ = true;
  tree_->clear();
  entries_ = own_.list();
  const auto ownCount = entries_.size();
  const auto& library = modeling::materialLibrary();
  entries_.insert(entries_.end(), library.begin(), library.end());
  const ShownUnits units = settings_.units();
  constexpr int kDigits = 4;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const auto& [name, youngsModulus, poissonRatio, density] = entries_[i].material;
    auto* item = new QTreeWidgetItem(
        tree_,
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
    if (name == chosen) tree_->setCurrentItem(item);
  }
  isFilling_ = false;
  filter(filter_->text());
}

bool MaterialList::select(const modeling::Material& material) {
  for (int i = 0; i < tree_->topLevelItemCount(); ++i) {
    if (entryOf(tree_->topLevelItem(i))->material != material) continue;
    tree_->setCurrentItem(tree_->topLevelItem(i));
    return true;
  }
  return false;
}

void MaterialList::reveal() {
  QTreeWidgetItem* item = tree_->currentItem();
  if (!item) return;
  item->setHidden(false);
  tree_->scrollToItem(item);
}

void MaterialList::editName() {
  tree_->editItem(tree_->currentItem());
}

const modeling::LibraryMaterial* MaterialList::entryOf(const QTreeWidgetItem* item) const {
  return item ? &entries_[item->data(0, Qt::UserRole).toUInt()] : nullptr;
}

void MaterialList::filter(const QString& text) {
  for (int i = 0; i < tree_->topLevelItemCount(); ++i) {
    QTreeWidgetItem* item = tree_->topLevelItem(i);
    const modeling::LibraryMaterial& entry = *entryOf(item);
    const QString all = QString::fromStdString(entry.material.name + " " + entry.note);
    item->setHidden(!all.contains(text.trimmed(), Qt::CaseInsensitive));
  }
}

}  // namespace palpa::gui
