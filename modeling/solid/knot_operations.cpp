#include "modeling/solid/knot_operations.h"

#include <Standard_Failure.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/solid/basis.h"
#include "modeling/solid/opencascade_surface.h"
#include "modeling/solid/surface_evaluator.h"
#include "modeling/solid/weld.h"

namespace palpa::modeling {
namespace {

constexpr double kSameKnot = 1e-9;     // of the range
constexpr double kNearestKnot = 1e-6;  // of the range; closer knots would make degenerate spans

/// Parameter relative to the distinct knots of a direction, equal for all links of a chain: at knot
/// `span` if the fraction is 0, otherwise after it.
struct KnotPlace {
  int span = 0;
  double fraction = 0.0;
};

double parameterAt(const KnotPlace& place, const std::vector<double>& values, bool reversed) {
  const int last = static_cast<int>(values.size()) - 1;
  if (place.fraction == 0.0) return values[reversed ? last - place.span : place.span];
  const int before = reversed ? last - place.span - 1 : place.span;
  const double fraction = reversed ? 1.0 - place.fraction : place.fraction;
  return values[before] + fraction * (values[before + 1] - values[before]);
}

std::string directionName(const Solid& solid, PatchDirection at) {
  return std::string(at.direction == 0 ? "u" : "v") + " of patch \"" +
         solid.patches()[at.patch].name + "\"";
}

/// Location of a parameter strictly inside the range. Throws ModelingError if it is outside.
KnotPlace placeOf(const Solid& solid, PatchDirection at, double parameter) {
  const std::vector<double> values = distinct(solid.patches()[at.patch].knots[at.direction]);
  const double length = values.back() - values.front();
  if (!(parameter > values.front() + kSameKnot * length &&
        parameter < values.back() - kSameKnot * length))
    throw ModelingError("at: " + numberText(parameter) + " is not inside the range of " +
                        directionName(solid, at) + " (" + numberText(values.front()) + " … " +
                        numberText(values.back()) + ")");
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::abs(parameter - values[i]) <= kSameKnot * length) return {static_cast<int>(i), 0.0};
  const auto above = std::upper_bound(values.begin(), values.end(), parameter);
  const double before = *(above - 1);
  return {static_cast<int>(above - values.begin()) - 1, (parameter - before) / (*above - before)};
}

/// Applies `change` to the surface and the knots of every link of the chain and welds the result.
Solid changed(
    const Solid& solid, PatchDirection at,
    const std::function<void(const ChainLink&, Geom_BSplineSurface&, PatchNet&)>& change) {
  std::vector<PatchNet> nets;
  for (std::size_t p = 0; p < solid.patches().size(); ++p)
    nets.push_back(netOf(solid, static_cast<int>(p)));
  std::vector<Handle(Geom_BSplineSurface)> surfaces(nets.size());
  try {
    for (const ChainLink& link : chainOf(solid, at)) {
      auto& surface = surfaces[link.at.patch];
      if (surface.IsNull())
        surface = makeSurface(solid.controlPoints(), solid.patches()[link.at.patch]);
      PatchNet& net = nets[link.at.patch];
      change(link, *surface, net);
      net.changed[link.at.direction] = true;
    }
    for (std::size_t p = 0; p < nets.size(); ++p)
      if (!surfaces[p].IsNull()) nets[p].points = polesOf(*surfaces[p]);
  } catch (const Standard_Failure& failure) {
    throw ModelingError("OpenCASCADE refuses the change of " + directionName(solid, at) + ": " +
                        failure.GetMessageString());
  }
  return weld(solid, nets);
}

/// Throws ModelingError if a parameter between knots is too close to one of them.
void requireDistance(const Solid& solid, PatchDirection at, double parameter,
                     const KnotPlace& place) {
  const std::vector<double> values = distinct(solid.patches()[at.patch].knots[at.direction]);
  const double nearest = kNearestKnot * (values.back() - values.front());
  for (double value : {values[place.span], values[place.span + 1]})
    if (std::abs(parameter - value) < nearest)
      throw ModelingError("at: " + numberText(parameter) + " is too close to the knot " +
                          numberText(value) + "; give exactly that knot, or one farther than " +
                          numberText(nearest) + " from it");
}

/// Inserts a knot at each of these distinct locations, in all links of the chain.
Solid withKnots(const Solid& solid, PatchDirection at, const std::vector<KnotPlace>& places,
                int times) {
  const Patch& patch = solid.patches()[at.patch];
  const auto rows = patch.knots[at.direction].size() - patch.degree[at.direction] - 1;
  if (rows + places.size() * times > static_cast<std::size_t>(kMaxNetRows))
    throw ModelingError("at: " + directionName(solid, at) + " would get more than " +
                            std::to_string(kMaxNetRows) + " rows of control points",
                        ModelingError::Kind::kTooLarge);
  return changed(
      solid, at, [&](const ChainLink& link, Geom_BSplineSurface& surface, PatchNet& net) {
        auto& own = net.knots[link.at.direction];
        const std::vector<double> before = distinct(own);
        std::vector<double> values;
        for (const KnotPlace& place : places)
          values.push_back(parameterAt(place, before, link.reversed));
        std::sort(values.begin(), values.end());
        const auto count = static_cast<int>(values.size());
        TColStd_Array1OfReal added(1, count);
        TColStd_Array1OfInteger multiplicities(1, count);
        for (int k = 0; k < count; ++k) {
          own.insert(std::upper_bound(own.begin(), own.end(), values[k]), times, values[k]);
          added.SetValue(k + 1, values[k]);
          multiplicities.SetValue(k + 1, times);
        }
        if (link.at.direction == 0)
          surface.InsertUKnots(added, multiplicities);
        else
          surface.InsertVKnots(added, multiplicities);
      });
}

}  // namespace

