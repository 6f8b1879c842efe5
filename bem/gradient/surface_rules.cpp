#include "bem/gradient/surface_rules.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "bem/base/gauss_rule.h"
#include "bem/base/triangle_rule.h"
#include "bem/quadratic/quadratic_surface.h"
#include "bem/spline/spline_projection.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// Collects the points of a rule, element by element.
class RuleCollector {
 public:
  explicit RuleCollector(const ElementSurface& elements) : elements_(elements) {}

  void add(const ElementPlace& place, const SurfaceJet& jet, double weight) {
    if (place.element != element_) flush();
    element_ = place.element;
    const SurfaceTangents tangents = elements_.tangents(place);
    points_.push_back({jet.position, tangents.frame, weight});
    tangents_.push_back(tangents);
    all_.places.push_back(place);
  }

  SampledElements finish() {
    flush();
    return std::move(all_);
  }

 private:
  void flush() {
    if (points_.empty()) return;
    FieldSampler::Block block;
    block.points = std::move(points_);
    block.coefficients = elements_.coefficients(element_);
    block.slots = elements_.slots(element_);
    const Index count = static_cast<Index>(tangents_.size());
    block.displacement.resize(3 * count, static_cast<Index>(block.coefficients.size()));
    block.traction.resize(count, static_cast<Index>(block.slots.size()));
    for (Index k = 0; k < count; ++k) {
      const SurfaceTangents& at = tangents_[k];
      block.displacement.row(3 * k) = row(at.values);
      block.displacement.middleRows<2>(3 * k + 1) = at.slopes;
      block.traction.row(k) = row(at.tractionValues.empty() ? at.values : at.tractionValues);
    }
    all_.blocks.push_back(std::move(block));
    points_.clear();
    tangents_.clear();
  }

  static Eigen::RowVectorXd row(const std::vector<double>& values) {
    return Eigen::Map<const Eigen::RowVectorXd>(values.data(), static_cast<Index>(values.size()));
  }

  const ElementSurface& elements_;
  SampledElements all_;
  int element_ = -1;
  std::vector<SampledPoint> points_;
  std::vector<SurfaceTangents> tangents_;
};

}  // namespace

SampledElements sampledSplines(const SplineSurface& surface, const ElementSurface& functions,
                               const std::vector<int>& elements, int points) {
  RuleCollector collector(functions);
  visitSplinePoints(surface, elements, points, std::numeric_limits<double>::infinity(),
                    [&](const ElementPlace& place, const SurfaceJet& jet, double weight) {
                      collector.add(place, jet, weight);
                    });
  return collector.finish();
}

// The numbers of points along u and v are those with this product whose first two points are the
// contact's.
SampledElements sampledBumps(const SplineSurface& surface, const ElementSurface& functions,
                             const ContactElements& contact, std::span<const int> coefficients) {
  RuleCollector collector(functions);
  for (const int e : elementsOf(functions, coefficients)) {
    const SplineElement& element = surface.elements()[e];
    const Eigen::MatrixX3d& wanted = contact[e].bumpPoints;
    const auto placeOf = [&](double s, double t) {
      return ElementPlace{e, element.lower[0] + s * (element.upper[0] - element.lower[0]),
                          element.lower[1] + t * (element.upper[1] - element.lower[1])};
    };
    const int product = static_cast<int>(wanted.rows());
    int best = 1;
    double least = std::numeric_limits<double>::infinity();
    for (int n = 2; n <= kMaxGaussPoints; ++n) {
      if (product % n != 0 || product / n < 2 || product / n > kMaxGaussPoints) continue;
      const GaussRule &u = gaussRule(n), &v = gaussRule(product / n);
      double distance = 0;
      for (int k = 0; k < 2; ++k)
        distance += (surface.evaluate(placeOf(u.points[k], v.points[0])).position -
                     wanted.row(k).transpose())
                        .norm();
      if (distance >= least) continue;
      least = distance;
      best = n;
    }
    const GaussRule &u = gaussRule(best), &v = gaussRule(product / best);
    const double area =
        (element.upper[0] - element.lower[0]) * (element.upper[1] - element.lower[1]);
    for (std::size_t j = 0; j < v.points.size(); ++j)
      for (std::size_t i = 0; i < u.points.size(); ++i) {
        const ElementPlace place = placeOf(u.points[i], v.points[j]);
        const SurfaceJet jet = surface.evaluate(place);
        collector.add(place, jet, jet.areaVector().norm() * area * u.weights[i] * v.weights[j]);
      }
  }
  return collector.finish();
}

SampledElements sampledBumps(const QuadraticSurface& surface, const ContactElements& contact,
                             std::span<const int> coefficients) {
  RuleCollector collector(surface);
  for (const int e : elementsOf(surface, coefficients)) {
    const double perCell = static_cast<double>(triangleRule16().size());
    const int cells = static_cast<int>(
        std::lround(std::sqrt(static_cast<double>(contact[e].bumpWeights.size()) / perCell)));
    surface.visitPoints(e, cells,
                        [&](const ElementPlace& place, const SurfaceJet& jet, double weight) {
                          collector.add(place, jet, weight);
                        });
  }
  return collector.finish();
}

