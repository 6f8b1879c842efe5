#pragma once

#include <Eigen/Core>
#include <vector>

#include "app/gui/document/selection.h"
#include "modeling/project/project.h"

// Positions of the items of a project, for fitting the view.
namespace palpa::gui {

/// Points around the selection (mm); points of the whole body without a selection.
std::vector<Eigen::Vector3d> placesOf(const modeling::Project& project, const Selection& selection);

}  // namespace palpa::gui
