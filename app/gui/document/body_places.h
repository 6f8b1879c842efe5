#pragma once

#include <Eigen/Core>
#include <set>
#include <vector>

#include "app/gui/document/editor.h"

// Where the things of a project are, to look at them.
namespace palpa::gui {

/// Control points of the patches of a solid; empty for a mesh body.
std::set<int> pointsOfPatches(const modeling::Body& body, const std::set<int>& patches);

/// Points around what is selected (mm), those of the whole body when nothing is.
std::vector<Eigen::Vector3d> placesOf(const modeling::Project& project, const Selection& selection);

}  // namespace palpa::gui
