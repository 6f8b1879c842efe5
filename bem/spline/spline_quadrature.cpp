#include "bem/spline/spline_quadrature.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/scratch_pool.h"
#include "bem/spline/tensor_rule_reach.h"

namespace palpa::bem {

using Eigen::Vector3d;

namespace {

/// Relative error allowed in the far integrals of elements with weights, over the error allowed
/// elsewhere: roots converge slowly, and their errors have no effect on solutions at this size.
constexpr double kOfWeighted = 10;

/// Far more halvings than distances of 1e-6 element sizes need.
constexpr int kMaxDepth = 40;

/// Largest difference of the entries, over the largest entry of `exact`.
double largestDifference(const std::vector<double>& values, const std::vector<double>& exact) {
  double difference = 0, largest = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    difference = std::max(difference, std::abs(values[k] - exact[k]));
    largest = std::max(largest, std::abs(exact[k]));
  }
  return difference / largest;
}

/// Points per direction for exact integrals of the functions times the area vectors of an uncut
/// element of a degree: polynomials of degree 3 degree - 1 in each direction.
int exactPoints(int degree) {
  return (3 * degree + 1) / 2;
}

}  // namespace

/// Scratch memory: cells with the points per direction of their tensor rules, and outlines of
/// cells.
struct SplineQuadrature::Scratch final : Workspace {
  ElementRule outline;
  ElementPoints outlinePoints;
  std::vector<std::pair<SplineCell, int>> cells;
  std::vector<KernelSums> ofTable;
};

std::unique_ptr<ElementQuadrature::Workspace> SplineQuadrature::makeWorkspace() const {
  return std::make_unique<Scratch>();
}

SplineQuadrature::SplineQuadrature(const SplineSurface& surface, double tolerance, const Job& job)
    : surface_(surface),
      placement_(surface),
      loops_(kelvinSumLoopsForThisProcessor()),
      accuracy_(tolerance),
      // The remaining area is proportional to the third power of its size, the kernels to the
      // first.
      cornerLevels_(2 + static_cast<int>(std::ceil(-std::log2(accuracy_.error) / 2))) {
  constexpr std::ptrdiff_t kElementsPerTask = 16;
  const std::ptrdiff_t count = surface.elementCount();
  elements_.resize(count);
  ScratchPool<Scratch> pool([] { return Scratch{}; });
  parallelFor((count + kElementsPerTask - 1) / kElementsPerTask, job, [&](std::ptrdiff_t task) {
    Scratch work = pool.take();
    const std::ptrdiff_t end = std::min(count, (task + 1) * kElementsPerTask);
    for (std::ptrdiff_t e = task * kElementsPerTask; e < end; ++e)
      prepare(static_cast<int>(e), work);
    pool.giveBack(std::move(work));
  });
}

void SplineQuadrature::prepare(int index, Scratch& work) {
  Element& element = elements_[index];
  element.whole = cellIn(index, cellOf(surface_.elements()[index]), work);
  divide(index, element.whole, work, element.parts);
  const int degree = placement_.degree(index);
  const bool isCut = surface_.isCut(index) || surface_.isWeighted(index);
  for (int n = kMinPoints; n <= kMaxKept; ++n)
    placement_.placeTensor(index, element.whole.cell, n, work.rule, element.rules[n - kMinPoints]);
  std::vector<double> exact;
  for (int n = kMinPoints; n <= kMaxPoints; ++n) {
    bool isEnough = n == kMaxPoints || (!isCut && n >= exactPoints(degree));
    if (!isEnough) {
      if (exact.empty()) {
        placement_.placeTensor(index, element.whole.cell,
                               isCut ? kMaxPoints : std::min(exactPoints(degree), kMaxPoints),
                               work.rule, work.points);
        exact = moments(index, work.points);
      }
      if (n > kMaxKept)
        placement_.placeTensor(index, element.whole.cell, n, work.rule, work.points);
      const ElementPoints& points = n > kMaxKept ? work.points : element.rules[n - kMinPoints];
      isEnough = largestDifference(moments(index, points), exact) <=
                 (surface_.isWeighted(index) ? kOfWeighted : 1) * accuracy_.error;
    }
    element.ratio[n] = isEnough ? tensorRuleReach(n, degree, accuracy_.error) : INFINITY;
  }
}

