#pragma once

#include <set>
#include <vector>

#include "app/gui/document/selection.h"
#include "modeling/editing/command.h"
#include "modeling/solid/solid.h"

// Sets of control points that belong together.
namespace palpa::gui {

std::set<int> allPoints(const modeling::Solid& solid);

/// The points of a patch's net.
std::set<int> pointsOfPatch(const modeling::Solid& solid, int patch);

/// The points along an edge, its ends included.
std::set<int> pointsOfEdge(const modeling::Solid& solid, int edge);

/// What a motion of the selection moves: the selected points and those of selected patches and
/// edges.
std::set<int> pointsOf(const Selection& selection, const modeling::Solid& solid);

/// The points and their neighbours in the nets.
std::set<int> grown(const std::set<int>& points, const modeling::Solid& solid);
/// Without those that have a neighbour outside.
std::set<int> shrunk(const std::set<int>& points, const modeling::Solid& solid);

/// The points that are not among the given ones.
std::set<int> inverted(const std::set<int>& points, const modeling::Solid& solid);

/// Which other points a motion of `points` takes along: mirror images, and what lies within the
/// falloff of a point or of an image.
std::set<int> followersOf(const std::set<int>& points, const modeling::Reach& reach,
                          const modeling::Solid& solid);

Eigen::Vector3d meanOf(const std::set<int>& points, const modeling::Solid& solid);

/// The mean of the points' outward normals, of length 1; zero where they cancel each other.
Eigen::Vector3d meanNormal(const std::set<int>& points, const modeling::Solid& solid);

}  // namespace palpa::gui
