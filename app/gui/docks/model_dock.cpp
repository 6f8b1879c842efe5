#include "app/gui/docks/model_dock.h"

#include <QHeaderView>
#include <QMenu>
#include <QStyledItemDelegate>
#include <algorithm>

#include "app/gui/base/appearance.h"
#include "app/gui/document/body_places.h"
#include "app/gui/document/measurements.h"
#include "app/gui/document/naming.h"
#include "app/gui/document/point_groups.h"
#include "app/gui/view/scene_controller.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

using RowKind = ModelTree::RowKind;

namespace {

constexpr int kMaxNamePercent = 72;  // of the panel's width; the rest is left to the details

/// Limits the width of names, so that a long one leaves room for the details.
class NameDelegate : public QStyledItemDelegate {
 public:
  explicit NameDelegate(QTreeView& view) : QStyledItemDelegate(&view), view_(view) {}

  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    QSize size = QStyledItemDelegate::sizeHint(option, index);
    int depth = 1;
    for (QModelIndex above = index.parent(); above.isValid(); above = above.parent()) ++depth;
    const int most =
        view_.viewport()->width() * kMaxNamePercent / 100 - depth * view_.indentation();
    size.setWidth(std::min(size.width(), std::max(most, 0)));
    return size;
  }

 private:
  QTreeView& view_;
};

}  // namespace

ModelDock::ModelDock(const Workspace& workspace)
    : QDockWidget(tr("Model"), &workspace.window),
      workspace_(workspace),
      tree_(new ModelTree(workspace.editor, this)),
      view_(new QTreeView(this)) {
  setObjectName("model");
  view_->setObjectName("tree");
  view_->setAccessibleName(tr("Parts of the project"));
  view_->setModel(tree_);
  view_->setHeaderHidden(true);
  view_->setUniformRowHeights(true);
  view_->setIndentation(16);
  view_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  view_->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed);
  view_->setExpandsOnDoubleClick(false);
  view_->setContextMenuPolicy(Qt::CustomContextMenu);
  view_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  view_->setMinimumHeight(80);
  view_->header()->setStretchLastSection(false);
  view_->header()->setMinimumSectionSize(40);
  // A long detail, such as the name of a material, is cut before the names are.
  view_->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  view_->header()->setSectionResizeMode(1, QHeaderView::Stretch);
  view_->setItemDelegateForColumn(0, new NameDelegate(*view_));
  setWidget(view_);
  expandGroups();
  connect(tree_, &QAbstractItemModel::modelReset, this, [this] {
    expandGroups();
    showSelection();
  });
  // Added and removed rows change the choice of rows: restore it from the selection.
  connect(&workspace.editor, &Editor::projectChanged, this, [this](const modeling::Change& change) {
    if (change.topology || change.supports || change.loads || change.touches || change.measurements)
      showSelection();
  });
  connect(&workspace.editor, &Editor::selectionChanged, this, &ModelDock::showSelection);
  connect(view_->selectionModel(), &QItemSelectionModel::selectionChanged, this,
          &ModelDock::chooseRows);
  connect(view_, &QWidget::customContextMenuRequested, this, &ModelDock::showMenu);
  connect(view_, &QAbstractItemView::clicked, this, &ModelDock::announceRow);
  // Highlight the patch of the row under the pointer.
  view_->setMouseTracking(true);
  view_->viewport()->installEventFilter(this);
  connect(view_, &QAbstractItemView::entered, this, [this](const QModelIndex& index) {
    workspace_.scene.setHoveredPatch(
        ModelTree::kindOfRow(index) == RowKind::kPatch ? std::optional(index.row()) : std::nullopt);
  });
  connect(view_, &QAbstractItemView::viewportEntered, this,
          [this] { workspace_.scene.setHoveredPatch(std::nullopt); });
  // A double click edits a name; rows without a name open and close.
  connect(view_, &QTreeView::doubleClicked, this, [this](const QModelIndex& index) {
    const QModelIndex row = index.siblingAtColumn(0);
    if ((tree_->flags(row) & Qt::ItemIsEditable) == 0)
      view_->setExpanded(row, !view_->isExpanded(row));
  });
}

ModelDock::~ModelDock() {
  // Discard an unfinished name edit instead of applying it during destruction.
  isFollowing_ = true;
  view_->setModel(nullptr);
}

bool ModelDock::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Leave) workspace_.scene.setHoveredPatch(std::nullopt);
  return QDockWidget::eventFilter(watched, event);
}

