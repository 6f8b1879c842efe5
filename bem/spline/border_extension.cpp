#include "bem/spline/border_extension.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "bem/spline/function_sides.h"
#include "bem/spline/spline_extrapolation.h"

namespace palpa::bem {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Width of the weight in sizes of the cut elements. From 1.5 to 6 the errors hardly differ; wide
/// bands cost more.
constexpr double kWidth = 2;
/// Order of the polynomials that extrapolations continue. In supports linear ones cost accuracy
/// (c_sph_equator with 1,178 coefficients: 0.5 % of u instead of 0.2 %); on the free side they do
/// not.
constexpr int kMaxOrderInSupport = 3, kMaxOrderOfFree = 1;
constexpr int kReach = 6;  ///< functions beyond the function that is extrapolated
/// Largest sum of the weights' sizes. Cubic extrapolation by one function has 15, quadratic by two
/// 17, linear by one in both directions 9. With quadratic ones by two, matrices became nearly
/// singular (condition 1e8 instead of 4e4) for a few borders that run oblique to the knots.
constexpr double kMaxSum = 16;

class Extension {
 public:
  Extension(SplineSurface& surface, const std::vector<LevelFunction>& levels)
      : surface_(surface),
        occurrences_(occurrences(surface)),
        owners_(sidesOfFunctions(surface, occurrences_)) {
    for (std::size_t k = 0; k < levels.size(); ++k)
      borders_.push_back({levels[k], kWidth * elementSize(static_cast<int>(k))});
  }

  void apply() {
    std::vector<std::optional<SplineSurface::ElementFunctions>> functions;
    for (int e = 0; e < surface_.elementCount(); ++e) functions.push_back(functionsOf(e));
    surface_.setBorders(std::move(borders_), std::move(owners_), std::move(functions));
  }

 private:
  struct Weight {
    int coefficient;
    double weight;
  };

  /// Mean size of the knot rectangles with elements on both sides of a border, or beside it if it
  /// runs along knots, mm.
  double elementSize(int border) const {
    double sum = 0, sumBeside = 0;
    int count = 0, countBeside = 0;
    for (int e = 0; e < surface_.elementCount(); ++e) {
      if (surface_.side(e) != border) continue;
      const SplineElement& element = surface_.elements()[e];
      const double size = rectangleSize(element);
      sumBeside += size;
      ++countBeside;
      for (const int piece : surface_.elementsAt(element.patch, element.span[0], element.span[1]))
        if (surface_.side(piece) != border) {
          sum += size;
          ++count;
          break;
        }
    }
    if (count > 0) return sum / count;
    return countBeside > 0 ? sumBeside / countBeside : 1;
  }

  double rectangleSize(const SplineElement& element) const {
    std::array<double, 2> low{}, high{};
    for (int d = 0; d < 2; ++d) {
      const auto& span = surface_.patches()[element.patch].basis[d].spans()[element.span[d]];
      low[d] = span.lower;
      high[d] = span.upper;
    }
    const int e = surface_.elementsAt(element.patch, element.span[0], element.span[1]).front();
    const auto at = [&](double u, double v) { return surface_.positionAt(e, {u, v}); };
    return std::sqrt((at(high[0], high[1]) - at(low[0], low[1])).norm() *
                     (at(high[0], low[1]) - at(low[0], high[1])).norm() / 2);
  }

  bool isUsable(int k, int side) const { return bem::isUsable(owners_[k], side); }

  std::optional<SplineSurface::ElementFunctions> functionsOf(int e) {
    const int side = surface_.side(e);
    if (side == SplineSurface::kFixedPatch) return {};
    const std::vector<int>& net = surface_.net(e);
    const int patch = surface_.elements()[e].patch;
    SplineSurface::ElementFunctions result;
    BorderFunctions& functions = result.functions;
    std::vector<int> near;  // borders
    sample(e, functions.samples, near);
    functions.isSupport = side != SplineSurface::kFree;
    functions.isWeighted = functions.isSupport
                               ? std::find(near.begin(), near.end(), side) != near.end()
                               : !near.empty();
    if (!functions.isWeighted &&
        std::all_of(net.begin(), net.end(), [&](int k) { return isUsable(k, side); }))
      return {};
    functions.own = matrix(net, side, patch, result.coefficients);
    if (functions.isSupport) {
      functions.ownBorder = side;
      return result;
    }
    for (const int border : near) {
      std::vector<int> coefficients;
      functions.others.push_back({border, matrix(net, border, patch, coefficients)});
      result.coefficients.insert(result.coefficients.end(), coefficients.begin(),
                                 coefficients.end());
    }
    return result;
  }

