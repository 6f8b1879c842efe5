#include "modeling/mesh/displayed_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "modeling/mesh/node_place.h"
#include "modeling/mesh/triangle_shape.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

class FlatShape final : public DisplayedShape {
 public:
  explicit FlatShape(const SurfaceMesh& mesh) : mesh_(mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& n = mesh.triangles[t];
      const auto& x = mesh.positions;
      const Vector3d unit = (x[n[1]] - x[n[0]]).cross(x[n[2]] - x[n[0]]).normalized();
      for (int k = 0; k < 3; ++k) {
        // Weighted by angle, so that the normal does not depend on the triangulation.
        const double angle = std::acos(cornerCosine(x[n[k]], x[n[(k + 1) % 3]], x[n[(k + 2) % 3]]));
        Vector3d& sum =
            normals_.try_emplace({n[k], mesh.smoothingGroupOfTriangle[t]}, Vector3d::Zero())
                .first->second;
        sum += angle * unit;
      }
    }
    for (auto& [key, sum] : normals_) sum.normalize();
  }

  Point onEdge(int a, int b, double s, int, int) const override {
    return {mesh_.positions[a] + s * (mesh_.positions[b] - mesh_.positions[a]), {}};
  }
  Point inTriangle(int triangle, const Vector3d& w) const override {
    const auto& [a, b, c] = mesh_.triangles[triangle];
    return {w[0] * mesh_.positions[a] + w[1] * mesh_.positions[b] + w[2] * mesh_.positions[c], {}};
  }
  Point atNode(int node) const override { return {mesh_.positions[node], {}}; }
  Vector3d normal(const Point&, int triangle, const Vector3d& weights) const override {
    Vector3d sum = Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
      sum += weights[k] *
             normals_.at({mesh_.triangles[triangle][k], mesh_.smoothingGroupOfTriangle[triangle]});
    return sum.normalized();
  }

 private:
  const SurfaceMesh& mesh_;
  std::map<std::pair<int, int>, Vector3d> normals_;  // per node and smoothing group
};

class SplineShape final : public DisplayedShape {
 public:
  SplineShape(const SurfaceMesh& mesh, const Solid& solid)
      : mesh_(mesh), solid_(solid), surface_(solid), groupOfPatch_(solid.patches().size(), -1) {
    for (const SurfaceParameter& at : mesh.parameters)
      places_.push_back(placeOf(solid, surface_, at));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      groupOfPatch_[mesh.patchOfTriangle[t]] = mesh.smoothingGroupOfTriangle[t];
  }

  Point onEdge(int a, int b, double s, int left, int right) const override {
    const int patch = mesh_.patchOfTriangle[left];
    if (patch != mesh_.patchOfTriangle[right])
      if (const auto point = onCommonEdge(a, b, s, patch, mesh_.patchOfTriangle[right]))
        return *point;
    const std::array<SurfaceParameter, 3> corners = cornersOf(left);
    const auto name = [&](int node) {
      const auto& n = mesh_.triangles[left];
      return corners[std::find(n.begin(), n.end(), node) - n.begin()];
    };
    const SurfaceParameter p = name(a);
    const SurfaceParameter q = name(b);
    return named({patch, p.u + s * (q.u - p.u), p.v + s * (q.v - p.v)});
  }

  Point inTriangle(int triangle, const Vector3d& w) const override {
    const auto [a, b, c] = cornersOf(triangle);
    return named({mesh_.patchOfTriangle[triangle], w[0] * a.u + w[1] * b.u + w[2] * c.u,
                  w[0] * a.v + w[1] * b.v + w[2] * c.v});
  }

  Point atNode(int node) const override { return {mesh_.positions[node], places_[node].at}; }

  Vector3d normal(const Point& point, int triangle, const Vector3d&) const override {
    const int group = mesh_.smoothingGroupOfTriangle[triangle];
    Vector3d sum = Vector3d::Zero();
    for (const SurfaceParameter& at : point.at)
      if (groupOfPatch_[at.patch] == group) sum += surface_.normal(at.patch, at.u, at.v);
    // A mesh edge beside the common edge of two patches has parameters in one patch only.
    if (sum.squaredNorm() == 0.0 && !point.at.empty())
      sum = surface_.normal(point.at[0].patch, point.at[0].u, point.at[0].v);
    return sum.normalized();
  }

 private:
  Point named(const SurfaceParameter& at) const {
    return {surface_.position(at.patch, at.u, at.v), {at}};
  }

  std::array<SurfaceParameter, 3> cornersOf(int triangle) const {
    const auto& [a, b, c] = mesh_.triangles[triangle];
    return cornersIn(surface_, mesh_.patchOfTriangle[triangle],
                     {&places_[a], &places_[b], &places_[c]});
  }

  std::optional<Point> onCommonEdge(int a, int b, double s, int left, int right) const {
    for (Side side : kSides) {
      const int index = solid_.edgeOf(left, side);
      const SolidEdge& edge = solid_.edges()[index];
      if (edge.uses[0].patch + edge.uses[1].patch != left + right ||
          (edge.uses[0].patch != left && edge.uses[1].patch != left))
        continue;
      const auto first = fractionOn(index, a);
      const auto second = fractionOn(index, b);
      if (!first || !second) continue;
      const double t = *first + s * (*second - *first);
      const SurfaceParameter p = modeling::onEdge(surface_, edge, 0, t);
      return Point{surface_.position(p.patch, p.u, p.v),
                   {p, modeling::onEdge(surface_, edge, 1, t)}};
    }
    return std::nullopt;
  }

  std::optional<double> fractionOn(int edge, int node) const {
    const NodePlace& place = places_[node];
    if (place.edge == edge) return place.edgeFraction;
    const auto& ends = solid_.edges()[edge].vertices;
    if (place.vertex >= 0 && place.vertex == ends[0]) return 0.0;
    if (place.vertex >= 0 && place.vertex == ends[1]) return 1.0;
    return std::nullopt;
  }

  const SurfaceMesh& mesh_;
  const Solid& solid_;
  SurfaceEvaluator surface_;
  std::vector<NodePlace> places_;
  std::vector<int> groupOfPatch_;
};

}  // namespace

std::unique_ptr<DisplayedShape> makeDisplayedShape(const SurfaceMesh& mesh, const Body& body) {
  const auto* solid = std::get_if<Solid>(&body);
  if (solid && !mesh.parameters.empty()) return std::make_unique<SplineShape>(mesh, *solid);
  return std::make_unique<FlatShape>(mesh);
}

}  // namespace palpa::modeling
