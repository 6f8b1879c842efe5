#include "modeling/editing/nearest_on_patches.h"

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <optional>

#include "modeling/solid/basis.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

constexpr int kPerSpan = 4;
constexpr double kBulge = 0.02;         // of its diagonal: extent of a span beyond its samples
constexpr double kNearer = 1.0 - 1e-9;  // excludes the equal points of both patches at an edge

struct Derivatives {
  Vector3d position = Vector3d::Zero();
  Vector3d du = Vector3d::Zero();
  Vector3d dv = Vector3d::Zero();
};

/// Point and derivatives. SurfaceEvaluator costs twice as much, because each solid needs a new one.
Derivatives evaluate(const Solid& solid, int index, double atU, double atV) {
  const Patch& patch = solid.patches()[index];
  const BasisFunctions u = basisAt(patch.knots[0], patch.degree[0], atU);
  const BasisFunctions v = basisAt(patch.knots[1], patch.degree[1], atV);
  Derivatives result;
  for (int i = 0; i <= patch.degree[0]; ++i) {
    Vector3d row = Vector3d::Zero();
    Vector3d slope = Vector3d::Zero();
    for (int j = 0; j <= patch.degree[1]; ++j) {
      const Vector3d& point = solid.controlPoints()[patch.net[u.first + i][v.first + j]];
      row += v.value[j] * point;
      slope += v.derivative[j] * point;
    }
    result.position += u.value[i] * row;
    result.du += u.derivative[i] * row;
    result.dv += u.value[i] * slope;
  }
  return result;
}

SurfaceSum sumAt(const Solid& solid, int index, double atU, double atV) {
  const Patch& patch = solid.patches()[index];
  const BasisFunctions u = basisAt(patch.knots[0], patch.degree[0], atU);
  const BasisFunctions v = basisAt(patch.knots[1], patch.degree[1], atV);
  SurfaceSum sum;
  sum.reserve((patch.degree[0] + 1) * (patch.degree[1] + 1));
  for (int i = 0; i <= patch.degree[0]; ++i)
    for (int j = 0; j <= patch.degree[1]; ++j)
      if (const double weight = u.value[i] * v.value[j]; weight != 0.0)
        sum.emplace_back(patch.net[u.first + i][v.first + j], weight);
  return sum;
}

/// Parameters of the samples along one direction, kPerSpan + 1 per span.
std::vector<double> sampleParameters(const std::vector<double>& knots) {
  std::vector<double> values;
  for (std::size_t i = 1; i < knots.size(); ++i)
    if (knots[i] > knots[i - 1])
      for (int k = 0; k <= kPerSpan; ++k)
        values.push_back(
            std::min(knots[i - 1] + (knots[i] - knots[i - 1]) * k / kPerSpan, knots[i]));
  return values;
}

std::vector<BasisFunctions> basesAt(const std::vector<double>& knots, int degree,
                                    const std::vector<double>& parameters) {
  std::vector<BasisFunctions> result;
  for (const double parameter : parameters) result.push_back(basisAt(knots, degree, parameter));
  return result;
}

}  // namespace

NearestOnPatches::NearestOnPatches(const Solid& solid) : solid_(solid) {
  for (int patch = 0; patch < static_cast<int>(solid.patches().size()); ++patch) addPatch(patch);
}

void NearestOnPatches::addPatch(int index) {
  const Patch& patch = solid_.patches()[index];
  const std::vector<double> us = sampleParameters(patch.knots[0]);
  const std::vector<double> vs = sampleParameters(patch.knots[1]);
  const auto uBases = basesAt(patch.knots[0], patch.degree[0], us);
  const auto vBases = basesAt(patch.knots[1], patch.degree[1], vs);
  // Along u first: the sums over a column of the net are the same for all v.
  std::vector<std::vector<Vector3d>> columns(us.size());
  for (std::size_t a = 0; a < us.size(); ++a)
    for (std::size_t j = 0; j < patch.net.front().size(); ++j) {
      Vector3d sum = Vector3d::Zero();
      for (int i = 0; i <= patch.degree[0]; ++i)
        sum += uBases[a].value[i] * solid_.controlPoints()[patch.net[uBases[a].first + i][j]];
      columns[a].push_back(sum);
    }
  constexpr std::size_t kStep = kPerSpan + 1;
  for (std::size_t a = 0; a < us.size(); a += kStep)
    for (std::size_t b = 0; b < vs.size(); b += kStep) {
      Cell cell{index, 0, Vector3d::Constant(std::numeric_limits<double>::infinity()),
                Vector3d::Constant(-std::numeric_limits<double>::infinity())};
      for (std::size_t i = a; i < a + kStep; ++i)
        for (std::size_t j = b; j < b + kStep; ++j) {
          Vector3d position = Vector3d::Zero();
          for (int k = 0; k <= patch.degree[1]; ++k)
            position += vBases[j].value[k] * columns[i][vBases[j].first + k];
          samples_.push_back({index, us[i], vs[j], position});
          cell.low = cell.low.cwiseMin(position);
          cell.high = cell.high.cwiseMax(position);
        }
      cell.end = samples_.size();
      const Vector3d bulge = Vector3d::Constant(kBulge * (cell.high - cell.low).norm());
      cell.low -= bulge;
      cell.high += bulge;
      cells_.push_back(cell);
    }
}