  /// Distances at nine points, and the borders within whose width one of them lies.
  void sample(int e, std::vector<double>& samples, std::vector<int>& near) const {
    const SplineElement& element = surface_.elements()[e];
    std::vector<bool> isNear(borders_.size(), false);
    for (const double b : {0.0, 0.5, 1.0})
      for (const double a : {0.0, 0.5, 1.0}) {
        const Vector3d x =
            surface_
                .evaluate({e, element.lower[0] + a * (element.upper[0] - element.lower[0]),
                           element.lower[1] + b * (element.upper[1] - element.lower[1])})
                .position;
        for (std::size_t k = 0; k < borders_.size(); ++k) {
          const double distance = borders_[k].distance(x);
          if (distance < 1) isNear[k] = true;
          samples.push_back(std::min(distance, 1.0));
        }
      }
    for (std::size_t k = 0; k < borders_.size(); ++k)
      if (isNear[k]) near.push_back(static_cast<int>(k));
  }

  /// (coefficient, net function) for a side; `coefficients` receives the rows'.
  MatrixXd matrix(const std::vector<int>& net, int side, int patch,
                  std::vector<int>& coefficients) {
    std::map<int, int> row;
    for (const int k : net)
      for (const Weight& w : extended(k, side, patch))
        if (row.try_emplace(w.coefficient, static_cast<int>(row.size())).second)
          coefficients.push_back(w.coefficient);
    MatrixXd result = MatrixXd::Zero(static_cast<Eigen::Index>(row.size()),
                                     static_cast<Eigen::Index>(net.size()));
    for (std::size_t f = 0; f < net.size(); ++f)
      for (const Weight& w : extended(net[f], side, patch))
        result(row[w.coefficient], static_cast<Eigen::Index>(f)) += w.weight;
    return result;
  }

  /// The coefficient of a function on a side in terms of those that belong there. Functions that
  /// lie in several patches have the same on all, so that fields are continuous. On sharp edges,
  /// where each face has its own tractions, they are extrapolated along the edge; if the edge lies
  /// on the other side, within each face.
  const std::vector<Weight>& extended(int k, int side, int patch) {
    const bool isSharp = isOnSharpEdge(k);
    const auto [at, isNew] = extended_.try_emplace({side, k, isSharp ? patch : -1});
    std::vector<Weight>& weights = at->second;
    if (!isNew) return weights;
    if (isUsable(k, side)) {
      weights = {{k, 1.0}};
      return weights;
    }
    // Displacements of a support are continued as constants where its functions do not reach.
    int maxOrder = 0;
    if (side == SplineSurface::kFree)
      maxOrder = kMaxOrderOfFree;
    else if (reaches(k, side))
      maxOrder = kMaxOrderInSupport;
    if (isSharp) extrapolateAlongEdges(k, side, patch, maxOrder, weights);
    for (int order = maxOrder; order > 0 && weights.empty(); --order) {
      double least = kMaxSum;
      for (const SplineOccurrence& in : occurrences_[k])
        if (!isSharp || in.patch == patch) extrapolate(in, side, {order, order}, least, weights);
    }
    if (weights.empty()) weights = {{nearest(k, side, patch), 1.0}};
    return weights;
  }

  bool reaches(int k, int side) {
    if (sidesOf_.empty()) {
      sidesOf_.resize(owners_.size());
      for (int e = 0; e < surface_.elementCount(); ++e)
        for (const int each : surface_.net(e)) sidesOf_[each].insert(surface_.side(e));
    }
    return sidesOf_[k].contains(side);
  }

  bool isOnSharpEdge(int k) const {
    const auto groupOf = [&](const SplineOccurrence& at) {
      return surface_.patches()[at.patch].smoothingGroup;
    };
    return std::any_of(occurrences_[k].begin(), occurrences_[k].end(),
                       [&](const SplineOccurrence& at) {
                         return groupOf(at) != groupOf(occurrences_[k].front());
                       });
  }

