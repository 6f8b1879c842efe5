#include "bem/spline/spline_equations.h"

#include <algorithm>
#include <limits>

#include "bem/spline/spline_projection.h"

namespace palpa::bem {
namespace {

/// Gauss points per direction on the pieces of a cut element. With 3, pieces carried fewer points
/// than they have functions, and small nets became singular.
constexpr int kPointsOfPiece = 4;

/// Points per direction on a whole element, which shares most of its functions with its neighbours:
/// as many as there are functions per element, but at least 2.
int pointsPerDirection(const SplineSurface& surface, int index) {
  const SplineElement& element = surface.elements()[index];
  if (surface.elementsAt(element.patch, element.span[0], element.span[1]).size() > 1)
    return kPointsOfPiece;
  int points = 2;
  for (const BsplineBasis& basis : surface.patches()[element.patch].basis) {
    const auto spans = static_cast<int>(basis.spans().size());
    points = std::max(points, (basis.count() + spans - 1) / spans);
  }
  return points;
}

class Builder {
 public:
  Builder(const SplineSurface& surface, const SplineTractions& tractions,
          std::span<const int> extraSlots)
      : surface_(surface),
        tractions_(tractions),
        count_(surface.coefficientCount() + static_cast<int>(extraSlots.size())),
        ofExtraSlot_(tractions.slots.count(), -1),
        isAveraged_(count_, false) {
    for (std::size_t k = 0; k < extraSlots.size(); ++k)
      ofExtraSlot_[extraSlots[k]] = surface.coefficientCount() + static_cast<int>(k);
  }

  WeightedEquations build(std::span<const int> extraSlots) {
    const int coefficients = surface_.coefficientCount();
    std::vector<CollocationPlace> greville = grevilleCollocation(surface_);
    for (int k = 0; k < coefficients; ++k) {
      isAveraged_[k] = surface_.isTorn(k);
      if (!isAveraged_[k]) collocate(k, std::move(greville[k]));
    }
    for (std::size_t s = 0; s < extraSlots.size(); ++s) {
      const int equation = coefficients + static_cast<int>(s), slot = extraSlots[s];
      std::optional<CollocationPlace> point;
      if (!surface_.isTorn(tractions_.slots.slots[slot].node)) point = shiftedIntoPart(slot);
      isAveraged_[equation] = !point;
      if (point) collocate(equation, std::move(*point));
    }
    for (int e = 0; e < surface_.elementCount(); ++e) average(e);
    return finished();
  }

 private:
  using Weight = Eigen::Triplet<double>;

  /// Equation that contains function f of an element.
  int equationOf(int element, std::size_t f) const {
    const int extra = ofExtraSlot_[tractions_.ofFunction[element][f]];
    return extra >= 0 ? extra : surface_.functions(element)[f];
  }

  /// None if the border of the part passes very near to the Greville point.
  std::optional<CollocationPlace> shiftedIntoPart(int slot) const {
    constexpr double kShift = 0.4, kLeast = 0.01;
    std::optional<CollocationPlace> point = shiftedCollocation(surface_, tractions_, slot, kShift);
    if (surface_.owners().empty()) return point;
    for (double shift = kShift / 2; !point && shift > kLeast; shift /= 2)
      point = shiftedCollocation(surface_, tractions_, slot, shift);
    return point;
  }

  void collocate(int equation, CollocationPlace point) {
    weights_.emplace_back(equation, static_cast<int>(equations_.points.size()), 1.0);
    equations_.points.push_back(std::move(point));
  }

  /// Adds an element's share of ∫ N_k r dΓ to the averaged equations.
  void average(int element) {
    const std::size_t functions = surface_.functions(element).size();
    bool isAsked = false;
    for (std::size_t f = 0; f < functions; ++f)
      isAsked = isAsked || isAveraged_[equationOf(element, f)];
    if (!isAsked) return;
    visitSplinePoints(surface_, {element}, pointsPerDirection(surface_, element),
                      std::numeric_limits<double>::infinity(),
                      [&](const ElementPlace& place, const SurfaceJet& jet, double area) {
                        surface_.evaluateBasis(place, basis_);
                        const auto point = static_cast<int>(equations_.points.size());
                        for (std::size_t f = 0; f < functions; ++f)
                          if (const int k = equationOf(element, f); isAveraged_[k])
                            weights_.emplace_back(k, point, area * basis_[f]);
                        equations_.points.push_back({jet.position, {place}});
                      });
  }

  WeightedEquations finished() {
    std::vector<double> sums(count_, 0);
    for (const Weight& w : weights_) sums[w.row()] += w.value();
    for (Weight& w : weights_) w = {w.row(), w.col(), w.value() / sums[w.row()]};
    equations_.weights.resize(count_, static_cast<Eigen::Index>(equations_.points.size()));
    equations_.weights.setFromTriplets(weights_.begin(), weights_.end());
    return std::move(equations_);
  }

  const SplineSurface& surface_;
  const SplineTractions& tractions_;
  int count_;
  std::vector<int> ofExtraSlot_;  ///< equation of the slot; -1 for other slots
  std::vector<bool> isAveraged_;  ///< by equation
  std::vector<Weight> weights_;
  std::vector<double> basis_;
  WeightedEquations equations_;
};

}  // namespace

WeightedEquations splineEquations(const SplineSurface& surface, const SplineTractions& tractions,
                                  std::span<const int> extraSlots) {
  return Builder(surface, tractions, extraSlots).build(extraSlots);
}

}  // namespace palpa::bem
