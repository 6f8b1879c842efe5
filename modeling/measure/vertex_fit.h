#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

// Curvatures from the vertices of a triangulated surface. Internal to modeling/measure.
namespace palpa::modeling {

/// A shape fitted by least squares to points that lie on it up to `deviation` (mm, largest).
struct RoundFit {
  double radius = 0;                                 ///< mm
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of a cylinder: a point of the axis
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();    ///< of a circle its normal; unit; zero: sphere
  double deviation = 0;                              ///< mm
};

/// Largest distance of the points from their plane of least squares, mm.
double flatDeviation(const std::vector<Eigen::Vector3d>& points);

/// Nothing where the points do not determine a sphere.
std::optional<RoundFit> fitSphere(const std::vector<Eigen::Vector3d>& points);

/// Cylinder along the direction that all `normals` are most perpendicular to. Nothing where the
/// points do not determine one.
std::optional<RoundFit> fitCylinder(const std::vector<Eigen::Vector3d>& points,
                                    const std::vector<Eigen::Vector3d>& normals);

/// Circle in the plane of the points. Nothing where they do not determine one.
std::optional<RoundFit> fitCircle(const std::vector<Eigen::Vector3d>& points);

/// Principal curvatures (1/mm, positive where the surface bends away from `normal`, the larger
/// magnitude first) at the first point, by a polynomial of the given degree through its neighbours
/// (CGAL's jet fitting). Nothing if the points do not determine it.
std::optional<Eigen::Vector2d> jetCurvatures(const std::vector<Eigen::Vector3d>& points,
                                             const Eigen::Vector3d& normal, int degree);

}  // namespace palpa::modeling
