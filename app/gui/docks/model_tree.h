#pragma once

#include <QAbstractItemModel>
#include <QItemSelection>
#include <array>
#include <optional>
#include <vector>

#include "app/gui/docks/model_lines.h"
#include "app/gui/document/editor.h"

namespace palpa::gui {

/// Item model of the open project: body with patches and edges, supports, loads, touches,
/// measurements, material and mesh. Column 0 has editable names, column 1 a detail. Follows the
/// editor.
class ModelTree : public QAbstractItemModel {
  Q_OBJECT

 public:
  using RowKind = ModelRow;

  ModelTree(Editor& editor, QObject* parent);

  static RowKind kindOfRow(const QModelIndex& index) {
    return static_cast<RowKind>(index.internalId());
  }
  /// The row with everything of one kind: the row itself, or the parent of listed rows.
  QModelIndex indexOf(RowKind rowKind) const;

  /// Selection for the chosen rows. If they have several kinds, the kind of `current` is used.
  Selection selectionOf(const QModelIndexList& rows, const QModelIndex& current) const;
  QItemSelection rowsOf(const Selection& selection) const;

  QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
  QModelIndex parent(const QModelIndex& index) const override;
  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& = {}) const override { return 2; }
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  /// Renames. Editor::refused states why a name is impossible.
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;

 private:
  void showAll();
  void showChange(const modeling::Change& change);
  const ModelLines* linesOf(RowKind parent) const;
  void replace(RowKind parent, ModelLines lines);
  const std::vector<RowKind>& fixedChildren(RowKind parent) const;

  Editor& editor_;
  bool hasEdges_ = true;
  std::array<ModelLines, 6> lists_;  // patches, edges, supports, loads, touches, measurements
};

}  // namespace palpa::gui