void ModelDock::expandGroups() {
  // The long lists of patches and edges stay closed.
  for (const RowKind rowKind : {RowKind::kProject, RowKind::kBody, RowKind::kSupports,
                                RowKind::kLoads, RowKind::kTouches, RowKind::kMeasurements})
    view_->expand(tree_->indexOf(rowKind));
}

void ModelDock::showSelection() {
  if (isFollowing_) return;
  const Selection& selection = workspace_.editor.selection();
  const QItemSelectionModel* chosen = view_->selectionModel();
  // A row that selects nothing, such as the material, stays chosen.
  if (tree_->selectionOf(chosen->selectedIndexes(), chosen->currentIndex()) == selection) {
    const bool isMixed = !selection.empty() && chosen->selectedRows().size() !=
                                                   tree_->rowsOf(selection).indexes().size() / 2;
    if (!isMixed) return;
  }
  isFollowing_ = true;
  const QItemSelection rows = tree_->rowsOf(selection);
  view_->selectionModel()->select(rows, QItemSelectionModel::ClearAndSelect);
  if (!rows.isEmpty()) {
    const QModelIndex first = rows.indexes().front();
    if (!rows.contains(view_->currentIndex()))
      view_->selectionModel()->setCurrentIndex(first, QItemSelectionModel::NoUpdate);
    view_->scrollTo(first);
  }
  isFollowing_ = false;
}

void ModelDock::chooseRows() {
  if (isFollowing_) return;
  const QItemSelectionModel* chosen = view_->selectionModel();
  Selection selection = tree_->selectionOf(chosen->selectedIndexes(), chosen->currentIndex());
  workspace_.editor.select(std::move(selection));
  announceRow(chosen->currentIndex());
  // Deselect rows of other kinds after the view has handled the click.
  QMetaObject::invokeMethod(this, &ModelDock::showSelection, Qt::QueuedConnection);
}

void ModelDock::announceRow(const QModelIndex& row) {
  if (!row.isValid()) return;
  switch (ModelTree::kindOfRow(row)) {
    case RowKind::kMaterial:
      Q_EMIT rowChosen("material");
      return;
    case RowKind::kMesh:
      Q_EMIT rowChosen("mesh");
      return;
    case RowKind::kBody:
      Q_EMIT rowChosen("body");
      return;
    default:
      Q_EMIT rowChosen({});
  }
}

void ModelDock::showMenu(const QPoint& at) {
  const QModelIndex row = view_->indexAt(at).siblingAtColumn(0);
  if (!row.isValid()) return;
  Editor& editor = workspace_.editor;
  const RowKind rowKind = ModelTree::kindOfRow(row);
  const bool isNamed = rowKind == RowKind::kSupport || rowKind == RowKind::kLoad ||
                       rowKind == RowKind::kTouch || rowKind == RowKind::kMeasurement;
  auto* menu = new QMenu(this);
  menu->setObjectName("modelMenu");
  menu->setAttribute(Qt::WA_DeleteOnClose);
  const auto add = [&](const QString& text, const QString& picture, auto work) {
    QAction* action = menu->addAction(text);
    action->setObjectName(QString(text).remove('&'));
    if (!picture.isEmpty()) action->setIcon(icon(picture));
    connect(action, &QAction::triggered, this, work);
    return action;
  };
  if ((tree_->flags(row) & Qt::ItemIsEditable) != 0)
    add(tr("&Rename"), {}, [this, index = QPersistentModelIndex(row)] {
      view_->edit(index);
    })->setShortcut(Qt::Key_F2);
  if (isNamed) {
    add(tr("D&uplicate"), "add", [&editor] {
      if (editor.selection().named) duplicate(editor, *editor.selection().named);
    });
    add(tr("&Delete"), "delete", [&editor] {
      deleteSelected(editor);
    })->setShortcut(QKeySequence::Delete);
  }
  if (rowKind == RowKind::kMeasurement)
    add(tr("&Copy value"), {}, [&editor] { copyMeasurement(editor); });
  if (rowKind == RowKind::kPatch && editor.solid())
    add(tr("Select &points"), "net", [&editor] {
      editor.select(Selection::ofPoints(pointsOf(editor.selection(), *editor.solid())));
    });
  if (!menu->isEmpty()) menu->addSeparator();
  add(tr("&Zoom to"), "fit", [this] {
    workspace_.view.viewport().fitTo(
        placesOf(workspace_.editor.project(), workspace_.editor.selection()));
    workspace_.view.update();
  });
  menu->popup(view_->viewport()->mapToGlobal(at));
}

}  // namespace palpa::gui