  /// From functions on the edges of a patch on which a function lies.
  void extrapolateAlongEdges(int k, int side, int patch, int maxOrder,
                             std::vector<Weight>& weights) const {
    for (int order = maxOrder; order >= 0 && weights.empty(); --order) {
      double least = kMaxSum;
      for (const SplineOccurrence& in : occurrences_[k]) {
        if (in.patch != patch) continue;
        const auto& basis = surface_.patches()[patch].basis;
        if (in.i == 0 || in.i == basis[0].count() - 1)
          extrapolate(in, side, {0, order}, least, weights, 0);
        if (in.j == 0 || in.j == basis[1].count() - 1)
          extrapolate(in, side, {order, 0}, least, weights, 1);
      }
    }
  }

  /// Takes the block of functions, orders + 1 along u and v, whose weights have the smallest sum
  /// below `least`. In direction `kept` the block has the function's own index.
  void extrapolate(const SplineOccurrence& in, int side, const std::array<int, 2>& orders,
                   double& least, std::vector<Weight>& weights, int kept = -1) const {
    const SplinePatch& patch = surface_.patches()[in.patch];
    const std::array<int, 2> at{in.i, in.j};
    std::array<int, 2> first{}, last{};
    std::array<std::vector<VectorXd>, 2> along;
    for (int d = 0; d < 2; ++d) {
      if (patch.basis[d].degree() < orders[d]) return;
      first[d] = d == kept ? at[d] : std::max(0, at[d] - orders[d] - kReach);
      last[d] =
          d == kept ? at[d] : std::min(patch.basis[d].count() - 1 - orders[d], at[d] + kReach);
      for (int k = first[d]; k <= last[d]; ++k)
        along[d].push_back(extrapolationWeights(patch.basis[d], k, orders[d], at[d]));
    }
    const auto point = [&](int i, int j) { return patch.net[i + j * patch.basis[0].count()]; };
    const auto isInside = [&](int i, int j) {
      for (int b = 0; b <= orders[1]; ++b)
        for (int a = 0; a <= orders[0]; ++a)
          if (!isUsable(point(i + a, j + b), side)) return false;
      return true;
    };
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i) {
        const VectorXd &u = along[0][i - first[0]], &v = along[1][j - first[1]];
        // Constants are continued from the nearest function.
        const double sum = u.lpNorm<1>() * v.lpNorm<1>() *
                           (1 + 1e-6 * (std::abs(i - at[0]) + std::abs(j - at[1])));
        if (sum >= least * (1 - 1e-9) || !isInside(i, j)) continue;
        least = sum;
        weights.clear();
        for (int b = 0; b <= orders[1]; ++b)
          for (int a = 0; a <= orders[0]; ++a)
            if (u[a] * v[b] != 0) weights.push_back({point(i + a, j + b), u[a] * v[b]});
      }
  }

  /// Nearest coefficient that belongs to a side, in the patch if it has one.
  int nearest(int k, int side, int patch) const {
    const auto& points = surface_.controlPoints();
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](int other) {
      const double distance = (points[other] - points[k]).norm();
      if (!isUsable(other, side) || distance >= least) return;
      least = distance;
      best = other;
    };
    for (const int other : surface_.patches()[patch].net) consider(other);
    if (best < 0)
      for (int other = 0; other < surface_.coefficientCount(); ++other)
        if (owners_[other] == side) consider(other);
    return best;
  }

  SplineSurface& surface_;
  std::vector<std::vector<SplineOccurrence>> occurrences_;
  std::vector<int> owners_;  ///< sidesOfFunctions()
  std::vector<CutBorder> borders_;
  std::vector<std::set<int>> sidesOf_;  ///< of the elements in a function's support
  /// By side, function, and patch or -1.
  std::map<std::array<int, 3>, std::vector<Weight>> extended_;
};

}  // namespace

void extendAtBorders(SplineSurface& surface, const std::vector<LevelFunction>& levels) {
  Extension(surface, levels).apply();
}

}  // namespace palpa::bem