std::vector<double> SplineQuadrature::moments(int index, const ElementPoints& points) const {
  const int functions = placement_.functionCount(index), inU = placement_.functionsAlong(index, 0),
            inV = placement_.functionsAlong(index, 1), n = points.perDirection;
  const bool isWeighted = surface_.isWeighted(index);
  std::vector<double> sums(static_cast<std::size_t>(isWeighted ? 4 : 3) * functions, 0);
  for (int p = 0; p < points.used; ++p)
    for (int f = 0; f < functions; ++f) {
      const double* basis = points.basis.data();
      const double value =
          n > 0 ? basis[(p % n) * inU + f % inU] * basis[n * inU + (p / n) * inV + f / inU]
                : basis[p * placement_.stride(index) + f];
      for (int c = 0; c < 3; ++c) sums[3 * f + c] += value * points.area(c)[p];
      if (isWeighted) sums[3 * functions + f] += value * points.tractionArea()[p];
    }
  return sums;
}

void SplineQuadrature::reduceSums(const BorderFunctions& functions,
                                  const std::vector<KernelSums>& ofTable,
                                  std::vector<KernelSums>& sums) {
  using Sums = Eigen::Array<double, kKernelStride, 1>;
  sums.assign(static_cast<std::size_t>(functions.count()), {});
  for (int n = 0; n < functions.netCount(); ++n) {
    const Eigen::Map<const Sums> from(ofTable[n].of);
    for (int k = 0; k < functions.ownCount(); ++k)
      if (const double weight = functions.own(k, n); weight != 0)
        Eigen::Map<Sums>(sums[k].of) += weight * from;
  }
  for (int k = 0; k < functions.otherCount(); ++k) {
    KernelSums& other = sums[functions.ownCount() + k];
    other = ofTable[functions.netCount() + k];
    std::fill_n(other.of, kKernelSumsU, 0.0);  // these functions carry no tractions
  }
}

int SplineQuadrature::pointsFor(const Element& element, double ratio) const {
  for (int n = kMinPoints; n <= kMaxPoints; ++n)
    if (ratio >= element.ratio[n]) return n;
  return 0;
}

SplineQuadrature::Cell SplineQuadrature::cellIn(int element, const SplineCell& cell,
                                                Scratch& work) const {
  ElementRule& rule = work.outline;
  ElementPoints& points = work.outlinePoints;
  rule.clear();
  for (const double b : {0.0, 0.5, 1.0})
    for (const double a : {0.0, 0.5, 1.0})
      rule.add(cell.lower[0] + a * (cell.upper[0] - cell.lower[0]),
               cell.lower[1] + b * (cell.upper[1] - cell.lower[1]), 1);
  placement_.placeGeometry(element, rule, points);
  const auto at = [&](int i, int j) {
    const int k = i + 3 * j;
    return Vector3d(points.position(0)[k], points.position(1)[k], points.position(2)[k]);
  };
  Cell result{cell, at(1, 1), 0, {}, {}};
  int corner = 0;
  for (const int j : {0, 2})
    for (const int i : {0, 2}) {
      result.radius = std::max(result.radius, (at(i, j) - result.center).norm());
      result.cornerMetric[corner++] = points.areaOf(i + 3 * j).norm();
    }
  // The middle lines have a positive length even where an edge is collapsed.
  result.length = {(at(2, 1) - at(0, 1)).norm(), (at(1, 2) - at(1, 0)).norm()};
  return result;
}

void SplineQuadrature::divide(int element, const Cell& cell, Scratch& work,
                              std::vector<Cell>& parts) const {
  const int longer = cell.longer();
  for (const SplineCell& half : cell.cell.halves(longer)) {
    if (cell.isLong()) {
      parts.push_back(cellIn(element, half, work));
      continue;
    }
    for (const SplineCell& quarter : half.halves(1 - longer))
      parts.push_back(cellIn(element, quarter, work));
  }
}

void SplineQuadrature::addNear(int index, const Cell& cell, const Vector3d& x, int depth,
                               Scratch& work) const {
  const Element& element = elements_[index];
  const int count = pointsFor(element, (x - cell.center).norm() / cell.radius);
  if (count > 0 || depth >= kMaxDepth) {
    work.cells.emplace_back(cell.cell, count > 0 ? count : kMaxPoints);
    return;
  }
  if (&cell == &element.whole) {
    for (const Cell& part : element.parts) addNear(index, part, x, depth + 1, work);
    return;
  }
  std::vector<Cell> parts;
  divide(index, cell, work, parts);
  for (const Cell& part : parts) addNear(index, part, x, depth + 1, work);
}

