#include "modeling/measure/measured_angle.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>

#include "modeling/error.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using What = MeasuredPlace::What;

double angleBetween(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Angle at a corner between the directions of two points.
MeasuredValue cornerAngle(const Vector3d& corner, const Vector3d& a, const Vector3d& b,
                          double size) {
  const Vector3d u = a - corner, v = b - corner;
  const double shorter = std::min(u.norm(), v.norm());
  if (!(shorter > 1e-9 * size))
    throw ModelingError("angle: two of its points are at one place; choose three different points");
  MeasuredValue value;
  value.value = angleBetween(u, v);
  value.accuracy = kMeasuredRounding * size / shorter;
  value.points = {corner, a, b};
  return value;
}

/// Angle between two tangent planes through the material: π minus the angle of the outward normals.
MeasuredValue faceAngle(const PlacePoint& a, const PlacePoint& b, double size) {
  MeasuredValue value;
  value.value = std::numbers::pi - angleBetween(a.normal, b.normal);
  value.accuracy = 10 * kMeasuredRounding;
  const Vector3d along = a.normal.cross(b.normal);
  if (along.norm() < 1e-6) {  // parallel
    value.points = {a.position, b.position};
    return value;
  }
  // The point of the common line of both planes that is nearest to the middle of both places.
  const Vector3d axis = along.normalized();
  const Vector3d middle = 0.5 * (a.position + b.position);
  Eigen::Matrix3d planes;
  planes << a.normal.transpose(), b.normal.transpose(), axis.transpose();
  const Vector3d corner = planes.fullPivLu().solve(
      Vector3d(a.normal.dot(a.position), b.normal.dot(b.position), axis.dot(middle)));
  const auto arm = [&](const PlacePoint& place) {
    const Vector3d way = place.position - corner;
    return Vector3d(way - axis.dot(way) * axis);
  };
  Vector3d first = arm(a), second = arm(b);
  const double least = 0.02 * size;
  if (first.norm() < least && second.norm() < least) {
    // Both places lie at the corner: the arms leave it into the faces.
    first = least * axis.cross(a.normal);
    second = -least * axis.cross(b.normal);
  } else if (first.norm() < least) {
    first = second.norm() * axis.cross(a.normal);
    if (std::abs(angleBetween(first, second) - value.value) > 1e-6) first = -first;
  } else if (second.norm() < least) {
    second = first.norm() * axis.cross(b.normal);
  }
  if (std::abs(angleBetween(first, second) - value.value) > 1e-6) second = -second;
  value.points = {corner, corner + first, corner + second};
  return value;
}

MeasuredValue edgeAngle(const MeasuredSurface& surface, const MeasuredPlace& a,
                        const MeasuredPlace& b) {
  const EdgePoint p = surface.edgeAt(a), q = surface.edgeAt(b);
  const auto ends = [&](const MeasuredPlace& place) {
    const std::vector<Vector3d> line = surface.edge(place).points;
    return std::array{line.front(), line.back()};
  };
  const std::array<Vector3d, 2> from = ends(a), to = ends(b);
  Vector3d u = p.tangent, v = q.tangent;
  MeasuredValue value;
  value.accuracy = 10 * kMeasuredRounding;
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k) {
      if ((from[i] - to[k]).norm() > 1e-9 * surface.size()) continue;
      if (u.dot(from[1 - i] - from[i]) < 0) u = -u;
      if (v.dot(to[1 - k] - to[k]) < 0) v = -v;
      value.value = angleBetween(u, v);
      const double length = std::max((p.position - from[i]).norm(), 0.05 * surface.size());
      value.points = {from[i], from[i] + length * u, from[i] + length * v};
      return value;
    }
  if (u.dot(v) < 0) v = -v;
  value.value = angleBetween(u, v);
  const double length = 0.5 * (q.position - p.position).norm() + 0.05 * surface.size();
  value.points = {p.position, p.position + length * u, p.position + length * v};
  return value;
}

MeasuredValue edgeAndFaceAngle(const EdgePoint& edge, const PlacePoint& face, double size) {
  const Vector3d flat = edge.tangent - edge.tangent.dot(face.normal) * face.normal;
  MeasuredValue value;
  value.value = std::atan2(std::abs(edge.tangent.dot(face.normal)), flat.norm());
  value.accuracy = 10 * kMeasuredRounding;
  const double length = 0.15 * size;
  const Vector3d way =
      flat.norm() > 1e-9 ? Vector3d(flat.normalized()) : face.normal.unitOrthogonal();
  value.points = {edge.position, edge.position + length * edge.tangent,
                  edge.position + length * way};
  return value;
}

}  // namespace

MeasuredValue angleOf(const MeasuredSurface& surface, const std::vector<MeasuredPlace>& places) {
  if (places.size() == 3)
    return cornerAngle(surface.at(places[1]).position, surface.at(places[0]).position,
                       surface.at(places[2]).position, surface.size());
  const MeasuredPlace &a = places[0], &b = places[1];
  if (a.what == What::kFace && b.what == What::kFace)
    return faceAngle(surface.at(a), surface.at(b), surface.size());
  if (a.what == What::kEdge && b.what == What::kEdge) return edgeAngle(surface, a, b);
  const bool edgeFirst = a.what == What::kEdge;
  return edgeAndFaceAngle(surface.edgeAt(edgeFirst ? a : b), surface.at(edgeFirst ? b : a),
                          surface.size());
}

}  // namespace palpa::modeling