std::vector<ChainLink> chainOf(const Solid& solid, PatchDirection at) {
  std::vector<ChainLink> chain{{at, false}};
  for (std::size_t next = 0; next < chain.size(); ++next) {
    const ChainLink link = chain[next];
    const std::array<Side, 2> sides = link.at.direction == 0 ? std::array{Side::kVMin, Side::kVMax}
                                                             : std::array{Side::kUMin, Side::kUMax};
    for (Side side : sides) {
      const SolidEdge& edge = solid.edges()[solid.edgeOf(link.at.patch, side)];
      const bool isFirst = edge.uses[0].patch == link.at.patch && edge.uses[0].side == side;
      const PatchEdge other = edge.uses[isFirst ? 1 : 0];
      const ChainLink found{{other.patch, directionOf(other.side)}, link.reversed != edge.reversed};
      // A strip of patches that returned reversed would be a Möbius strip, which an oriented
      // surface does not contain: a direction is always found again with the same orientation.
      const bool known = std::any_of(chain.begin(), chain.end(), [&](const ChainLink& one) {
        return one.at.patch == found.at.patch && one.at.direction == found.at.direction;
      });
      if (!known) chain.push_back(found);
    }
  }
  return chain;
}

Solid insertKnot(const Solid& solid, PatchDirection at, double parameter, int times) {
  const Patch& patch = solid.patches().at(at.patch);
  const int degree = patch.degree[at.direction];
  if (times < 1 || times > degree)
    throw ModelingError("times: " + std::to_string(times) + " is outside 1 … " +
                        std::to_string(degree) + ", the degree in " + directionName(solid, at));
  const KnotPlace place = placeOf(solid, at, parameter);
  if (place.fraction == 0.0) {
    const std::vector<double>& knots = patch.knots[at.direction];
    const std::vector<double> values = distinct(knots);
    const auto present = std::count(knots.begin(), knots.end(), values[place.span]);
    if (present + times > degree)
      throw ModelingError("at: the knot " + numberText(values[place.span]) + " occurs " +
                          std::to_string(present) + " times in " + directionName(solid, at) +
                          "; with degree " + std::to_string(degree) +
                          " it may occur at most that often");
  } else {
    requireDistance(solid, at, parameter, place);
  }
  return withKnots(solid, at, {place}, times);
}

Solid insertKnots(const Solid& solid, PatchDirection at, std::vector<double> parameters) {
  if (parameters.empty()) return solid;
  std::sort(parameters.begin(), parameters.end());
  const auto [low, high] = solid.patches().at(at.patch).range(at.direction);
  std::vector<KnotPlace> places;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    places.push_back(placeOf(solid, at, parameters[k]));
    if (places.back().fraction == 0.0)
      throw ModelingError("at: " + numberText(parameters[k]) + " is already a knot of " +
                          directionName(solid, at));
    requireDistance(solid, at, parameters[k], places.back());
    if (k > 0 && parameters[k] - parameters[k - 1] < kNearestKnot * (high - low))
      throw ModelingError("at: " + numberText(parameters[k - 1]) + " and " +
                          numberText(parameters[k]) + " are too close to each other in " +
                          directionName(solid, at));
  }
  return withKnots(solid, at, places, 1);
}