void SplineQuadrature::addSingular(int index, const Cell& cell, const Vector3d& x,
                                   const ElementPlace& place, int depth, Scratch& work) const {
  if (!cell.cell.contains(place)) {
    addNear(index, cell, x, depth, work);
    return;
  }
  if (depth == 0 && isFoldedCorner(surface_, cell.cell, place)) {
    addFoldedCorner(surface_, cell.cell, place, accuracy_, work.rule);
    return;
  }
  const bool varies = metricVaries(cell, place);
  if (varies && depth >= cornerLevels_) return;  // the remainder is as small as the tolerance
  if (!varies && (!cell.isLong() || depth >= kMaxDepth)) {
    addPolar(surface_, cell.cell, place, accuracy_, work.rule);
    return;
  }
  const int longer = cell.longer();
  for (const SplineCell& half : cell.cell.halves(longer)) {
    if (!varies) {
      addSingular(index, cellIn(index, half, work), x, place, depth + 1, work);
      continue;
    }
    for (const SplineCell& quarter : half.halves(1 - longer))
      addSingular(index, cellIn(index, quarter, work), x, place, depth + 1, work);
  }
}

bool SplineQuadrature::metricVaries(const Cell& cell, const ElementPlace& place) const {
  constexpr double kMaxRatio = 4;
  const double here = surface_.evaluate(place).areaVector().norm();
  return std::any_of(cell.cornerMetric.begin(), cell.cornerMetric.end(), [here](double there) {
    return there > kMaxRatio * here || here > kMaxRatio * there;
  });
}

void SplineQuadrature::collect(int index, const Vector3d& x, const ElementPlace* inside,
                               Scratch& work) const {
  work.rule.clear();
  work.cells.clear();
  const Cell& whole = elements_[index].whole;
  if (inside)
    addSingular(index, whole, x, *inside, 0, work);
  else
    addNear(index, whole, x, 0, work);
}

template <class Use>
void SplineQuadrature::useRules(int index, const Vector3d& x, const ElementPlace* inside,
                                Scratch& work, const Use& use) const {
  const Element& shape = elements_[index];
  const int count = inside ? 0 : pointsFor(shape, ratio(index, x));
  if (count > 0 && count <= kMaxKept) {
    use(shape.rules[count - kMinPoints]);
    return;
  }
  collect(index, x, inside, work);
  if (!work.rule.u.empty()) {
    placement_.place(index, work.rule, work.points);
    use(work.points);
  }
  for (const auto& [cell, points] : work.cells) {
    placement_.placeTensor(index, cell, points, work.rule, work.points);
    use(work.points);
  }
}

const ElementPoints& SplineQuadrature::points(int index, const Vector3d& x,
                                              const ElementPlace* inside, Workspace& work) const {
  auto& scratch = static_cast<Scratch&>(work);
  collect(index, x, inside, scratch);
  for (const auto& [cell, count] : scratch.cells) addTensor(cell, count, scratch.rule);
  placement_.place(index, scratch.rule, scratch.points);
  return scratch.points;
}

void SplineQuadrature::visitRules(int index, const Vector3d& x, const ElementPlace* inside,
                                  Workspace& work, const Visit& visit) const {
  useRules(index, x, inside, static_cast<Scratch&>(work), visit);
}

void SplineQuadrature::integrate(int index, const Vector3d& x, const ElementPlace* inside,
                                 Workspace& work) const {
  auto& scratch = static_cast<Scratch&>(work);
  const BorderFunctions* beside = surface_.borderFunctions(index);
  std::vector<KernelSums>& sums = beside ? scratch.ofTable : work.sums;
  sums.assign(
      static_cast<std::size_t>(beside ? beside->tableCount() : placement_.functionCount(index)),
      {});
  useRules(index, x, inside, scratch,
           [&](const ElementPoints& at) { loops_.sumKernels(at.sumTask(x, sums.data())); });
  if (beside) reduceSums(*beside, sums, work.sums);
}

}  // namespace palpa::bem
