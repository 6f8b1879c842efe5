#pragma once

#include <QJsonObject>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/document/selection.h"
#include "modeling/body/body.h"

namespace palpa::gui {

/// A named selection of control points, patches or edges, in terms that survive edits of the body:
/// patches by name, edges by a side of a patch, points by their line of the net in parameters.
struct SelectionSet {
  struct Edge {
    std::string patch;
    modeling::Side side{};
    bool operator==(const Edge&) const = default;
  };
  /// Points of one patch.
  struct Points {
    std::string patch;
    /// Greville abscissae of the lines of control points in u and v when the set was named,
    /// ascending.
    std::array<std::vector<double>, 2> lines;
    std::vector<std::array<int, 2>> at;  ///< indices into `lines`
    bool operator==(const Points&) const = default;
  };

  std::string name;
  std::vector<std::string> patches;
  std::vector<Edge> edges;
  std::vector<Points> points;

  bool empty() const { return patches.empty() && edges.empty() && points.empty(); }
  bool operator==(const SelectionSet&) const = default;
};

/// The set of a selection; empty for named items of the project.
SelectionSet makeSet(const std::string& name, const Selection& selection,
                     const modeling::Body& body);

/// The selection in the present body. A control point belongs to it if it is the nearest one to a
/// point of the set, or lies between lines of the set on all sides. So the set is the same after a
/// motion of points, and after undo of any edit; a refined net has more points in the same part.
/// Patches and edges that no longer exist are left out.
Selection selectionOf(const SelectionSet& set, const modeling::Body& body);

void renamePatchIn(SelectionSet& set, const std::string& from, const std::string& to);

QJsonObject toJson(const SelectionSet& set);
/// Nothing for a damaged object.
std::optional<SelectionSet> selectionSetFromJson(const QJsonObject& object);

}  // namespace palpa::gui