SampledElements sampledTriangles(const QuadraticSurface& surface, const std::vector<int>& elements,
                                 int cells) {
  RuleCollector collector(surface);
  for (const int e : elements)
    surface.visitPoints(e, cells,
                        [&](const ElementPlace& place, const SurfaceJet& jet, double weight) {
                          collector.add(place, jet, weight);
                        });
  return collector.finish();
}

Eigen::Matrix3Xd byMaterialPoints(const MovingElements& moving, const SampledElements& sampled,
                                  const ShapeDensity& density) {
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, moving.pointCount());
  MovingElements::Functions functions;
  Index q = 0;
  for (const FieldSampler::Block& block : sampled.blocks) {
    const int element = sampled.places[static_cast<std::size_t>(q)].element;
    const Eigen::Matrix3Xd positions = moving.positions(element);
    Eigen::Matrix3Xd byFunctions = Eigen::Matrix3Xd::Zero(3, positions.cols());
    for (const SampledPoint& point : block.points) {
      const ElementPlace& place = sampled.places[static_cast<std::size_t>(q)];
      moving.evaluate(element, moving.coordinates(place), functions);
      // ∂V/∂t_a = Σ_b (M⁻¹)_ba ∂V/∂c_b with M_ab = t_a·∂y/∂c_b.
      Eigen::Matrix2d metric;
      metric.col(0) = point.frame.leftCols<2>().transpose() * (positions * functions.du);
      metric.col(1) = point.frame.leftCols<2>().transpose() * (positions * functions.dv);
      const Eigen::Matrix<double, 3, 2> slope =
          density.slope.middleCols<2>(2 * q) * metric.inverse().transpose();
      byFunctions += density.value.col(q) * functions.value.transpose() +
                     slope.col(0) * functions.du.transpose() +
                     slope.col(1) * functions.dv.transpose();
      ++q;
    }
    moving.addTo(element, byFunctions, result);
  }
  return result;
}

std::vector<int> elementsOf(const ElementSurface& surface, std::span<const int> coefficients) {
  std::vector<bool> isWanted(static_cast<std::size_t>(surface.coefficientCount()), false);
  for (const int k : coefficients) isWanted[k] = true;
  std::vector<int> elements;
  for (int e = 0; e < surface.elementCount(); ++e) {
    const std::vector<int>& functions = surface.coefficients(e);
    if (std::any_of(functions.begin(), functions.end(), [&](int k) { return isWanted[k]; }))
      elements.push_back(e);
  }
  return elements;
}

std::vector<int> allElements(const ElementSurface& surface) {
  std::vector<int> all(static_cast<std::size_t>(surface.elementCount()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

TangentFrame::TangentFrame(const Vector3d& du, const Vector3d& dv) {
  frame.col(0) = du.normalized();
  frame.col(2) = du.cross(dv).normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  Eigen::Matrix2d metric;
  metric.col(0) = frame.leftCols<2>().transpose() * du;
  metric.col(1) = frame.leftCols<2>().transpose() * dv;
  slopes = metric.inverse().transpose();
}

FieldSampler::Block flatBlock(const BoundaryMesh& mesh, const TractionSlots& slots,
                              const DisplacementRecovery& recovery, int triangle,
                              std::vector<SampledPoint> points, std::span<const Vector3d> places,
                              std::span<const Eigen::Matrix<double, 3, 2>> tangents) {
  std::map<int, Index> columnOf;
  std::array<std::map<int, double>, 3> bulges;
  for (int a = 0; a < 3; ++a) {
    columnOf.try_emplace(mesh.triangles[triangle][a], 0);
    bulges[a] = recovery.bulge(triangle, a);
    for (const auto& [node, weight] : bulges[a]) columnOf.try_emplace(node, 0);
  }
  FieldSampler::Block block;
  for (auto& [node, column] : columnOf) {
    column = static_cast<Index>(block.coefficients.size());
    block.coefficients.push_back(node);
  }
  for (const int slot : slots.ofCorner[triangle]) block.slots.push_back(slot);
  const Index count = static_cast<Index>(points.size());
  block.displacement.setZero(3 * count, static_cast<Index>(block.coefficients.size()));
  block.traction.resize(count, 3);
  // Derivatives of the barycentric coordinates along the edges 0-1 and 0-2.
  constexpr std::array<std::array<double, 3>, 2> kSlopes{{{-1, 1, 0}, {-1, 0, 1}}};
  for (Index k = 0; k < count; ++k) {
    const Vector3d& at = places[k];
    const Eigen::Matrix2d slopes = TangentFrame(tangents[k].col(0), tangents[k].col(1)).slopes;
    const auto add = [&](int node, double value, double du, double dv) {
      const Index column = columnOf[node];
      block.displacement(3 * k, column) += value;
      block.displacement.col(column).segment<2>(3 * k + 1) += slopes * Eigen::Vector2d(du, dv);
    };
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3;
      add(mesh.triangles[triangle][a], at[a], kSlopes[0][a], kSlopes[1][a]);
      for (const auto& [node, weight] : bulges[a])
        add(node, weight * at[a] * at[b], weight * (kSlopes[0][a] * at[b] + at[a] * kSlopes[0][b]),
            weight * (kSlopes[1][a] * at[b] + at[a] * kSlopes[1][b]));
    }
    block.traction.row(k) = at.transpose();
  }
  block.points = std::move(points);
  return block;
}

}  // namespace palpa::bem
