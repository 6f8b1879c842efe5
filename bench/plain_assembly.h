#pragma once
#include <Eigen/Dense>
#include <vector>

#include "bem/assembly.h"

namespace palpa::bench {

/// The baseline: what a careful plain program does. Point by point, 3 points far away, 7 nearer,
/// recursive subdivision close by, scalar arithmetic, kernels evaluated as written in kelvin.h.
/// Same columns as bem::assemble, rows 3 k + c for the k-th of `points`; no free term. Runs on the
/// job's threads.
void assemblePlain(const bem::BoundaryMesh& mesh, const bem::TractionSlots& slots,
                   const std::vector<Eigen::Vector3d>& points, const bem::Material& material,
                   Eigen::MatrixXd& H, Eigen::MatrixXd& G, const bem::Job& job);

}  // namespace palpa::bench
