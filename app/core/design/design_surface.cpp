#include "app/core/design/design_surface.h"

#include "app/core/setup/to_spline_surface.h"
#include "bem/base/triangle_rule.h"
#include "bem/element/element_contact_surface.h"
#include "bem/quadratic/quadratic_discretisation.h"
#include "bem/spline/spline_discretisation.h"
#include "modeling/error.h"

namespace palpa::app {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using modeling::SurfaceParameter;

/// Points per direction of a spline element: exact for the square of a cubic's slopes.
constexpr int kSplinePoints = 4;

std::vector<bem::SampledPoint> pointsOf(const std::vector<bem::FieldSampler::Block>& blocks) {
  std::vector<bem::SampledPoint> points;
  for (const auto& block : blocks)
    points.insert(points.end(), block.points.begin(), block.points.end());
  return points;
}

DesignSurface together(std::vector<bem::FieldSampler::Block> blocks, ShapeBasis basis) {
  DesignSurface surface{{}, std::move(basis)};
  for (auto& block : blocks) surface.sampler.add(std::move(block));
  return surface;
}

ShapeBasis basisOf(const bem::SplineDiscretisation& on, const modeling::Solid& solid,
                   const bem::SampledElements& sampled) {
  std::vector<SurfaceParameter> places;
  for (const bem::ElementPlace& place : sampled.places) {
    const Vector2d at = on.surface().parameters(place).parameters;
    places.push_back({on.surface().elements()[place.element].patch, at[0], at[1]});
  }
  ShapeBasis basis(solid);
  basis.add(places, pointsOf(sampled.blocks));
  return basis;
}

/// The parameters of a patch as a quadratic function of the geometric coordinates of an element.
class QuadraticParameters {
 public:
  QuadraticParameters(const bem::QuadraticSurface& surface, int element,
                      std::span<const bem::SplineMesh::Triangle> quarters) {
    // Quarters: (a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca).
    const std::array<Vector2d, 3> corner{quarters[0].corners[0], quarters[1].corners[1],
                                         quarters[2].corners[2]};
    const std::array<Vector2d, 3> middle{quarters[0].corners[1], quarters[1].corners[2],
                                         quarters[0].corners[2]};
    const std::vector<int>& nodes = surface.coefficients(element);
    std::array<Vector2d, 6> at;
    for (int k = 0; k < 3; ++k) {
      at[k] = corner[k];
      const bool from = surface.isOnBorder(nodes[k]), to = surface.isOnBorder(nodes[(k + 1) % 3]);
      const Vector2d &a = corner[k], &b = corner[(k + 1) % 3];
      // Edges from the border have their node at a quarter of the edge.
      at[3 + k] = from == to ? middle[k]
                  : from     ? Vector2d(-0.5 * a + 4.0 / 3 * middle[k] + b / 6)
                             : Vector2d(-0.5 * b + 4.0 / 3 * middle[k] + a / 6);
    }
    at_ = at;
  }
  Vector2d operator()(const Vector2d& geometric) const {
    const bem::QuadraticBasis basis(geometric[0], geometric[1]);
    Vector2d sum = Vector2d::Zero();
    for (int k = 0; k < 6; ++k) sum += basis.values[k] * at_[k];
    return sum;
  }

