#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "bem/base/triangle_rule.h"
#include "bem/triangle/assembly.h"

namespace palpa::bench {

/// Accuracy of the plain assembly. Distances are in radii of the element.
struct PlainAccuracy {
  double far;   ///< beyond: the coarse rule
  double near;  ///< up to here: subdivision; between: the fine rule
  std::span<const bem::TrianglePoint> coarse, fine;
};
/// 3 and 7 points, a usual first choice: errors of about 1e-3 of a block.
PlainAccuracy looseAccuracy();
/// 7 and 16 points, at distances that give 1e-7, the tolerance of bem::assemble.
PlainAccuracy sameAccuracy();

/// Baseline: assembly as in a careful plain program. Point by point, with a coarse rule far away, a
/// fine one nearer and recursive subdivision close by, in scalar arithmetic, with kernels as
/// written in kelvin.h. Columns as in bem::assemble, rows 3 k + c for the k-th of `points`; no free
/// term. Runs on the job's threads.
void assemblePlain(const bem::BoundaryMesh& mesh, const bem::TractionSlots& slots,
                   const std::vector<Eigen::Vector3d>& points, const bem::Material& material,
                   const PlainAccuracy& accuracy, Eigen::MatrixXd& H, Eigen::MatrixXd& G,
                   const Job& job);

}  // namespace palpa::bench
