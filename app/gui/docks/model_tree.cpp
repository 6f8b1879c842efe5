#include "app/gui/docks/model_tree.h"

#include <QColor>
#include <QGuiApplication>
#include <QHash>
#include <QIcon>
#include <QPalette>
#include <algorithm>

#include "app/gui/base/appearance.h"
#include "app/gui/document/measurements.h"
#include "app/gui/document/naming.h"

namespace palpa::gui {
namespace {

using RowKind = ModelTree::RowKind;
using Kind = Selection::Kind;

/// Row that holds a list, kind of its items, and how they are selected by name.
struct List {
  RowKind group, item;
  std::optional<Kind> kind;
};

/// In the order of ModelTree::lists_.
constexpr std::array<List, 6> kLists{
    {{RowKind::kPatches, RowKind::kPatch, {}},
     {RowKind::kEdges, RowKind::kEdge, {}},
     {RowKind::kSupports, RowKind::kSupport, Kind::kSupport},
     {RowKind::kLoads, RowKind::kLoad, Kind::kLoad},
     {RowKind::kTouches, RowKind::kTouch, Kind::kTouch},
     {RowKind::kMeasurements, RowKind::kMeasurement, Kind::kMeasurement}}};

/// Index of the list below a row; nothing for rows without a list.
std::optional<std::size_t> listOf(RowKind group) {
  for (std::size_t i = 0; i < kLists.size(); ++i)
    if (kLists[i].group == group) return i;
  return std::nullopt;
}

/// The list that contains rows of a kind; null for fixed rows.
const List* listWith(RowKind item) {
  const auto* found = std::find_if(kLists.begin(), kLists.end(),
                                   [&](const List& list) { return list.item == item; });
  return found == kLists.end() ? nullptr : &*found;
}

bool isListed(RowKind row) {
  return listWith(row) != nullptr;
}

/// Parent row; the project for the project itself.
RowKind parentOf(RowKind row) {
  if (const List* list = listWith(row)) return list->group;
  return row == RowKind::kPatches || row == RowKind::kEdges ? RowKind::kBody : RowKind::kProject;
}

std::optional<Kind> selectionKindOf(RowKind row) {
  const List* list = listWith(row);
  return list ? list->kind : std::nullopt;
}

QIcon cachedIcon(const QString& name) {
  static QHash<QString, QIcon> icons;
  auto found = icons.find(name);
  if (found == icons.end()) found = icons.insert(name, icon(name));
  return *found;
}

}  // namespace

ModelTree::ModelTree(Editor& editor, QObject* parent)
    : QAbstractItemModel(parent), editor_(editor) {
  connect(&editor, &Editor::projectReplaced, this, [this] {
    beginResetModel();
    showAll();
    endResetModel();
  });
  connect(&editor, &Editor::projectChanged, this, &ModelTree::showChange);
  connect(&editor.measurements(), &Measurements::changed, this,
          [this] { replace(RowKind::kMeasurements, measurementLines(editor_)); });
  connect(&editor.settings(), &Settings::changed, this, [this] {
    replace(RowKind::kMeasurements, measurementLines(editor_));
    const QModelIndex mesh = indexOf(RowKind::kMesh);
    Q_EMIT dataChanged(mesh, mesh.siblingAtColumn(1));
    replace(RowKind::kLoads, loadLines(editor_));
  });
  showAll();
}

void ModelTree::showAll() {
  hasEdges_ = editor_.solid() != nullptr;
  lists_ = {patchLines(editor_), edgeLines(editor_),  supportLines(editor_),
            loadLines(editor_),  touchLines(editor_), measurementLines(editor_)};
}

void ModelTree::showChange(const modeling::Change& change) {
  if (hasEdges_ != (editor_.solid() != nullptr)) {
    beginResetModel();
    showAll();
    endResetModel();
    return;
  }
  if (change.topology || change.patchNames) replace(RowKind::kPatches, patchLines(editor_));
  if (change.topology || change.patchNames || change.edges)
    replace(RowKind::kEdges, edgeLines(editor_));
  if (change.supports) replace(RowKind::kSupports, supportLines(editor_));
  if (change.loads) replace(RowKind::kLoads, loadLines(editor_));
  if (change.touches) replace(RowKind::kTouches, touchLines(editor_));
  const auto touch = [this](RowKind rowKind) {
    const QModelIndex row = indexOf(rowKind);
    Q_EMIT dataChanged(row, row.siblingAtColumn(1));
  };
  if (change.name) touch(RowKind::kProject);
  if (change.primitive || change.topology) touch(RowKind::kBody);
  if (change.material) touch(RowKind::kMaterial);
  if (change.mesh) touch(RowKind::kMesh);
}

void ModelTree::replace(RowKind parent, ModelLines lines) {
  ModelLines& old = lists_[*listOf(parent)];
  const QModelIndex row = indexOf(parent);
  const auto first = static_cast<int>(
      std::mismatch(old.begin(), old.end(), lines.begin(), lines.end()).first - old.begin());
  if (old.size() != lines.size()) {
    // Keep unchanged rows, so that the view keeps chosen and open rows.
    const int longest = static_cast<int>(std::min(old.size(), lines.size())) - first;
    int same = 0;
    while (same < longest && old[old.size() - 1 - same] == lines[lines.size() - 1 - same]) ++same;
    const int removed = static_cast<int>(old.size()) - first - same;
    const int added = static_cast<int>(lines.size()) - first - same;
    if (removed > 0) {
      beginRemoveRows(row, first, first + removed - 1);
      old.erase(old.begin() + first, old.begin() + first + removed);
      endRemoveRows();
    }
    if (added > 0) {
      beginInsertRows(row, first, first + added - 1);
      old = std::move(lines);
      endInsertRows();
    }
  } else if (first < static_cast<int>(old.size())) {
    old = std::move(lines);
    Q_EMIT dataChanged(index(first, 0, row), index(static_cast<int>(old.size()) - 1, 1, row));
  }
  Q_EMIT dataChanged(row, row.siblingAtColumn(1));
}

const ModelLines* ModelTree::linesOf(RowKind parent) const {
  const auto list = listOf(parent);
  return list ? &lists_[*list] : nullptr;
}

const std::vector<RowKind>& ModelTree::fixedChildren(RowKind parent) const {
  static const std::vector<RowKind> ofProject{
      RowKind::kBody,         RowKind::kSupports, RowKind::kLoads, RowKind::kTouches,
      RowKind::kMeasurements, RowKind::kMaterial, RowKind::kMesh};
  static const std::vector<RowKind> ofSolid{RowKind::kPatches, RowKind::kEdges};
  static const std::vector<RowKind> ofMesh{RowKind::kPatches};
  static const std::vector<RowKind> none;
  if (parent == RowKind::kProject) return ofProject;
  if (parent == RowKind::kBody) return hasEdges_ ? ofSolid : ofMesh;
  return none;
}

QModelIndex ModelTree::indexOf(RowKind rowKind) const {
  const RowKind group = isListed(rowKind) ? parentOf(rowKind) : rowKind;
  if (group == RowKind::kProject) return createIndex(0, 0, static_cast<quintptr>(group));
  const auto& siblings = fixedChildren(parentOf(group));
  const auto found = std::find(siblings.begin(), siblings.end(), group);
  if (found == siblings.end()) return {};
  return createIndex(static_cast<int>(found - siblings.begin()), 0, static_cast<quintptr>(group));
}

QModelIndex ModelTree::index(int row, int column, const QModelIndex& parent) const {
  if (!hasIndex(row, column, parent)) return {};
  if (!parent.isValid()) return createIndex(row, column, static_cast<quintptr>(RowKind::kProject));
  const RowKind above = kindOfRow(parent);
  const RowKind rowKind = linesOf(above) ? kLists[*listOf(above)].item : fixedChildren(above)[row];
  return createIndex(row, column, static_cast<quintptr>(rowKind));
}

QModelIndex ModelTree::parent(const QModelIndex& index) const {
  if (!index.isValid() || kindOfRow(index) == RowKind::kProject) return {};
  return indexOf(parentOf(kindOfRow(index)));
}

int ModelTree::rowCount(const QModelIndex& parent) const {
  if (!parent.isValid()) return 1;
  if (parent.column() > 0) return 0;
  const RowKind rowKind = kindOfRow(parent);
  if (const ModelLines* lines = linesOf(rowKind)) return static_cast<int>(lines->size());
  return static_cast<int>(fixedChildren(rowKind).size());
}

QVariant ModelTree::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const RowKind rowKind = kindOfRow(index);
  const ModelLines* siblings = isListed(rowKind) ? linesOf(parentOf(rowKind)) : nullptr;
  if (siblings && index.row() >= static_cast<int>(siblings->size())) return {};
  const ModelLine line = siblings ? (*siblings)[index.row()] : lineOf(rowKind, editor_);
  const bool isName = index.column() == 0;
  const ModelLines* below = linesOf(rowKind);
  switch (role) {
    case Qt::DisplayRole:
      if (isName) return line.name;
      return below ? QString::number(below->size()) : line.detail;
    case Qt::EditRole:
      return isName ? line.name : QVariant();
    case Qt::DecorationRole:
      return isName ? QVariant(cachedIcon(line.icon)) : QVariant();
    case Qt::ToolTipRole:
      return line.tip.isEmpty() ? line.name : line.name + "\n" + line.tip;
    case Qt::ForegroundRole:
      return isName ? QVariant() : QVariant(QGuiApplication::palette().placeholderText());
    case Qt::TextAlignmentRole:
      return isName ? QVariant() : QVariant(Qt::AlignRight | Qt::AlignVCenter);
    default:
      return {};
  }
}

