#include "shape_checks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modeling/error.h"
#include "modeling/mesh/mesh.h"
#include "modeling/solid/edge_curve.h"

namespace palpa::modeling::checks {
namespace {

ProfileCurve clampedUniform(int degree, std::vector<Eigen::Vector2d> points) {
  ProfileCurve curve{degree, {}, std::move(points)};
  const int spans = static_cast<int>(curve.points.size()) - degree;
  for (int i = -degree; i <= spans + degree; ++i) curve.knots.push_back(std::clamp(i, 0, spans));
  return curve;
}

}  // namespace

ProfileCurve polyline(std::vector<Eigen::Vector2d> points) {
  return clampedUniform(1, std::move(points));
}

ProfileCurve cubic(std::vector<Eigen::Vector2d> points) {
  return clampedUniform(3, std::move(points));
}

ProfileCurve roundCurve(double a, double b, const Eigen::Vector2d& centre) {
  constexpr int kCorners = 12;
  std::vector<Eigen::Vector2d> points{{a, 0.0}, {a, 0.16 * b}};
  for (int i = 1; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    points.emplace_back(a * std::cos(angle), b * std::sin(angle));
  }
  points.emplace_back(a, -0.16 * b);
  points.emplace_back(a, 0.0);
  for (Eigen::Vector2d& point : points) point += centre;
  return cubic(points);
}

EdgeAngles edgeAngles(const Solid& solid, double margin) {
  constexpr int kSamples = 40;
  const SurfaceEvaluator surface(solid);
  EdgeAngles result;
  for (const SolidEdge& edge : solid.edges())
    for (int i = 0; i <= kSamples; ++i) {
      const double t = margin + (1.0 - 2.0 * margin) * i / kSamples;
      std::array<Eigen::Vector3d, 2> normals;
      for (int use = 0; use < 2; ++use) {
        const SurfaceParameter at = onEdge(surface, edge, use, t);
        normals[use] = surface.normal(at.patch, at.u, at.v);
      }
      const double cosine = std::clamp(normals[0].dot(normals[1]), -1.0, 1.0);
      const double angle = std::acos(cosine) * 180.0 / std::numbers::pi;
      if (edge.smooth)
        result.largestSmooth = std::max(result.largestSmooth, angle);
      else
        result.smallestSharp = std::min(result.smallestSharp, angle);
    }
  return result;
}

double smallestMeshAngle(const Solid& solid, double edgeLength) {
  MeshSettings settings;
  settings.edgeLength = edgeLength;
  return measureQuality(mesh(solid, settings)).smallestAngle;
}

std::string refusal(const Primitive& primitive) {
  try {
    makePrimitive(primitive);
  } catch (const ModelingError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace palpa::modeling::checks
