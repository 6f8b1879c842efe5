#include "app/core/setup/touch_refinement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "bem/spline/bspline_basis.h"
#include "bem/spline/spline_mask_widths.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

constexpr int kMaxDivisions = 60;  ///< for one place
/// A span of the design with at most this many equal elements gets one more equal element.
constexpr int kMaxEvenElements = 4;
/// Width of functions half-way to the border of a mask, over their width in its middle.
constexpr double kWiderAside = 1.25;
/// A patch counts as near a place if its distance exceeds the distance of the nearest patch by at
/// most this part of the touch's radius.
constexpr double kNear = 0.05;
/// The smallest contact of a ball that is resolved, over the ball's radius.
constexpr double kMinBallShare = 0.2;

/// Radius of the mask that a touch asks for, mm; none for a fingertip, which all places resolve.
std::optional<double> radiusOf(const modeling::Touch& touch) {
  if (!touch.radius || !modeling::infoOf(touch.kind).isBall) return touch.radius;
  // A ball in a half-space pressed in by d touches a circle of radius √(R d) (H. Hertz).
  const double depth = touch.vector.norm() / *touch.radius;
  return *touch.radius * std::clamp(std::sqrt(depth), kMinBallShare, 1.0);
}

struct Nearest {
  std::array<double, 2> parameters;
  double distance;
};

Nearest nearestOn(const modeling::SurfaceEvaluator& surface, int patch, const Vector3d& x) {
  constexpr int kSamples = 12, kSteps = 4;
  const std::array ranges{surface.range(patch, 0), surface.range(patch, 1)};
  Nearest best{{}, INFINITY};
  const auto consider = [&](std::array<double, 2> at) {
    const double distance = (surface.position(patch, at[0], at[1]) - x).norm();
    if (distance < best.distance) best = {at, distance};
  };
  for (int j = 0; j <= kSamples; ++j)
    for (int i = 0; i <= kSamples; ++i)
      consider({ranges[0][0] + (ranges[0][1] - ranges[0][0]) * i / kSamples,
                ranges[1][0] + (ranges[1][1] - ranges[1][0]) * j / kSamples});
  for (int step = 0; step < kSteps; ++step) {
    const auto [position, du, dv] = surface.evaluate(patch, best.parameters[0], best.parameters[1]);
    Eigen::Matrix<double, 3, 2> tangents;
    tangents << du, dv;
    const Eigen::Vector2d move = tangents.colPivHouseholderQr().solve(x - position);
    std::array<double, 2> next{};
    for (int d = 0; d < 2; ++d)
      next[d] = std::clamp(best.parameters[d] + move[d], ranges[d][0], ranges[d][1]);
    consider(next);
  }
  return best;
}

/// The functions of one direction of a patch at a place.
struct Functions {
  std::vector<double> values, deviations;  ///< mm
  int firstElement;                        ///< that they reach, among all of the direction
  std::vector<double> sizes;               ///< of the elements, mm
};

/// `breaks`: ends of the elements, `positions`: of the surface there.
Functions functionsAt(int degree, const std::vector<double>& breaks,
                      const std::vector<Vector3d>& positions, double parameter) {
  std::vector<double> knots(degree, breaks.front()), lengths{0};
  knots.insert(knots.end(), breaks.begin(), breaks.end());
  knots.insert(knots.end(), degree, breaks.back());
  for (std::size_t k = 1; k < positions.size(); ++k)
    lengths.push_back(lengths.back() + (positions[k] - positions[k - 1]).norm());
  const bem::BsplineBasis basis(degree, knots);
  int span = 0;
  while (span + 1 < static_cast<int>(basis.spans().size()) && basis.spans()[span].upper < parameter)
    ++span;
  Functions found;
  found.values.resize(degree + 1);
  std::vector<double> derivatives(degree + 1);
  basis.evaluate(span, parameter, found.values.data(), derivatives.data());
  for (int i = span; i <= span + degree; ++i) {
    // The width on even elements with the mean size of the covered ones (bem::SplineMaskWidths).
    const int first = std::max(i - degree, 0);
    const int last = std::min(i + 1, static_cast<int>(lengths.size()) - 1);
    found.deviations.push_back(std::sqrt((degree + 1) / 12.0) * (lengths[last] - lengths[first]) /
                               (last - first));
  }
  const int count = static_cast<int>(lengths.size()) - 1;
  found.firstElement = std::max(0, span - degree);
  for (int e = found.firstElement; e <= std::min(count - 1, span + degree); ++e)
    found.sizes.push_back(lengths[e + 1] - lengths[e]);
  return found;
}

/// Divides an element of a chain; one end is added. The whole span is divided evenly again if its
/// elements are equal and either few or the excess width of the functions (a factor above 1) is
/// small enough; otherwise the element is halved.
void divide(std::vector<double>& ends, std::size_t element, double excess) {
  const double low = element == 0 ? 0 : ends[element - 1], high = ends[element];
  const double span = std::floor((low + high) / 2), pieces = 1 / (high - low);
  const auto first = std::upper_bound(ends.begin(), ends.end(), span + 1e-9);
  const auto last = std::upper_bound(first, ends.end(), span + 1 + 1e-9);
  const auto count = last - first;
  bool isEven = std::abs(pieces - static_cast<double>(count)) < 1e-6 &&
                (count <= kMaxEvenElements || excess * pieces < pieces + 1);
  for (auto end = first; isEven && end != last; ++end)
    isEven = std::abs(*end - span - static_cast<double>(end - first + 1) / pieces) < 1e-6;
  if (!isEven) {
    ends.insert(ends.begin() + static_cast<std::ptrdiff_t>(element), (low + high) / 2);
    return;
  }
  const auto at = ends.erase(first, last - 1);
  std::vector<double> even;
  for (std::ptrdiff_t k = 1; k <= count; ++k)
    even.push_back(span + static_cast<double>(k) / static_cast<double>(count + 1));
  ends.insert(at, even.begin(), even.end());
}

