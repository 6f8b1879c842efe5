#include "app/core/setup/spline_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "app/core/setup/bump_places.h"
#include "app/core/setup/knot_chains.h"
#include "app/core/setup/span_subdivision.h"
#include "app/core/setup/support_borders.h"
#include "app/core/setup/touch_refinement.h"
#include "base/count_text.h"
#include "base/text.h"
#include "modeling/error.h"

namespace palpa::app {
namespace {

constexpr int kDegree = 3;
/// Minimum absolute cosine for which a border counts as running across a direction.
constexpr double kAcross = 0.75;
/// Maximum length of an element over the mean length of the design spans across it, until touches
/// give way.
constexpr double kMaxLengthRatio = 3;
/// Coefficients that are doubled per element that a border cuts, if it tears functions: the border
/// cuts 4 functions along it, and some of them barely reach across.
constexpr double kDoubledPerElement = 2.6;
/// Factor by which sizes grow until the budget is met, and how often at most (to 16 times the
/// requested size).
const double kStep = std::pow(2.0, 0.25);
constexpr int kMaxSteps = 16;
/// Touches of the project keep their elements during the first steps (other elements grow to almost
/// three times their size). From then on the budget is larger by the second factor.
constexpr int kStepsWithoutTouches = 6;
constexpr double kMoreForTouches = 1.4;

class RefinementBuilder {
 public:
  RefinementBuilder(const modeling::Project& project, const modeling::SurfaceEvaluator& surface)
      : solid_(std::get<modeling::Solid>(project.body)),
        surface_(surface),
        chains_(solid_, surface_),
        touches_(project, chains_, surface_),
        borders_(bordersOf(project, solid_, surface_)),
        hasRoots_(haveRoots(project.supports, solid_, surface_)) {
    factors_.resize(solid_.patches().size(), 1.0);
    for (const auto& [name, factor] : project.mesh.patchFactors)
      if (const auto patch = solid_.findPatch(name)) factors_[*patch] = factor;
    isFixed_.resize(solid_.patches().size(), false);
    for (const modeling::Support& support : project.supports) {
      if (!support.where.except.empty()) continue;  // parts of its patches may be free
      const std::vector<bool> isNamed = modeling::namedPatches(support.where.parts, solid_);
      for (std::size_t p = 0; p < isNamed.size(); ++p)
        if (isNamed[p]) isFixed_[p] = true;
    }
    for (const modeling::Load& load : project.loads)
      if (const auto* bump = std::get_if<modeling::Bump>(&load.what))
        bumpPlaces_.push_back(placesUnder(surface_, bump->center, bump->radius));
    for (int s = 0; s < chains_.count(); ++s) {
      const modeling::PatchDirection at = chains_[s].links.front().at;
      degrees_.push_back(std::max(kDegree, surface_.degree(at.patch, at.direction)));
    }
  }

  /// `growth`: factor on the limits that give way last.
  SplineRefinement make(const ElementSizes& sizes, double growth) {
    sizes_ = sizes;
    longest_ = kMaxLengthRatio * growth;
    SplineRefinement refinement;
    refinement.interior = sizes.interior;
    refinement.hasRoots = hasRoots_;
    ends_.clear();
    for (int s = 0; s < chains_.count(); ++s) ends_.push_back(endsOf(chains_[s]));
    if (std::isfinite(sizes_.touch)) touches_.resolve(sizes_.touch, degrees_, ends_);
    std::vector<double> rows;
    for (int s = 0; s < chains_.count(); ++s) {
      refinement.chains.push_back(refinedChain(s));
      rows.push_back(rowsOf(refinement.chains.back()));
    }
    refinement.coefficients = coefficientsOf(rows) + doubledCoefficients();
    return refinement;
  }

 private:
  static SupportBorders bordersOf(const modeling::Project& project, const modeling::Solid& solid,
                                  const modeling::SurfaceEvaluator& surface) {
    std::vector<modeling::Region> regions;
    for (const modeling::Support& support : project.supports) regions.push_back(support.where);
    return supportBorders(solid, surface, regions);
  }

