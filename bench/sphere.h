#pragma once

#include <Eigen/Core>
#include <vector>

#include "modeling/project/project.h"

namespace palpa::bench {

/// The seed's sphere: R = 25 mm, fixed below z = -20 mm; n is about 6 cells^2.
modeling::Project sphereProject(int cellsPerCubeEdge);

/// Places on the free part of the sphere, on a spiral.
std::vector<Eigen::Vector3d> pointsOnSphere(int count);

}  // namespace palpa::bench
