#pragma once

#include <Eigen/Core>
#include <vector>

#include "modeling/project/project.h"

namespace palpa::bench {

/// Reference sphere: R = 25 mm, fixed below z = -20 mm; n is about 6 cells^2.
modeling::Project sphereProject(int cellsPerCubeEdge);

/// Points on a spiral on the free part of the sphere.
std::vector<Eigen::Vector3d> pointsOnSphere(int count);

}  // namespace palpa::bench
