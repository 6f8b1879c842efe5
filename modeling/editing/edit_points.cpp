#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "modeling/editing/apply_command.h"
#include "modeling/editing/point_motion.h"
#include "modeling/error.h"
#include "modeling/project/field_check.h"
#include "modeling/solid/control_normals.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

Vector3d meanOf(const Solid& solid, const std::vector<int>& points) {
  Vector3d sum = Vector3d::Zero();
  for (int index : points) sum += solid.controlPoints()[index];
  return sum / static_cast<double>(points.size());
}

Vector3d centerOf(const std::optional<Vector3d>& given, const Solid& solid,
                  const std::vector<int>& points) {
  if (!given) return meanOf(solid, points);
  requireFinite(*given, "center_mm");
  return *given;
}

/// The project with moved points; the same project if no point moved.
Edited withMoved(const Project& project, const Solid& before, Solid after) {
  if (before.controlPoints() == after.controlPoints()) return {project, 0.0};
  return withBody(project, std::move(after));
}

Motion motionOf(const MoveBy& how, const Solid&, const std::vector<int>&, const Reach&) {
  requireFinite(how.vector, "by_mm");
  return [vector = how.vector](int, int) { return vector; };
}

Motion motionOf(const MoveTo& how, const Solid& solid, const std::vector<int>& points,
                const Reach&) {
  if (how.positions.size() != points.size())
    throw ModelingError("to_mm: " + std::to_string(how.positions.size()) + " positions for " +
                        std::to_string(points.size()) + " selected control points");
  std::vector<Vector3d> displacements(solid.controlPoints().size(), Vector3d::Zero());
  for (std::size_t k = 0; k < points.size(); ++k) {
    requireFinite(how.positions[k], "to_mm[" + std::to_string(k) + "]");
    displacements[points[k]] = how.positions[k] - solid.controlPoints()[points[k]];
  }
  return [all = std::move(displacements)](int, int leader) { return all[leader]; };
}

Motion motionOf(const MoveAlongNormal& how, const Solid& solid, const std::vector<int>& points,
                const Reach& reach) {
  requireFinite(how.distance, "along_normal_mm");
  std::vector<int> needed = points;
  if (reach.falloff) {
    needed.clear();
    for (std::size_t i = 0; i < solid.controlPoints().size(); ++i)
      needed.push_back(static_cast<int>(i));
  }
  const std::vector<Vector3d> normals = controlNormals(solid, needed);
  std::vector<Vector3d> all(solid.controlPoints().size(), Vector3d::Zero());
  for (std::size_t k = 0; k < needed.size(); ++k) all[needed[k]] = how.distance * normals[k];
  return [all = std::move(all)](int point, int) { return all[point]; };
}

}  // namespace

Edited applyTo(const MovePoints& command, const Project& project) {
  const Solid& solid = requireSolid(project);
  const std::vector<int> points = selectPoints(command.points, solid);
  const Motion motion = std::visit(
      [&](const auto& how) { return motionOf(how, solid, points, command.reach); }, command.how);
  Solid after = movePoints(solid, points, command.reach, motion);
  const auto* to = std::get_if<MoveTo>(&command.how);
  if (to && !command.reach.mirror) {
    // Given positions must be exact, but position plus difference rounds. Points that were moved to
    // keep edges smooth are not changed.
    std::vector<Vector3d> exact = after.controlPoints();
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vector3d& from = solid.controlPoints()[points[k]];
      Vector3d& result = exact[points[k]];
      if (result == from + (to->positions[k] - from)) result = to->positions[k];
    }
    after = after.withControlPoints(std::move(exact));
  }
  return withMoved(project, solid, std::move(after));
}

Edited applyTo(const ScalePoints& command, const Project& project) {
  const Solid& solid = requireSolid(project);
  const std::vector<int> points = selectPoints(command.points, solid);
  requireFinite(command.factors, "factors");
  const Vector3d center = centerOf(command.center, solid, points);
  const Vector3d change = command.factors - Vector3d::Ones();
  return withMoved(project, solid, movePoints(solid, points, command.reach, [&](int point, int) {
                     return Vector3d(change.cwiseProduct(solid.controlPoints()[point] - center));
                   }));
}

Edited applyTo(const RotatePoints& command, const Project& project) {
  const Solid& solid = requireSolid(project);
  const std::vector<int> points = selectPoints(command.points, solid);
  requireDirection(command.axis, "axis");
  requireFinite(command.angleDegrees, "angle_deg");
  const Vector3d center = centerOf(command.center, solid, points);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(command.angleDegrees * std::numbers::pi / 180.0,
                                                 command.axis.stableNormalized())
                                   .toRotationMatrix();
  const Eigen::Matrix3d change = turn - Eigen::Matrix3d::Identity();
  return withMoved(project, solid, movePoints(solid, points, command.reach, [&](int point, int) {
                     return Vector3d(change * (solid.controlPoints()[point] - center));
                   }));
}

Edited applyTo(const AlignPoints& command, const Project& project) {
  const Solid& solid = requireSolid(project);
  const std::vector<int> points = selectPoints(command.points, solid);
  const Vector3d mean = meanOf(solid, points);
  Vector3d normal;
  if (command.normal) {
    requireDirection(*command.normal, "normal");
    normal = command.normal->stableNormalized();
  } else {
    if (command.offset) throw ModelingError("offset_mm: needs a normal");
    // Least squares normal: the direction in which the points spread least.
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (int index : points) {
      const Vector3d d = solid.controlPoints()[index] - mean;
      spread += d * d.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(spread);
    if (points.size() < 3 || !(eigen.eigenvalues()[1] > 1e-12 * eigen.eigenvalues()[2]))
      throw ModelingError(
          "points: a best plane needs three control points that are not on a line; give a normal");
    normal = eigen.eigenvectors().col(0);
  }
  if (command.offset) requireFinite(*command.offset, "offset_mm");
  const double offset = command.offset ? *command.offset : normal.dot(mean);
  return withMoved(project, solid, movePoints(solid, points, {}, [&](int point, int) {
                     return Vector3d((offset - normal.dot(solid.controlPoints()[point])) * normal);
                   }));
}

}  // namespace palpa::modeling
