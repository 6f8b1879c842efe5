#include "app/gui/dialogs/selection_sets_dialog.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QShortcut>
#include <QVBoxLayout>

namespace palpa::gui {

SelectionSetsDialog::SelectionSetsDialog(SelectionSets& sets, QWidget* parent)
    : QDialog(parent), sets_(sets), list_(new QTreeWidget(this)), buttons_(new QWidget(this)) {
  setObjectName("selectionSets");
  setWindowTitle(tr("Named selections"));
  list_->setObjectName("sets");
  list_->setAccessibleName(windowTitle());
  list_->setHeaderLabels({tr("Name"), tr("Content")});
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(true);
  list_->setEditTriggers(QAbstractItemView::EditKeyPressed);
  list_->header()->setStretchLastSection(false);
  list_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  list_->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  auto* column = new QVBoxLayout(buttons_);
  column->setContentsMargins(0, 0, 0, 0);
  select_ = addButton("select", tr("&Select"), tr("Select it and close this dialog (Enter)"));
  add_ = addButton("add", tr("&Add"), tr("Add it to the present selection"));
  replace_ = addButton("replace", tr("Re&place"), tr("Give its name to the present selection"));
  rename_ = addButton("rename", tr("&Rename"), tr("Change its name (F2)"));
  remove_ = addButton("remove", tr("&Delete"), tr("Delete the name; the body stays (Delete)"));
  auto* close = addButton("close", tr("&Close"), {});
  column->insertStretch(column->count() - 1);
  auto* line = new QHBoxLayout;
  line->addWidget(list_, 1);
  line->addWidget(buttons_);
  auto* note = new QLabel(
      tr("Saved with the project. A refined net has more points in the same part of the surface."),
      this);
  note->setWordWrap(true);
  note->setForegroundRole(QPalette::PlaceholderText);
  auto* all = new QVBoxLayout(this);
  all->addLayout(line, 1);
  all->addWidget(note);
  select_->setDefault(true);
  connect(select_, &QPushButton::clicked, this, [this] {
    sets_.choose(chosen());
    accept();
  });
  connect(add_, &QPushButton::clicked, this, [this] { sets_.choose(chosen(), true); });
  connect(replace_, &QPushButton::clicked, this, [this] { sets_.put(chosen()); });
  connect(rename_, &QPushButton::clicked, this, [this] { list_->editItem(list_->currentItem()); });
  connect(remove_, &QPushButton::clicked, this, [this] { sets_.remove(chosen()); });
  connect(close, &QPushButton::clicked, this, &QDialog::reject);
  auto* erase = new QShortcut(QKeySequence::Delete, list_);
  erase->setContext(Qt::WidgetShortcut);
  connect(erase, &QShortcut::activated, remove_, &QPushButton::click);
  connect(list_, &QTreeWidget::itemDoubleClicked, select_, &QPushButton::click);
  connect(list_, &QTreeWidget::currentItemChanged, this, &SelectionSetsDialog::update);
  connect(list_, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item) {
    if (isFilling_) return;
    // A name in use is refused: the list shows the former one again.
    const QString to = item->text(0);
    if (!sets_.rename(item->data(0, Qt::UserRole).toString(), to))
      QMetaObject::invokeMethod(this, &SelectionSetsDialog::fill, Qt::QueuedConnection);
  });
  connect(&sets, &SelectionSets::changed, this, &SelectionSetsDialog::fill, Qt::QueuedConnection);
  fill();
  list_->setFocus();
  resize(460, 320);
}

QPushButton* SelectionSetsDialog::addButton(const QString& name, const QString& text,
                                            const QString& tip) {
  auto* button = new QPushButton(text, buttons_);
  button->setObjectName(name);
  button->setToolTip(tip);
  button->setAutoDefault(false);
  buttons_->layout()->addWidget(button);
  return button;
}

void SelectionSetsDialog::fill() {
  const int row = list_->indexOfTopLevelItem(list_->currentItem());
  isFilling_ = true;
  list_->clear();
  for (const QString& name : sets_.names()) {
    auto* item = new QTreeWidgetItem(list_, {name, sets_.contentOf(name)});
    item->setFlags(item->flags() | Qt::ItemIsEditable);
    item->setData(0, Qt::UserRole, name);
  }
  const int count = list_->topLevelItemCount();
  if (count > 0) list_->setCurrentItem(list_->topLevelItem(std::clamp(row, 0, count - 1)));
  isFilling_ = false;
  update();
}

QString SelectionSetsDialog::chosen() const {
  const QTreeWidgetItem* item = list_->currentItem();
  return item ? item->data(0, Qt::UserRole).toString() : QString();
}

void SelectionSetsDialog::update() {
  const bool isAny = list_->currentItem();
  for (QPushButton* button : {select_, add_, rename_, remove_}) button->setEnabled(isAny);
  replace_->setEnabled(isAny && sets_.canName());
}

}  // namespace palpa::gui
