#include "app/core/setup/spline_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "app/core/setup/knot_chains.h"
#include "app/core/setup/span_subdivision.h"
#include "app/core/setup/support_borders.h"
#include "app/core/setup/touch_refinement.h"
#include "base/text.h"
#include "modeling/error.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

constexpr int kDegree = 3;
/// Absolute cosine from which a border counts as running across a direction.
constexpr double kAcross = 0.75;
/// Length of an element over the mean length of the design's spans across, until touches give way.
constexpr double kMaxLengthRatio = 3;
/// Coefficients that are torn per element that a border cuts: 4 functions along it are cut, of
/// which some barely reach across.
constexpr double kTornPerElement = 2.6;
/// Sizes grow by this until the budget is kept, at most so often (to 16 times the wish).
const double kStep = std::pow(2.0, 0.25);
constexpr int kMaxSteps = 16;
/// Touches of the project keep their elements until all others are three times as long, and longer
/// where they can within this part more than the budget.
constexpr int kStepsWithoutTouches = 6;
constexpr double kMoreForTouches = 1.4;
/// A place on a patch near the centre of a bump.
struct BumpPlace {
  int patch;
  std::array<double, 2> parameters;
  double radius;  ///< of the bump, mm
};

/// Places within half of a bump's radius, where most of it acts, on a grid of samples.
std::vector<BumpPlace> placesUnder(const modeling::SurfaceEvaluator& surface,
                                   const Vector3d& center, double radius) {
  constexpr int kSamples = 24;
  std::vector<BumpPlace> places;
  for (int patch = 0; patch < surface.patchCount(); ++patch)
    for (int j = 0; j <= kSamples; ++j)
      for (int i = 0; i <= kSamples; ++i) {
        const auto [u0, u1] = surface.range(patch, 0);
        const auto [v0, v1] = surface.range(patch, 1);
        const double u = u0 + (u1 - u0) * i / kSamples, v = v0 + (v1 - v0) * j / kSamples;
        if ((surface.position(patch, u, v) - center).norm() < 0.5 * radius)
          places.push_back({patch, {u, v}, radius});
      }
  return places;
}

class NetMaker {
 public:
  explicit NetMaker(const modeling::Project& project)
      : solid_(std::get<modeling::Solid>(project.body)),
        surface_(solid_),
        strips_(solid_, surface_),
        touches_(project, strips_, surface_),
        borders_(bordersOf(project, solid_, surface_)) {
    factors_.resize(solid_.patches().size(), 1.0);
    for (const auto& [name, factor] : project.mesh.patchFactors)
      if (const auto patch = solid_.findPatch(name)) factors_[*patch] = factor;
    isHeld_.resize(solid_.patches().size(), false);
    for (const modeling::Support& support : project.supports)
      for (const auto& part : support.where.parts)
        if (const auto* whole = std::get_if<modeling::PatchSet>(&part))
          for (const std::string& name : whole->patches)
            if (const auto patch = solid_.findPatch(name)) isHeld_[*patch] = true;
    for (const modeling::Load& load : project.loads)
      if (const auto* bump = std::get_if<modeling::Bump>(&load.what))
        bumpPlaces_.push_back(placesUnder(surface_, bump->center, bump->radius));
    for (int s = 0; s < strips_.count(); ++s) {
      const modeling::PatchDirection at = strips_[s].links.front().at;
      degrees_.push_back(std::max(kDegree, surface_.degree(at.patch, at.direction)));
    }
  }

  /// `growth`: of what gives way last.
  SplineRefinement make(const ElementSizes& sizes, double growth) {
    sizes_ = sizes;
    longest_ = kMaxLengthRatio * growth;
    SplineRefinement net;
    net.interior = sizes.interior;
    ends_.clear();
    for (int s = 0; s < strips_.count(); ++s) ends_.push_back(endsOf(strips_[s]));
    if (std::isfinite(sizes_.touch)) touches_.resolve(sizes_.touch, degrees_, ends_);
    std::vector<double> rows;
    for (int s = 0; s < strips_.count(); ++s) {
      net.chains.push_back(chainOf(s));
      rows.push_back(rowsOf(net.chains.back()));
    }
    net.coefficients = coefficientsOf(rows) + kTornPerElement * cutElements();
    return net;
  }

 private:
  static SupportBorders bordersOf(const modeling::Project& project, const modeling::Solid& solid,
                                  const modeling::SurfaceEvaluator& surface) {
    std::vector<modeling::Region> regions;
    for (const modeling::Support& support : project.supports) regions.push_back(support.where);
    return supportBorders(solid, surface, regions);
  }