  double meanSpan(modeling::PatchDirection at) const {
    return chains_.extent(at) / chains_[chains_.of(at)].spanCount();
  }

  /// Elements per span, borders of supports and touches left out.
  std::vector<int> elementsOf(const KnotChain& chain) const {
    std::vector<double> need(chain.spanCount(), 0);
    for (std::size_t l = 0; l < chain.links.size(); ++l) {
      const modeling::PatchDirection at = chain.links[l].at;
      const double size = std::min(sizes_.interior * factors_[at.patch],
                                   longest_ * meanSpan({at.patch, 1 - at.direction}));
      for (int k = 0; k < chain.spanCount(); ++k)
        need[k] = std::max({need[k], chain.spans[l][k].length / size,
                            chain.spans[l][k].turn / (sizes_.turn * factors_[at.patch])});
    }
    double total = 0;
    for (const double each : need) total += each;
    if (!(total < modeling::kMaxNetRows / 4.0))
      throw modeling::ModelingError(
          "spline elements of " + numberText(sizes_.interior) +
              " mm are too small for this body: a patch would get about " + estimateText(total) +
              " in one direction; at most " + countText(modeling::kMaxNetRows / 4.0) +
              " are possible: take longer elements",
          modeling::ModelingError::Kind::kTooLarge);
    return elementCounts(need);
  }

  /// True if a support ends along the lower or upper sides of a chain.
  bool endsAt(const KnotChain& chain, bool upper) const {
    return std::any_of(chain.links.begin(), chain.links.end(), [&](const auto& link) {
      const bool isUpper = upper != link.reversed;
      using modeling::Side;
      const Side side = link.at.direction == 0 ? (isUpper ? Side::kUMax : Side::kUMin)
                                               : (isUpper ? Side::kVMax : Side::kVMin);
      return borders_.edges[solid_.edgeOf(link.at.patch, side)] &&
             !(sizes_.isRimOutside && isFixed_[link.at.patch]);
    });
  }