void NearestOnPatches::look(std::size_t cell, const Vector3d& x, double& least,
                            std::size_t& best) const {
  for (std::size_t i = cell == 0 ? 0 : cells_[cell - 1].end; i < cells_[cell].end; ++i)
    if (const double d = (samples_[i].position - x).squaredNorm(); d < least) {
      least = d;
      best = i;
    }
}

double NearestOnPatches::squaredDistance(std::size_t cell, const Vector3d& x) const {
  return (x - x.cwiseMax(cells_[cell].low).cwiseMin(cells_[cell].high)).squaredNorm();
}

void NearestOnPatches::improve(Sample& at, const Vector3d& x) const {
  constexpr int kIterations = 12;
  constexpr int kHalvings = 6;
  const auto [uLow, uHigh] = solid_.patches()[at.patch].range(0);
  const auto [vLow, vHigh] = solid_.patches()[at.patch].range(1);
  Derivatives p = evaluate(solid_, at.patch, at.u, at.v);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Vector3d away = x - p.position;
    Eigen::Vector2d step(p.du.dot(away), p.dv.dot(away));
    // On a side of the patch, only a step along it if the step would leave the patch.
    const bool fixedU = (at.u <= uLow && step[0] < 0.0) || (at.u >= uHigh && step[0] > 0.0);
    const bool fixedV = (at.v <= vLow && step[1] < 0.0) || (at.v >= vHigh && step[1] > 0.0);
    if (fixedU && fixedV) return;
    Eigen::Matrix2d metric;
    metric << p.du.dot(p.du), p.du.dot(p.dv), p.du.dot(p.dv), p.dv.dot(p.dv);
    metric.diagonal().array() += 1e-9 * metric.trace();
    if (fixedU || fixedV) {
      const int free = fixedU ? 1 : 0;
      step[1 - free] = 0.0;
      step[free] /= metric(free, free);
    } else {
      step = metric.inverse() * step;
    }
    if (!step.allFinite()) return;
    std::optional<Derivatives> nearer;
    Sample next = at;
    double part = 1.0;
    for (int halving = 0; halving < kHalvings && !nearer; ++halving, part *= 0.5) {
      next.u = std::clamp(at.u + part * step[0], uLow, uHigh);
      next.v = std::clamp(at.v + part * step[1], vLow, vHigh);
      const Derivatives there = evaluate(solid_, at.patch, next.u, next.v);
      if ((there.position - x).squaredNorm() < away.squaredNorm()) nearer = there;
    }
    if (!nearer) return;
    const double moved = (nearer->position - p.position).norm();
    at = next;
    p = *nearer;
    at.position = p.position;
    // Each step is several times smaller than the previous one: the next one is below rounding.
    if (moved <= 1e-7 * (1e-3 + away.norm()) || moved <= 1e-10 * (1.0 + x.norm())) return;
  }
}

SurfaceSum NearestOnPatches::of(const Vector3d& x) {
  double least = std::numeric_limits<double>::infinity();
  std::size_t sample = 0;
  look(likelyCell_, x, least, sample);
  for (std::size_t cell = 0; cell < cells_.size(); ++cell)
    if (squaredDistance(cell, x) < least) {
      const double before = least;
      look(cell, x, least, sample);
      if (least < before) likelyCell_ = cell;
    }
  Sample best = samples_[sample];
  improve(best, x);
  // The nearest sample and the nearest point may lie on different spans or patches.
  constexpr std::size_t kMaxOthers = 8;
  least = (best.position - x).squaredNorm();
  std::vector<std::pair<double, std::size_t>> others;
  for (std::size_t cell = 0; cell < cells_.size(); ++cell)
    if (const double d = squaredDistance(cell, x); d < least && cell != likelyCell_)
      others.emplace_back(d, cell);
  std::sort(others.begin(), others.end());
  if (others.size() > kMaxOthers) others.resize(kMaxOthers);
  for (const auto& [distance, cell] : others) {
    least = (best.position - x).squaredNorm();
    if (distance >= least) break;
    double leastThere = std::numeric_limits<double>::infinity();
    look(cell, x, leastThere, sample);
    Sample there = samples_[sample];
    improve(there, x);
    if ((there.position - x).squaredNorm() < kNearer * least) best = there;
  }
  return sumAt(solid_, best.patch, best.u, best.v);
}

}  // namespace palpa::modeling