  double meanSpan(modeling::PatchDirection at) const {
    return strips_.extent(at) / strips_[strips_.of(at)].spanCount();
  }

  /// Elements that a span needs, before borders of supports.
  std::vector<int> piecesOf(const KnotChain& strip) const {
    std::vector<double> need(strip.spanCount(), 0);
    for (std::size_t l = 0; l < strip.links.size(); ++l) {
      const modeling::PatchDirection at = strip.links[l].at;
      const double size = std::min(sizes_.interior * factors_[at.patch],
                                   longest_ * meanSpan({at.patch, 1 - at.direction}));
      for (int k = 0; k < strip.spanCount(); ++k)
        need[k] = std::max({need[k], strip.spans[l][k].length / size,
                            strip.spans[l][k].turn / (sizes_.turn * factors_[at.patch])});
    }
    double total = 0;
    for (const double each : need) total += each;
    if (!(total < modeling::kMaxNetRows / 4.0))
      throw modeling::ModelingError(
          "spline elements of " + numberText(sizes_.interior) +
              " mm are too small for this body: a patch would get about " +
              numberText(std::round(total)) + " in one direction; at most " +
              numberText(modeling::kMaxNetRows / 4.0) + " are possible",
          modeling::ModelingError::Kind::kTooLarge);
    return evenPieces(need);
  }

  /// Does a support end along the lower or upper sides of a strip?
  bool endsAt(const KnotChain& strip, bool upper) const {
    return std::any_of(strip.links.begin(), strip.links.end(), [&](const auto& link) {
      const bool isUpper = upper != link.reversed;
      using modeling::Side;
      const Side side = link.at.direction == 0 ? (isUpper ? Side::kUMax : Side::kUMin)
                                               : (isUpper ? Side::kVMax : Side::kVMin);
      return borders_.edges[solid_.edgeOf(link.at.patch, side)] &&
             !(sizes_.isRimOutside && isHeld_[link.at.patch]);
    });
  }

  std::vector<DivisionMark> marksOf(const KnotChain& strip) const {
    std::vector<DivisionMark> marks;
    for (std::size_t l = 0; l < strip.links.size(); ++l) {
      const modeling::ChainLink& link = strip.links[l];
      const auto add = [&](double parameter, double size) {
        const double at = strips_.placeOf(link.at, parameter);
        const int span = std::clamp(static_cast<int>(at), 0, strip.spanCount() - 1);
        marks.push_back({at, strip.spans[l][span].length, factors_[link.at.patch] * size});
      };
      for (const SupportBorders::Place& place : borders_.places)
        if (place.patch == link.at.patch && place.along[link.at.direction] >= kAcross)
          add(place.parameters[link.at.direction], std::min(sizes_.border, place.radius / 2));
      for (const std::vector<BumpPlace>& places : bumpPlaces_)
        for (const BumpPlace& place : places)
          if (place.patch == link.at.patch)
            add(place.parameters[link.at.direction], sizes_.bump * place.radius);
    }
    return marks;
  }

  /// Where the elements of a strip end, without touches.
  std::vector<double> endsOf(const KnotChain& strip) const {
    std::vector<int> pieces = piecesOf(strip);
    const bool atLower = endsAt(strip, false), atUpper = endsAt(strip, true);
    if (atLower && atUpper && pieces.size() == 1) pieces[0] = std::max(pieces[0], 2);
    const std::vector<double> rim = rimSizes(sizes_.rim);
    const std::vector<DivisionMark> marks = marksOf(strip);
    std::vector<double> ends;
    for (int k = 0; k < strip.spanCount(); ++k)
      for (int i = 0; i < pieces[k]; ++i) {
        const double low = k + static_cast<double>(i) / pieces[k], size = 1.0 / pieces[k];
        const bool isFirst = atLower && k == 0 && i == 0;
        const bool isLast = atUpper && k + 1 == strip.spanCount() && i + 1 == pieces[k];
        if (!isFirst && !isLast) {
          halveAtMarks(low, low + size, marks, ends);
          continue;
        }
        double at = low;
        for (std::size_t r = 0; r < rim.size(); ++r) {
          const double next = at + size * (isFirst ? rim[r] : rim[rim.size() - 1 - r]);
          halveAtMarks(at, r + 1 < rim.size() ? next : low + size, marks, ends);
          at = next;
        }
      }
    return ends;
  }