KnotRemoval removeKnot(const Solid& solid, PatchDirection at, double parameter, int times,
                       double tolerance) {
  const Patch& patch = solid.patches().at(at.patch);
  const std::vector<double>& knots = patch.knots[at.direction];
  const KnotPlace place = placeOf(solid, at, parameter);
  if (place.fraction != 0.0) {
    std::string inner;
    const std::vector<double> values = distinct(knots);
    for (std::size_t i = 1; i + 1 < values.size(); ++i)
      inner += (inner.empty() ? "" : ", ") + numberText(values[i]);
    throw ModelingError(
        "at: " + numberText(parameter) + " is not a knot of " + directionName(solid, at) +
        (inner.empty() ? ", which has no inner knots" : "; the inner knots are " + inner));
  }
  const double knot = distinct(knots)[place.span];
  const auto present = static_cast<int>(std::count(knots.begin(), knots.end(), knot));
  if (times < 1 || times > present)
    throw ModelingError("times: " + std::to_string(times) + ", but the knot " + numberText(knot) +
                        " occurs " + std::to_string(present) + " times in " +
                        directionName(solid, at));
  constexpr double kAnyTolerance =
      1e30;  // the removal must not fail in OpenCASCADE: the deviation is measured below
  Solid result =
      changed(solid, at, [&](const ChainLink& link, Geom_BSplineSurface& surface, PatchNet& net) {
        auto& own = net.knots[link.at.direction];
        const std::vector<double> values = distinct(own);
        const double value = parameterAt(place, values, link.reversed);
        const auto first = std::lower_bound(own.begin(), own.end(), value);
        own.erase(first, first + times);
        const int index = static_cast<int>(std::lower_bound(values.begin(), values.end(), value) -
                                           values.begin());
        const bool done = link.at.direction == 0
                              ? surface.RemoveUKnot(index + 1, present - times, kAnyTolerance)
                              : surface.RemoveVKnot(index + 1, present - times, kAnyTolerance);
        if (!done)
          throw ModelingError("at: OpenCASCADE cannot remove the knot " + numberText(value) +
                              " of " + directionName(solid, link.at));
      });
  const double deviation = sampledDistance(solid, result);
  if (deviation > tolerance)
    throw ModelingError("tolerance_mm: without the knot " + numberText(knot) + " of " +
                        directionName(solid, at) + " the surface would move by up to " +
                        numberText(deviation) + " mm; " + numberText(tolerance) +
                        " mm are allowed");
  return {std::move(result), deviation};
}

Solid elevateDegree(const Solid& solid, PatchDirection at, int degree) {
  const int before = solid.patches().at(at.patch).degree[at.direction];
  if (degree <= before || degree > kMaxDegree)
    throw ModelingError("degree: " + std::to_string(degree) + "; " + directionName(solid, at) +
                        " has degree " + std::to_string(before) + " and can be raised to at most " +
                        std::to_string(kMaxDegree));
  return changed(
      solid, at, [&](const ChainLink& link, Geom_BSplineSurface& surface, PatchNet& net) {
        auto& own = net.knots[link.at.direction];
        for (double value : distinct(own))
          own.insert(std::upper_bound(own.begin(), own.end(), value), degree - before, value);
        net.degree[link.at.direction] = degree;
        surface.IncreaseDegree(net.degree[0], net.degree[1]);
      });
}

double sampledDistance(const Solid& a, const Solid& b) {
  constexpr int kSamplesPerSpan = 6;
  const SurfaceEvaluator first(a), second(b);
  double largest = 0.0;
  for (int patch = 0; patch < first.patchCount(); ++patch) {
    const auto samples = [&](int direction) {
      const auto& spans = first.spans(patch, direction);
      std::vector<double> result{spans.front()};
      for (std::size_t i = 1; i < spans.size(); ++i)
        for (int k = 1; k <= kSamplesPerSpan; ++k)
          result.push_back(spans[i - 1] + (spans[i] - spans[i - 1]) * k / kSamplesPerSpan);
      return result;
    };
    const auto other = [&](int direction, double t) {
      const auto [low, high] = first.range(patch, direction);
      const auto [otherLow, otherHigh] = second.range(patch, direction);
      return otherLow + (t - low) / (high - low) * (otherHigh - otherLow);
    };
    const std::vector<double> vSamples = samples(1);
    for (double u : samples(0))
      for (double v : vSamples)
        largest = std::max(largest, (first.position(patch, u, v) -
                                     second.position(patch, other(0, u), other(1, v)))
                                        .norm());
  }
  return largest;
}

}  // namespace palpa::modeling