 private:
  std::array<Vector2d, 6> at_;
};

SurfaceParameter inRange(const modeling::Solid& solid, int patch, const Vector2d& at) {
  SurfaceParameter place{patch, at[0], at[1]};
  const auto [u0, u1] = solid.patches()[patch].range(0);
  const auto [v0, v1] = solid.patches()[patch].range(1);
  place.u = std::clamp(place.u, u0, u1);
  place.v = std::clamp(place.v, v0, v1);
  return place;
}

ShapeBasis basisOf(const bem::QuadraticDiscretisation& on, const modeling::Solid& solid,
                   const bem::SampledElements& sampled,
                   const std::vector<bem::SplineMesh::Triangle>& triangles) {
  std::vector<SurfaceParameter> places;
  for (const bem::ElementPlace& place : sampled.places) {
    const auto quarters =
        std::span(triangles).subspan(4 * static_cast<std::size_t>(place.element), 4);
    const QuadraticParameters parameters(on.surface(), place.element, quarters);
    places.push_back(
        inRange(solid, quarters[0].patch,
                parameters(on.surface().coordinates(place.element).geometric({place.u, place.v}))));
  }
  ShapeBasis basis(solid);
  basis.add(places, pointsOf(sampled.blocks));
  return basis;
}

const bem::QuadraticDiscretisation* quadraticOf(const TouchModel& model) {
  return dynamic_cast<const bem::QuadraticDiscretisation*>(model.setup().discretisation.get());
}

std::vector<bem::SplineMesh::Triangle> trianglesOf(const TouchModel& model,
                                                   const modeling::Solid& solid) {
  return splineTriangles(solid, modeling::SurfaceEvaluator(solid), model.surface());
}

DesignSurface ofFlat(const bem::Discretisation& on, const modeling::Solid& solid,
                     const modeling::SurfaceEvaluator& evaluator,
                     const std::vector<bem::SplineMesh::Triangle>& triangles) {
  DesignSurface surface{{}, ShapeBasis(solid)};
  const bem::DisplacementRecovery recovery(on.mesh(), on.meshSlots());
  std::vector<SurfaceParameter> all;
  for (int t = 0; t < on.mesh().triangleCount(); ++t) {
    const auto& corners = triangles[t].corners;
    std::vector<bem::SampledPoint> points;
    std::vector<Vector3d> places;
    std::vector<Eigen::Matrix<double, 3, 2>> tangents;
    Eigen::Matrix2d edges;
    edges.col(0) = corners[1] - corners[0];
    edges.col(1) = corners[2] - corners[0];
    for (const bem::TrianglePoint& each : bem::triangleRule7()) {
      const Vector3d weights(each.barycentric[0], each.barycentric[1], each.barycentric[2]);
      const Vector2d at = corners[0] + edges * weights.tail<2>();
      all.push_back(inRange(solid, triangles[t].patch, at));
      const modeling::SurfacePoint jet =
          evaluator.evaluate(triangles[t].patch, all.back().u, all.back().v);
      Eigen::Matrix<double, 3, 2> tangent;
      tangent.col(0) = jet.du;
      tangent.col(1) = jet.dv;
      tangent *= edges;
      const Vector3d area = tangent.col(0).cross(tangent.col(1));
      points.push_back({jet.position, bem::TangentFrame(tangent.col(0), tangent.col(1)).frame,
                        each.weight * area.norm() / 2});
      places.push_back(weights);
      tangents.push_back(tangent);
    }
    surface.sampler.add(bem::flatBlock(on.mesh(), on.meshSlots(), recovery, t, std::move(points),
                                       places, tangents));
  }
  surface.basis.add(all, surface.sampler.points());
  return surface;
}

}  // namespace

DesignSurface makeDesignSurface(const TouchModel& model) {
  const auto* solid = std::get_if<modeling::Solid>(&model.body());
  if (!solid)
    throw modeling::ModelingError(
        "body: a mesh body has no control points that a gradient could move; use a solid of "
        "patches");
  if (const auto& on = model.setup().splines) {
    bem::SampledElements sampled = bem::sampledSplines(
        on->surface(), on->elements(), bem::allElements(on->elements()), kSplinePoints);
    ShapeBasis basis = basisOf(*on, *solid, sampled);
    return together(std::move(sampled.blocks), std::move(basis));
  }
  if (const auto* on = quadraticOf(model)) {
    bem::SampledElements sampled =
        bem::sampledTriangles(on->surface(), bem::allElements(on->surface()), 1);
    ShapeBasis basis = basisOf(*on, *solid, sampled, trianglesOf(model, *solid));
    return together(std::move(sampled.blocks), std::move(basis));
  }
  return ofFlat(*model.setup().discretisation, *solid, modeling::SurfaceEvaluator(*solid),
                trianglesOf(model, *solid));
}

std::optional<MaskSurface> makeMaskSurface(const TouchModel& model,
                                           const bem::ContactSurface& surface,
                                           const bem::ContactMask& mask) {
  const auto* contact = dynamic_cast<const bem::ElementContactSurface*>(&surface);
  if (!contact) return std::nullopt;
  if (const auto& on = model.setup().splines)
    return MaskSurface{
        bem::sampledBumps(on->surface(), on->elements(), contact->elements(), mask.nodes),
        bem::MaskShares::kFunctions, std::make_unique<bem::MovingSplines>(on->surface())};
  const bem::QuadraticSurface& surfaceOfModel = quadraticOf(model)->surface();
  return MaskSurface{bem::sampledBumps(surfaceOfModel, contact->elements(), mask.nodes),
                     bem::MaskShares::kAreas,
                     std::make_unique<bem::MovingTriangles>(surfaceOfModel)};
}

}  // namespace palpa::app
