#include "modeling/solid/tangent_continuity.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <set>

#include "modeling/solid/edge_band.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

// The tangent planes of two patches along an edge agree where
//   R(t) = kappa a + lambda b + mu e = 0    (edge_band.h).
// a, b and e are linear in the control points. There are two kinds of steps:
//
// 1. R = 0 in all three components, with kappa, lambda and mu as before the edit: a linear problem.
// It preserves the relation of the parameters of the two patches, holds exactly wherever the edge
// was exact before (equal knots: R = 0 is an equation between control points), and is satisfied by
// any affine motion.
// 2. Gauss-Newton on n · R = 0 with the factors and the normal n of the present shape, for the
// remainder: one equation per sample instead of three.
//
// Both minimise sum |d|² / size² + weight · sum R² over the displacements d of the free points. The
// residual R is a sine, so the weight compares angles with displacements relative to the size. It
// is small on purpose: conditions that can be satisfied exactly are satisfied to rounding after two
// or three steps, since each step starts from the last result; conditions that the spline space
// cannot satisfy (corners of three smooth edges) do not drive points far away.
constexpr double kWeight = 1.0;
constexpr int kMaxSteps = 12;
constexpr double kGoodEnough = 1e-9;  // rad
constexpr double kLargeAngle = 0.02;  // rad
constexpr double kUnmoved = 1e-12;    // of the size: smaller displacements are rounding

/// Data of one solve: bands, and the points that may move.
struct Problem {
  std::vector<EdgeBand> bands;
  std::vector<std::vector<BasisFunctions>> samples;  // per band, those that the change affects
  std::vector<int> unknownOf;                        // per control point; -1: fixed
  int unknowns = 0;
  double size = 1.0;  // mm
};

/// True if a sample depends on one of the marked points.
bool reaches(const EdgeBand& band, const BasisFunctions& at, const std::vector<char>& marked) {
  for (const auto& row : band.rows)
    for (int k = 0; k <= band.degree; ++k)
      if (marked[row[at.first + k]]) return true;
  return false;
}

bool reaches(const EdgeBand& band, const std::vector<char>& marked) {
  for (const auto& row : band.rows)
    for (int index : row)
      if (marked[index]) return true;
  return false;
}

/// Marks the points of a band within the support of the points marked in `from`.
void spread(const EdgeBand& band, const std::vector<char>& from, std::vector<char>& to) {
  for (int i = 0; i < band.length(); ++i) {
    bool near = false;
    const int low = std::max(0, i - band.degree - 1);
    const int high = std::min(band.length() - 1, i + band.degree + 1);
    for (int k = low; k <= high; ++k)
      for (const auto& row : band.rows) near = near || from[row[k]];
    if (!near) continue;
    for (const auto& row : band.rows) to[row[i]] = 1;
  }
}

/// `start` marks the points around which other points become free, except those in `held`.
Problem makeProblem(const Solid& solid, const std::vector<char>& start,
                    const std::vector<char>& held) {
  std::vector<EdgeBand> smooth;
  for (std::size_t e = 0; e < solid.edges().size(); ++e)
    if (solid.edges()[e].smooth) smooth.push_back(bandOf(solid, static_cast<int>(e)));
  // First along the edges of the start points, then along the smooth edges that these points touch,
  // so that corners are solved with all their edges; no farther.
  std::vector<char> reached = start;
  std::vector<char> done(smooth.size(), 0);
  for (int round = 0; round < 2; ++round) {
    const std::vector<char> from = reached;
    for (std::size_t b = 0; b < smooth.size(); ++b) {
      if (done[b] || !reaches(smooth[b], from)) continue;
      spread(smooth[b], from, reached);
      done[b] = 1;
    }
  }
  Problem problem;
  problem.unknownOf.assign(solid.controlPoints().size(), -1);
  for (const EdgeBand& band : smooth) {
    std::vector<BasisFunctions> samples;
    for (const BasisFunctions& at : bandSamples(band, 2 * band.degree + 2))
      if (reaches(band, at, reached)) samples.push_back(at);
    if (samples.empty()) continue;
    for (const auto& row : band.rows)
      for (int index : row)
        if (reached[index] && !held[index] && problem.unknownOf[index] < 0)
          problem.unknownOf[index] = problem.unknowns++;
    problem.bands.push_back(band);
    problem.samples.push_back(std::move(samples));
  }
  const auto [low, high] = boundingBox(solid);
  problem.size = (high - low).norm();
  return problem;
}

