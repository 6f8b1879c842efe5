#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "modeling/solid/basis.h"
#include "modeling/solid/solid.h"

// The rows of control points that decide about the tangent planes along an edge. Internal to the
// files about tangent continuity.
namespace palpa::modeling {

/// Three rows of equal length in the growing parameter of edge.uses[0].
struct EdgeBand {
  enum Row { onEdge = 0, inFirst = 1, inSecond = 2 };

  int edge = -1;
  int degree = 0;
  std::vector<double> knots;
  std::array<std::vector<int>, 3> rows;  ///< control points; indexed by Row

  int length() const { return static_cast<int>(rows[onEdge].size()); }
};

EdgeBand bandOf(const Solid& solid, int edge);

/// Basis functions at `perSpan` + 1 equally spaced parameters of every span, ends included.
std::vector<BasisFunctions> bandSamples(const EdgeBand& band, int perSpan);

/// The two tangent planes at a point of the edge. With the derivatives a and b into the two patches
/// and e along the edge, all projected onto the plane normal to n, the three plane vectors are
/// dependent: kappa a + lambda b + mu e = 0. The planes agree where this holds in space.
struct TangentRelation {
  Eigen::Vector3d a = Eigen::Vector3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  Eigen::Vector3d e = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< mean of the two unit normals, unit
  double angle = 0.0;                                ///< between the planes, rad
  std::array<double, 3> factor{};  ///< kappa, lambda, mu, scaled: |kappa a + lambda b + mu e| is
                                   ///< the sine of the angle
};

/// Empty where a normal is undefined; normal and factors are zero where the two are opposite.
std::optional<TangentRelation> tangentRelation(const EdgeBand& band, const BasisFunctions& at,
                                               const std::vector<Eigen::Vector3d>& points);

}  // namespace palpa::modeling