  std::vector<SizeMark> marksOf(const KnotChain& chain) const {
    std::vector<SizeMark> marks;
    for (std::size_t l = 0; l < chain.links.size(); ++l) {
      const modeling::ChainLink& link = chain.links[l];
      const auto add = [&](double parameter, double size) {
        const double at = chains_.placeOf(link.at, parameter);
        const int span = std::clamp(static_cast<int>(at), 0, chain.spanCount() - 1);
        marks.push_back({at, chain.spans[l][span].length, factors_[link.at.patch] * size});
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

  /// Ends of the elements of a chain, touches left out.
  std::vector<double> endsOf(const KnotChain& chain) const {
    std::vector<int> counts = elementsOf(chain);
    const bool atLower = endsAt(chain, false), atUpper = endsAt(chain, true);
    if (atLower && atUpper && counts.size() == 1) counts[0] = std::max(counts[0], 2);
    const std::vector<double> rim = rimSizes(sizes_.rim);
    const std::vector<SizeMark> marks = marksOf(chain);
    std::vector<double> ends;
    for (int k = 0; k < chain.spanCount(); ++k)
      for (int i = 0; i < counts[k]; ++i) {
        const double low = k + static_cast<double>(i) / counts[k], size = 1.0 / counts[k];
        const bool isFirst = atLower && k == 0 && i == 0;
        const bool isLast = atUpper && k + 1 == chain.spanCount() && i + 1 == counts[k];
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

  SplineRefinement::Chain refinedChain(int chain) const {
    const modeling::PatchDirection first = chains_[chain].links.front().at;
    SplineRefinement::Chain refined{first, degrees_[chain], {}};
    for (const double end : ends_[chain])
      if (std::abs(end - std::round(end)) >= 1e-9)  // else a knot of the design
        refined.knots.push_back(chains_.parameterOf(first, end));
    return refined;
  }

  double rowsOf(const SplineRefinement::Chain& chain) const {
    const modeling::Patch& patch = solid_.patches()[chain.first.patch];
    const int d = chain.first.direction, degree = patch.degree[d];
    const auto before = static_cast<double>(patch.knots[d].size()) - degree - 1;
    // A raised degree adds this many functions per span.
    const double raised = (chain.degree - degree) *
                          static_cast<double>(surface_.spans(chain.first.patch, d).size() - 1);
    return before + raised + static_cast<double>(chain.knots.size());
  }

  /// Inner points of patches and edges, and vertices, of chains with these numbers of rows of
  /// functions.
  double coefficientsOf(const std::vector<double>& rows) const {
    double count = 0;
    for (int p = 0; p < surface_.patchCount(); ++p)
      count += (rows[chains_.of({p, 0})] - 2) * (rows[chains_.of({p, 1})] - 2);
    std::set<int> vertices;
    for (const modeling::SolidEdge& edge : solid_.edges()) {
      const modeling::PatchEdge& at = edge.uses[0];
      count += rows[chains_.of({at.patch, directionOf(at.side)})] - 2;
      vertices.insert(edge.vertices.begin(), edge.vertices.end());
    }
    return count + static_cast<double>(vertices.size());
  }

  double doubledCoefficients() const { return hasRoots_ ? 0 : kDoubledPerElement * cutElements(); }
  /// Approximate number of elements that borders of supports cut.
  double cutElements() const {
    std::set<std::array<std::ptrdiff_t, 3>> cut;
    for (const SupportBorders::Place& place : borders_.places) {
      std::array<std::ptrdiff_t, 3> element{place.patch, 0, 0};
      for (int d = 0; d < 2; ++d) {
        const std::vector<double>& ends = ends_[chains_.of({place.patch, d})];
        element[d + 1] = std::upper_bound(ends.begin(), ends.end(),
                                          chains_.placeOf({place.patch, d}, place.parameters[d])) -
                         ends.begin();
      }
      cut.insert(element);
    }
    return static_cast<double>(cut.size());
  }

  const modeling::Solid& solid_;
  const modeling::SurfaceEvaluator& surface_;
  KnotChains chains_;
  TouchRefinement touches_;
  SupportBorders borders_;
  bool hasRoots_;
  ElementSizes sizes_;
  double longest_ = kMaxLengthRatio;  ///< present value of kMaxLengthRatio
  std::vector<double> factors_;       ///< per patch
  std::vector<bool> isFixed_;         ///< per patch: a support fixes all of it
  std::vector<std::vector<BumpPlace>> bumpPlaces_;
  std::vector<int> degrees_;               ///< per chain
  std::vector<std::vector<double>> ends_;  ///< per chain: where its elements end
};

}  // namespace

SplineRefinement splineRefinement(const modeling::Project& project,
                                  const modeling::SurfaceEvaluator& surface,
                                  const ElementSizes& sizes) {
  RefinementBuilder builder(project, surface);
  ElementSizes tried = sizes;
  SplineRefinement refinement = builder.make(tried, 1);
  double budget = sizes.budget, growth = 1;  // of touches
  for (int step = 0; step < kMaxSteps && refinement.coefficients > budget; ++step) {
    if (step == kStepsWithoutTouches && !project.touches.empty()) {
      budget *= kMoreForTouches;
      if (refinement.coefficients <= budget) break;
    }
    if (step >= kStepsWithoutTouches) growth *= kStep;
    tried.touch = growth * sizes.touch;
    tried.interior *= kStep;
    tried.border *= kStep;
    tried.turn *= kStep;
    SplineRefinement next = builder.make(tried, growth);
    if (next.coefficients < refinement.coefficients) refinement = std::move(next);
  }
  return refinement;
}

modeling::Solid refined(const modeling::Solid& solid, const SplineRefinement& refinement) {
  modeling::Solid result = solid;
  for (const SplineRefinement::Chain& chain : refinement.chains) {
    if (result.patches()[chain.first.patch].degree[chain.first.direction] < chain.degree)
      result = modeling::elevateDegree(result, chain.first, chain.degree);
    result = modeling::insertKnots(result, chain.first, chain.knots);
  }
  return result;
}

}  // namespace palpa::app