Qt::ItemFlags ModelTree::flags(const QModelIndex& index) const {
  Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
  const RowKind rowKind = kindOfRow(index);
  const bool hasName =
      rowKind == RowKind::kProject || (isListed(rowKind) && rowKind != RowKind::kEdge);
  if (index.column() == 0 && hasName) flags |= Qt::ItemIsEditable;
  return flags;
}

bool ModelTree::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (role != Qt::EditRole || (flags(index) & Qt::ItemIsEditable) == 0) return false;
  const RowKind rowKind = kindOfRow(index);
  const QString name = value.toString();
  if (rowKind == RowKind::kProject) return renameProject(editor_, name);
  if (rowKind == RowKind::kPatch) return renamePatch(editor_, index.row(), name);
  return renameNamed(editor_, *selectionOf({index}, index).named, name);
}

Selection ModelTree::selectionOf(const QModelIndexList& rows, const QModelIndex& current) const {
  Selection selection;
  QModelIndexList listed;
  for (const QModelIndex& row : rows)
    if (row.column() == 0 && isListed(kindOfRow(row))) listed.push_back(row);
  if (listed.empty()) return selection;
  const bool currentCounts = listed.contains(current.siblingAtColumn(0));
  const QModelIndex leading = currentCounts ? current : listed.back();
  const RowKind rowKind = kindOfRow(leading);
  if (const auto kind = selectionKindOf(rowKind))
    return Selection::of(*kind, data(leading.siblingAtColumn(0)).toString().toStdString());
  for (const QModelIndex& row : listed)
    if (kindOfRow(row) == rowKind)
      (rowKind == RowKind::kPatch ? selection.patches : selection.edges).insert(row.row());
  return selection;
}

QItemSelection ModelTree::rowsOf(const Selection& selection) const {
  QItemSelection rows;
  const auto add = [&](RowKind parent, int row) {
    const QModelIndex above = indexOf(parent);
    if (row < rowCount(above)) rows.select(index(row, 0, above), index(row, 1, above));
  };
  for (int patch : selection.patches) add(RowKind::kPatches, patch);
  for (int edge : selection.edges) add(RowKind::kEdges, edge);
  if (selection.named) {
    const RowKind parent = std::find_if(kLists.begin(), kLists.end(), [&](const List& list) {
                             return list.kind == selection.named->kind;
                           })->group;
    const QString name = QString::fromStdString(selection.named->name);
    const ModelLines& lines = *linesOf(parent);
    for (int row = 0; row < static_cast<int>(lines.size()); ++row)
      if (lines[row].name == name) add(parent, row);
  }
  return rows;
}

}  // namespace palpa::gui
