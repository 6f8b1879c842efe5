#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "modeling/solid/basis.h"
#include "modeling/solid/solid.h"

// Rows of control points that determine the tangent planes along an edge. Internal to the files
// about tangent continuity.
namespace palpa::modeling {

/// Band of three rows of equal length along an edge, in the growing parameter of edge.uses[0].
struct EdgeBand {
  enum Row { onEdge = 0, inFirst = 1, inSecond = 2 };

  int edge = -1;
  int degree = 0;
  std::vector<double> knots;
  std::array<std::vector<int>, 3> rows;  ///< control point indices; indexed by Row

  int length() const { return static_cast<int>(rows[onEdge].size()); }
};

/// Band of an edge (index into solid.edges()).
EdgeBand bandOf(const Solid& solid, int edge);

/// Basis functions at `perSpan` + 1 equally spaced parameters of every span, ends included.
std::vector<BasisFunctions> bandSamples(const EdgeBand& band, int perSpan);

/// Relation of the two tangent planes at a point of the edge. With the derivatives a and b into the
/// two patches and e along the edge, all projected onto the plane normal to n, the three plane
/// vectors are dependent: kappa a + lambda b + mu e = 0. The tangent planes agree if this also
/// holds in space.
struct TangentRelation {
  Eigen::Vector3d a = Eigen::Vector3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  Eigen::Vector3d e = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< normalised mean of the two unit normals
  double angle = 0.0;                                ///< between the planes, rad
  std::array<double, 3> factor{};  ///< kappa, lambda, mu, scaled such that |kappa a + lambda b + mu
                                   ///< e| is the sine of the angle
};

/// Relation at a point of the edge. Empty if a normal is undefined; normal and factors are zero if
/// the two normals are opposite.
std::optional<TangentRelation> tangentRelation(const EdgeBand& band, const BasisFunctions& at,
                                               const std::vector<Eigen::Vector3d>& points);

}  // namespace palpa::modeling