/// Root of the larger eigenvalue of a² u uᵀ + b² v vᵀ for unit u and v with u·v = cosine.
double widest(double a, double b, double cosine) {
  const double sum = a * a + b * b, product = a * a * b * b * (1 - cosine * cosine);
  return std::sqrt(sum / 2 + std::sqrt(std::max(0.0, sum * sum / 4 - product)));
}

}  // namespace

TouchRefinement::TouchRefinement(const modeling::Project& project, const KnotChains& chains,
                                 const modeling::SurfaceEvaluator& surface)
    : chains_(chains), surface_(surface) {
  for (const modeling::Touch& touch : project.touches)
    if (const auto radius = radiusOf(touch)) addPlaces(touch.at, *radius, surface.patchCount());
}

void TouchRefinement::addPlaces(const Vector3d& at, double radius, int patchCount) {
  int nearest = 0;
  Nearest middle{{}, INFINITY};
  for (int patch = 0; patch < patchCount; ++patch)
    if (const Nearest found = nearestOn(surface_, patch, at); found.distance < middle.distance) {
      nearest = patch;
      middle = found;
    }
  const auto [center, du, dv] =
      surface_.evaluate(nearest, middle.parameters[0], middle.parameters[1]);
  const Vector3d normal = surface_.normal(nearest, middle.parameters[0], middle.parameters[1]);
  const Vector3d along = normal.unitOrthogonal(), across = normal.cross(along);
  const double half = radius / 2;
  for (const Vector3d& offset :
       {Vector3d(Vector3d::Zero()), Vector3d(half * along), Vector3d(-half * along),
        Vector3d(half * across), Vector3d(-half * across)}) {
    const double wanted = offset.isZero(0) ? radius : kWiderAside * radius;
    std::vector<Nearest> found;
    for (int patch = 0; patch < patchCount; ++patch)
      found.push_back(nearestOn(surface_, patch, center + offset));
    const double least =
        std::min_element(found.begin(), found.end(), [](const Nearest& a, const Nearest& b) {
          return a.distance < b.distance;
        })->distance;
    for (int patch = 0; patch < patchCount; ++patch)
      if (found[patch].distance <= least + kNear * radius)
        places_.push_back({patch, found[patch].parameters, wanted});
  }
}

bool TouchRefinement::divideAt(const Place& place, double radius, const std::vector<int>& degrees,
                               std::vector<std::vector<double>>& ends) const {
  std::array<Functions, 2> functions;
  for (int d = 0; d < 2; ++d) {
    const modeling::PatchDirection at{place.patch, d};
    std::vector<double> breaks{chains_.parameterOf(at, 0)};
    for (const double end : ends[chains_.of(at)]) breaks.push_back(chains_.parameterOf(at, end));
    std::sort(breaks.begin(), breaks.end());
    std::vector<Vector3d> positions;
    for (const double t : breaks)
      positions.push_back(d == 0 ? surface_.position(place.patch, t, place.parameters[1])
                                 : surface_.position(place.patch, place.parameters[0], t));
    functions[d] = functionsAt(degrees[chains_.of(at)], breaks, positions, place.parameters[d]);
  }
  const auto jet = surface_.evaluate(place.patch, place.parameters[0], place.parameters[1]);
  const double lengths = jet.du.norm() * jet.dv.norm();
  const double cosine = lengths > 0 ? jet.du.dot(jet.dv) / lengths : 0;
  double width = 0;
  std::array<double, 2> along{};
  for (int d = 0; d < 2; ++d)
    for (std::size_t i = 0; i < functions[d].values.size(); ++i)
      along[d] += functions[d].values[i] * functions[d].deviations[i];
  for (std::size_t i = 0; i < functions[0].values.size(); ++i)
    for (std::size_t j = 0; j < functions[1].values.size(); ++j)
      width += functions[0].values[i] * functions[1].values[j] *
               widest(functions[0].deviations[i], functions[1].deviations[j], cosine);
  const double excess = bem::SplineMaskWidths::kMinWidth * width / radius;
  if (excess <= 1) return false;

  const int d = along[0] >= along[1] ? 0 : 1;
  const modeling::PatchDirection at{place.patch, d};
  std::vector<double>& chainEnds = ends[chains_.of(at)];
  // Among elements of equal length, the one nearest to the place.
  const auto count = static_cast<int>(functions[d].sizes.size());
  int longest = 0;
  double most = 0;
  for (int e = 0; e < count; ++e) {
    const double size = functions[d].sizes[e] / (1 + 0.01 * std::abs(e - (count - 1) / 2.0));
    if (size > most) longest = e;
    most = std::max(most, size);
  }
  auto element = static_cast<std::size_t>(functions[d].firstElement + longest);
  if (chains_.linkOf(at).reversed) element = chainEnds.size() - 1 - element;
  divide(chainEnds, element, excess);
  return true;
}

void TouchRefinement::resolve(double part, const std::vector<int>& degrees,
                              std::vector<std::vector<double>>& ends) const {
  for (const Place& place : places_)
    for (int k = 0; k < kMaxDivisions && divideAt(place, part * place.radius, degrees, ends); ++k) {
    }
}

}  // namespace palpa::app
