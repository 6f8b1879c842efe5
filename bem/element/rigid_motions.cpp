#include "bem/element/rigid_motions.h"

#include <algorithm>

namespace palpa::bem {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

MatrixXd rigidMotions(const std::vector<Vector3d>& nodes, const Vector3d& centre) {
  MatrixXd motions(3 * static_cast<Index>(nodes.size()), 6);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    auto ofNode = motions.middleRows<3>(3 * static_cast<Index>(k));
    ofNode.leftCols<3>().setIdentity();
    for (int axis = 0; axis < 3; ++axis)
      ofNode.col(3 + axis) = Vector3d(Vector3d::Unit(axis)).cross(nodes[k] - centre);
  }
  return motions;
}

RigidCorrection::RigidCorrection(const ElementSurface& surface, const WeightedEquations& equations,
                                 const MatrixXd& motions)
    : surface_(surface), equations_(equations), motions_(motions), weights_(equations.weights) {}

std::vector<std::pair<int, Eigen::Matrix3d>> RigidCorrection::blocks(
    Index equation, const Eigen::Matrix<double, 3, 6>& residuals) const {
  std::vector<int> nodes;
  for (decltype(weights_)::InnerIterator w(weights_, equation); w; ++w)
    for (const ElementPlace& place : equations_.points[w.col()].places) {
      const std::vector<int>& ofElement = surface_.coefficients(place.element);
      nodes.insert(nodes.end(), ofElement.begin(), ofElement.end());
    }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  MatrixXd ofNodes(6, 3 * static_cast<Index>(nodes.size()));
  for (std::size_t k = 0; k < nodes.size(); ++k)
    ofNodes.middleCols<3>(3 * static_cast<Index>(k)) =
        motions_.middleRows<3>(3 * static_cast<Index>(nodes[k])).transpose();
  // Six conditions for many unknowns: of all solutions this is the smallest.
  const MatrixXd solution = ofNodes.completeOrthogonalDecomposition().solve(-residuals.transpose());
  std::vector<std::pair<int, Eigen::Matrix3d>> blocks;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    blocks.emplace_back(nodes[k], solution.middleRows<3>(3 * static_cast<Index>(k)).transpose());
  return blocks;
}

}  // namespace palpa::bem