double largestAngle(const Problem& problem, const Points& points) {
  double largest = 0.0;
  for (std::size_t b = 0; b < problem.bands.size(); ++b)
    for (const BasisFunctions& at : problem.samples[b])
      if (const auto relation = tangentRelation(problem.bands[b], at, points))
        largest = std::max(largest, relation->angle);
  return largest;
}

/// Calls visit(unknown, coefficient) for dR / d(point) of a sample.
template <class Visit>
void forCoefficients(const Problem& problem, const EdgeBand& band, const BasisFunctions& at,
                     const std::array<double, 3>& factor, Visit visit) {
  for (int k = 0; k <= band.degree; ++k) {
    const std::array<double, 3> coefficient{
        -(factor[0] + factor[1]) * at.value[k] + factor[2] * at.derivative[k],
        factor[0] * at.value[k], factor[1] * at.value[k]};
    for (int row = 0; row < 3; ++row)
      if (const int unknown = problem.unknownOf[band.rows[row][at.first + k]]; unknown >= 0)
        visit(unknown, coefficient[row]);
  }
}

/// Minimises |x|² + weight |J x - rhs|² for each column of the right-hand side.
Eigen::MatrixXd leastChange(int rows, int columns,
                            const std::vector<Eigen::Triplet<double>>& entries,
                            const Eigen::MatrixXd& rhs) {
  Eigen::SparseMatrix<double> jacobian(rows, columns);
  jacobian.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseMatrix<double> normal = kWeight * (jacobian.transpose() * jacobian);
  Eigen::SparseMatrix<double> identity(columns, columns);
  identity.setIdentity();
  normal += identity;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(normal);
  return solver.solve(kWeight * (jacobian.transpose() * rhs));
}

/// Adds displacements (relative to the size) to the free points; negligible ones are dropped, so
/// that points that the change does not affect keep their bits.
Points moved(const Problem& problem, const Points& points, const Eigen::MatrixXd& displacement) {
  Points result = points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (problem.unknownOf[i] < 0) continue;
    const Vector3d d = displacement.row(problem.unknownOf[i]).transpose();
    if (d.norm() > kUnmoved) result[i] += problem.size * d;
  }
  return result;
}

/// Step 1: the relation of `reference` in all three components.
Points linearStep(const Problem& problem, const Points& reference, const Points& points) {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<Vector3d> residuals;
  for (std::size_t b = 0; b < problem.bands.size(); ++b)
    for (const BasisFunctions& at : problem.samples[b]) {
      const EdgeBand& band = problem.bands[b];
      const auto before = tangentRelation(band, at, reference);
      const auto now = tangentRelation(band, at, points);
      if (!before || !now) continue;
      const int row = static_cast<int>(residuals.size());
      const auto& factor = before->factor;
      residuals.push_back(factor[0] * now->a + factor[1] * now->b + factor[2] * now->e);
      forCoefficients(problem, band, at, factor, [&](int unknown, double coefficient) {
        entries.emplace_back(row, unknown, problem.size * coefficient);
      });
    }
  Eigen::MatrixXd rhs(residuals.size(), 3);
  for (std::size_t k = 0; k < residuals.size(); ++k) rhs.row(k) = -residuals[k].transpose();
  return moved(problem, points,
               leastChange(static_cast<int>(residuals.size()), problem.unknowns, entries, rhs));
}