  SplineRefinement::Chain chainOf(int strip) const {
    const modeling::PatchDirection first = strips_[strip].links.front().at;
    SplineRefinement::Chain chain{first, degrees_[strip], {}};
    for (const double end : ends_[strip])
      if (std::abs(end - std::round(end)) >= 1e-9)  // else a knot of the design
        chain.knots.push_back(strips_.parameterOf(first, end));
    return chain;
  }

  double rowsOf(const SplineRefinement::Chain& chain) const {
    const modeling::Patch& patch = solid_.patches()[chain.first.patch];
    const int d = chain.first.direction, degree = patch.degree[d];
    const auto before = static_cast<double>(patch.knots[d].size()) - degree - 1;
    // Each span between knots has so many more functions of its own.
    const double raised = (chain.degree - degree) *
                          static_cast<double>(surface_.spans(chain.first.patch, d).size() - 1);
    return before + raised + static_cast<double>(chain.knots.size());
  }

  /// Inner points of patches and edges, and vertices, of strips with so many rows of functions.
  double coefficientsOf(const std::vector<double>& rows) const {
    double count = 0;
    for (int p = 0; p < surface_.patchCount(); ++p)
      count += (rows[strips_.of({p, 0})] - 2) * (rows[strips_.of({p, 1})] - 2);
    std::set<int> vertices;
    for (const modeling::SolidEdge& edge : solid_.edges()) {
      const modeling::PatchEdge& at = edge.uses[0];
      count += rows[strips_.of({at.patch, directionOf(at.side)})] - 2;
      vertices.insert(edge.vertices.begin(), edge.vertices.end());
    }
    return count + static_cast<double>(vertices.size());
  }

  /// Elements that borders of supports cut, nearly.
  double cutElements() const {
    std::set<std::array<std::ptrdiff_t, 3>> cut;
    for (const SupportBorders::Place& place : borders_.places) {
      std::array<std::ptrdiff_t, 3> element{place.patch, 0, 0};
      for (int d = 0; d < 2; ++d) {
        const std::vector<double>& ends = ends_[strips_.of({place.patch, d})];
        element[d + 1] = std::upper_bound(ends.begin(), ends.end(),
                                          strips_.placeOf({place.patch, d}, place.parameters[d])) -
                         ends.begin();
      }
      cut.insert(element);
    }
    return static_cast<double>(cut.size());
  }

  const modeling::Solid& solid_;
  modeling::SurfaceEvaluator surface_;
  KnotChains strips_;
  TouchRefinement touches_;
  SupportBorders borders_;
  ElementSizes sizes_;
  double longest_ = kMaxLengthRatio;  ///< as kMaxLengthRatio
  std::vector<double> factors_;       ///< per patch
  std::vector<bool> isHeld_;          ///< per patch: a support holds all of it
  std::vector<std::vector<BumpPlace>> bumpPlaces_;
  std::vector<int> degrees_;               ///< per strip
  std::vector<std::vector<double>> ends_;  ///< per strip: where its elements end
};

}  // namespace

SplineRefinement splineRefinement(const modeling::Project& project, const ElementSizes& sizes) {
  NetMaker maker(project);
  ElementSizes tried = sizes;
  SplineRefinement net = maker.make(tried, 1);
  double budget = sizes.budget, growth = 1;  // of touches
  for (int step = 0; step < kMaxSteps && net.coefficients > budget; ++step) {
    if (step == kStepsWithoutTouches && !project.touches.empty()) {
      budget *= kMoreForTouches;
      if (net.coefficients <= budget) break;
    }
    if (step >= kStepsWithoutTouches) growth *= kStep;
    tried.touch = growth * sizes.touch;
    tried.interior *= kStep;
    tried.border *= kStep;
    tried.turn *= kStep;
    SplineRefinement next = maker.make(tried, growth);
    if (next.coefficients < net.coefficients) net = std::move(next);
  }
  return net;
}

modeling::Solid refined(const modeling::Solid& solid, const SplineRefinement& net) {
  modeling::Solid result = solid;
  for (const SplineRefinement::Chain& chain : net.chains) {
    if (result.patches()[chain.first.patch].degree[chain.first.direction] < chain.degree)
      result = modeling::elevateDegree(result, chain.first, chain.degree);
    result = modeling::insertKnots(result, chain.first, chain.knots);
  }
  return result;
}

}  // namespace palpa::app
