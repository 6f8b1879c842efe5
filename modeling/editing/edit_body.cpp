#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "modeling/editing/apply_command.h"
#include "modeling/error.h"
#include "modeling/project/field_check.h"

namespace palpa::modeling {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Affine map x → linear x + shift. Vectors turn by `turn`, the map without scaling.
struct AffineMap {
  Matrix3d linear = Matrix3d::Identity();
  Vector3d shift = Vector3d::Zero();
  Matrix3d turn = Matrix3d::Identity();
  double scale = 1.0;  ///< of lengths; the geometric mean if it depends on the direction

  Vector3d operator()(const Vector3d& x) const { return linear * x + shift; }
};

AffineMap around(const Matrix3d& linear, const Vector3d& center, const Matrix3d& turn) {
  return {linear, center - linear * center, turn, 1.0};
}

AffineMap mapOf(const Translation& how) {
  requireFinite(how.vector, "translate_mm");
  return {Matrix3d::Identity(), how.vector, Matrix3d::Identity(), 1.0};
}

AffineMap mapOf(const Rotation& how) {
  requireDirection(how.axis, "rotate.axis");
  requireFinite(how.angleDegrees, "rotate.angle_deg");
  requireFinite(how.center, "rotate.center_mm");
  const Matrix3d turn =
      Eigen::AngleAxisd(how.angleDegrees * std::numbers::pi / 180.0, how.axis.stableNormalized())
          .toRotationMatrix();
  return around(turn, how.center, turn);
}

AffineMap mapOf(const Scaling& how) {
  for (int axis = 0; axis < 3; ++axis)
    requirePositive(how.factors[axis], "scale.factors[" + std::to_string(axis) + "]");
  requireFinite(how.center, "scale.center_mm");
  AffineMap map = around(how.factors.asDiagonal(), how.center, Matrix3d::Identity());
  const bool uniform = (how.factors.array() == how.factors[0]).all();
  map.scale = uniform ? how.factors[0] : std::cbrt(how.factors.prod());
  return map;
}

AffineMap mapOf(const MirrorPlane& how) {
  requireFinite(how.point, "mirror.point_mm");
  requireDirection(how.normal, "mirror.normal");
  const Vector3d n = how.normal.stableNormalized();
  const Matrix3d mirror = Matrix3d::Identity() - 2.0 * n * n.transpose();
  return around(mirror, how.point, mirror);
}

/// Exchanges u and v of a patch, which inverts its normal.
void exchangeParameters(Patch& patch) {
  std::vector<std::vector<int>> net(patch.net.front().size(), std::vector<int>(patch.net.size()));
  for (std::size_t i = 0; i < patch.net.size(); ++i)
    for (std::size_t j = 0; j < patch.net[i].size(); ++j) net[j][i] = patch.net[i][j];
  patch.net = std::move(net);
  std::swap(patch.degree[0], patch.degree[1]);
  std::swap(patch.knots[0], patch.knots[1]);
}

Side exchanged(Side side) {
  switch (side) {
    case Side::kVMin:
      return Side::kUMin;
    case Side::kUMin:
      return Side::kVMin;
    case Side::kVMax:
      return Side::kUMax;
    default:
      return Side::kVMax;
  }
}

Body transformed(const Solid& solid, const AffineMap& map) {
  std::vector<Vector3d> points = solid.controlPoints();
  for (Vector3d& point : points) point = map(point);
  if (map.linear.determinant() > 0.0) return solid.withControlPoints(std::move(points));
  std::vector<Patch> patches = solid.patches();
  for (Patch& patch : patches) exchangeParameters(patch);
  std::vector<PatchEdge> smooth;
  for (const SolidEdge& edge : solid.edges())
    if (edge.smooth) smooth.push_back({edge.uses[0].patch, exchanged(edge.uses[0].side)});
  return Solid(std::move(points), std::move(patches), smooth);
}

Body transformed(const MeshBody& body, const AffineMap& map) {
  MeshBody::Data data{body.positions(), body.triangles(), body.faceOfTriangle(), body.faceNames()};
  for (Vector3d& position : data.positions) position = map(position);
  if (map.linear.determinant() < 0.0)
    for (auto& triangle : data.triangles) std::swap(triangle[1], triangle[2]);
  return MeshBody(std::move(data));
}

/// Image of a half space. normal · x < below becomes (A⁻ᵀ normal) · x' < below + (A⁻ᵀ normal) ·
/// shift, scaled to the original length of the normal.
HalfSpace transformed(const HalfSpace& half, const AffineMap& map, const Matrix3d& inverse) {
  const Vector3d normal = inverse.transpose() * half.normal;
  const double scale = half.normal.stableNorm() / normal.stableNorm();
  return {scale * normal, scale * (half.below + normal.dot(map.shift))};
}

void transform(Region& region, const AffineMap& map, const Matrix3d& inverse) {
  for (auto* parts : {&region.parts, &region.except})
    for (RegionPart& part : *parts) {
      if (auto* half = std::get_if<HalfSpace>(&part)) *half = transformed(*half, map, inverse);
      if (auto* stroke = std::get_if<Stroke>(&part)) {
        for (Vector3d& point : stroke->points) point = map(point);
        stroke->radius *= map.scale;
      }
    }
}

/// Follows transformed(): mirrored patches exchange u and v.
void transform(MeasuredPlace& place, const AffineMap& map) {
  if (auto* position = std::get_if<Vector3d>(&place.at)) *position = map(*position);
  if (map.linear.determinant() > 0.0) return;
  if (auto* uv = std::get_if<Eigen::Vector2d>(&place.at)) std::swap(uv->x(), uv->y());
  if (place.side) place.side = exchanged(*place.side);
}

/// Points selected by position are selected by number afterwards, as boxes cannot turn; so are all
/// points of a mirrored body, whose nets exchange u and v.
void transform(Design& design, const Solid& before, const AffineMap& map) {
  if (design.along == Design::Along::kDirection) design.direction = map.turn * design.direction;
  for (MirrorPlane& plane : design.mirrors) {
    plane.point = map(plane.point);
    plane.normal = map.linear.inverse().transpose() * plane.normal;
  }
  if (!design.points) return;
  if (map.linear.determinant() > 0.0 && !selectsByPosition(*design.points)) return;
  try {
    design.points = PointSelection::of(selectPoints(*design.points, before));
  } catch (const ModelingError&) {
    return;  // it selects nothing before and after
  }
}

void transformConditions(Project& project, const AffineMap& map) {
  const Matrix3d inverse = map.linear.inverse();
  for (Support& support : project.supports) {
    transform(support.where, map, inverse);
    support.displacement = map.turn * support.displacement;
  }
  for (Load& load : project.loads) {
    if (Region* where = regionOf(load)) transform(*where, map, inverse);
    if (auto* traction = std::get_if<UniformTraction>(&load.what))
      traction->traction = map.turn * traction->traction;
    if (auto* total = std::get_if<TotalForce>(&load.what)) total->force = map.turn * total->force;
    if (auto* moment = std::get_if<Moment>(&load.what))
      moment->moment = map.turn.determinant() * (map.turn * moment->moment);
    if (auto* bump = std::get_if<Bump>(&load.what)) {
      bump->center = map(bump->center);
      bump->direction = map.turn * bump->direction;
    }
    // Gravity keeps its direction in space.
  }
  for (Touch& touch : project.touches) {
    touch.at = map(touch.at);
    touch.vector = map.turn * touch.vector;
  }
  for (Measurement& measurement : project.measurements)
    for (MeasuredPlace& place : measurement.places) transform(place, map);
}

}  // namespace

Edited applyTo(const TransformSolid& command, const Project& project) {
  const AffineMap map = std::visit([](const auto& how) { return mapOf(how); }, command.how);
  if (map.linear == Matrix3d::Identity() && map.shift == Vector3d::Zero()) return {project, 0.0};
  Edited result = withBody(
      project, std::visit([&](const auto& body) { return transformed(body, map); }, project.body));
  transformConditions(result.project, map);
  if (const auto* solid = std::get_if<Solid>(&project.body); solid && result.project.design)
    transform(*result.project.design, *solid, map);
  return result;
}

}  // namespace palpa::modeling