/// Step 2: the normal component with the relation of the present points.
Points normalStep(const Problem& problem, const Points& points) {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> residuals;
  for (std::size_t b = 0; b < problem.bands.size(); ++b)
    for (const BasisFunctions& at : problem.samples[b]) {
      const EdgeBand& band = problem.bands[b];
      const auto now = tangentRelation(band, at, points);
      if (!now) continue;
      const int row = static_cast<int>(residuals.size());
      const auto& factor = now->factor;
      residuals.push_back(
          now->normal.dot(factor[0] * now->a + factor[1] * now->b + factor[2] * now->e));
      forCoefficients(problem, band, at, factor, [&](int unknown, double coefficient) {
        for (int axis = 0; axis < 3; ++axis)
          entries.emplace_back(row, 3 * unknown + axis,
                               problem.size * coefficient * now->normal[axis]);
      });
    }
  Eigen::MatrixXd rhs(residuals.size(), 1);
  for (std::size_t k = 0; k < residuals.size(); ++k) rhs(k, 0) = -residuals[k];
  const Eigen::MatrixXd x =
      leastChange(static_cast<int>(residuals.size()), 3 * problem.unknowns, entries, rhs);
  Eigen::MatrixXd displacement(problem.unknowns, 3);
  for (int i = 0; i < problem.unknowns; ++i)
    displacement.row(i) = x.block(3 * i, 0, 3, 1).transpose();
  return moved(problem, points, displacement);
}

/// Repeats a step while each one halves the angle, or reduces a large angle at all: slower progress
/// would require large motions.
template <class Step>
Points repeated(const Problem& problem, Points points, Step step) {
  double angle = largestAngle(problem, points);
  for (int count = 0; count < kMaxSteps && angle > kGoodEnough; ++count) {
    Points next = step(points);
    const double nextAngle = largestAngle(problem, next);
    if (!(nextAngle < angle)) break;
    const bool slow = nextAngle > 0.5 * angle && nextAngle < kLargeAngle;
    points = std::move(next);
    angle = nextAngle;
    if (slow) break;
  }
  return points;
}

Points improved(const Problem& problem, Points points) {
  return repeated(problem, std::move(points),
                  [&](const Points& now) { return normalStep(problem, now); });
}

}  // namespace

double tangentAngle(const Solid& solid, int edge) {
  const EdgeBand band = bandOf(solid, edge);
  double largest = 0.0;
  for (const BasisFunctions& at : bandSamples(band, 12))
    if (const auto relation = tangentRelation(band, at, solid.controlPoints()))
      largest = std::max(largest, relation->angle);
  return largest;
}

double largestTangentAngle(const Solid& solid) {
  double largest = 0.0;
  for (std::size_t e = 0; e < solid.edges().size(); ++e)
    if (solid.edges()[e].smooth)
      largest = std::max(largest, tangentAngle(solid, static_cast<int>(e)));
  return largest;
}

Solid restoreTangents(const Solid& before, const Solid& after, const std::vector<int>& held) {
  const std::size_t count = after.controlPoints().size();
  std::vector<char> changed(count, 0), fixed(count, 0);
  for (std::size_t i = 0; i < count; ++i)
    changed[i] = before.controlPoints()[i] != after.controlPoints()[i];
  for (int index : held) fixed[index] = 1;
  const Problem problem = makeProblem(after, changed, fixed);
  if (problem.bands.empty()) return after;
  Points points = after.controlPoints();
  if (problem.unknowns > 0) {
    points = repeated(problem, std::move(points), [&](const Points& now) {
      return linearStep(problem, before.controlPoints(), now);
    });
    points = improved(problem, std::move(points));
  }
  // If all three rows are held in a shape that is not smooth, held points must move too.
  const double allowed = std::max(kLargeAngle, 2.0 * largestAngle(problem, before.controlPoints()));
  if (!held.empty() && largestAngle(problem, points) > allowed)
    points = improved(makeProblem(after, changed, std::vector<char>(count, 0)), std::move(points));
  if (points == after.controlPoints()) return after;
  return after.withControlPoints(std::move(points));
}

Solid makeTangent(const Solid& solid, const std::vector<int>& edges) {
  std::vector<char> start(solid.controlPoints().size(), 0);
  for (int edge : edges)
    for (const auto& row : bandOf(solid, edge).rows)
      for (int index : row) start[index] = 1;
  const Problem problem = makeProblem(solid, start, std::vector<char>(start.size(), 0));
  return solid.withControlPoints(improved(problem, solid.controlPoints()));
}

}  // namespace palpa::modeling
