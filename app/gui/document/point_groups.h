#pragma once

#include <set>
#include <vector>

#include "app/gui/document/selection.h"
#include "modeling/editing/command.h"
#include "modeling/solid/solid.h"

// Sets of control points.
namespace palpa::gui {

std::set<int> allPoints(const modeling::Solid& solid);

/// Points of a patch's net.
std::set<int> pointsOfPatch(const modeling::Solid& solid, int patch);

/// Points along an edge, including its ends.
std::set<int> pointsOfEdge(const modeling::Solid& solid, int edge);

/// Points moved by a motion of the selection: selected points and the points of selected patches
/// and edges.
std::set<int> pointsOf(const Selection& selection, const modeling::Solid& solid);

/// The points and their neighbours in the nets.
std::set<int> grown(const std::set<int>& points, const modeling::Solid& solid);
/// The points without the ones that have a neighbour outside.
std::set<int> shrunk(const std::set<int>& points, const modeling::Solid& solid);

/// All other points.
std::set<int> inverted(const std::set<int>& points, const modeling::Solid& solid);

/// Other points that a motion of `points` moves: mirror images, and points within the falloff of a
/// point or an image.
std::set<int> followersOf(const std::set<int>& points, const modeling::Reach& reach,
                          const modeling::Solid& solid);

Eigen::Vector3d meanOf(const std::set<int>& points, const modeling::Solid& solid);

/// Mean of the points' outward normals, of length 1; zero if they cancel.
Eigen::Vector3d meanNormal(const std::set<int>& points, const modeling::Solid& solid);

}  // namespace palpa::gui
