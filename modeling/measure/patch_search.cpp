#include "modeling/measure/patch_search.h"

#include <Eigen/Dense>
#include <Standard_Failure.hxx>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/box_tree.h"
#include "modeling/error.h"
#include "modeling/solid/opencascade_surface.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kPartsPerSpan = 2;  // in each direction
/// Enlarges the box of a quarter span around nine of its points, in parts of its diagonal: a curve
/// that turns by a right angle between two points leaves their box by 0.21 of their distance.
constexpr double kSlack = 0.12;
constexpr double kMaxFall = 4;
/// Relative fall of the squared distance that is rounding.
constexpr double kMinFall = 1e-17;
constexpr int kMaxSteps = 60;
/// Steps below this part of the body's size end the iteration.
constexpr double kStepEnd = 1e-15;
/// Largest distance between ray and surface at a hit, in parts of the size.
constexpr double kHitEnd = 1e-11;

Vector3d toEigen(const gp_XYZ& v) {
  return {v.X(), v.Y(), v.Z()};
}

}  // namespace

struct PatchSearch::Entry {
  Handle(Geom_BSplineSurface) surface;
  std::array<std::vector<double>, 2> spans;
  std::vector<Vector2d> middles;  // of the parts of spans
  std::vector<Vector3d> places;   // of the middles
  BoxTree tree;

  Vector2d low() const { return {spans[0].front(), spans[1].front()}; }
  Vector2d high() const { return {spans[0].back(), spans[1].back()}; }
};

PatchSearch::PatchSearch(const Solid& solid) {
  BoxTree::Box all;
  for (const Patch& patch : solid.patches()) {
    auto entry = std::make_unique<Entry>();
    try {
      entry->surface = makeSurface(solid.controlPoints(), patch);
    } catch (const Standard_Failure& failure) {
      throw ModelingError("patch \"" + patch.name +
                          "\": OpenCASCADE refuses it as a surface: " + failure.GetMessageString());
    }
    entry->spans = {distinct(patch.knots[0]), distinct(patch.knots[1])};
    entries_.push_back(std::move(entry));
    Entry& e = *entries_.back();
    const int index = static_cast<int>(entries_.size()) - 1;
    // Samples at the ends and middles of all parts.
    std::array<std::vector<double>, 2> at;
    for (int d = 0; d < 2; ++d) {
      for (std::size_t i = 1; i < e.spans[d].size(); ++i)
        for (int k = 0; k < 2 * kPartsPerSpan; ++k)
          at[d].push_back(e.spans[d][i - 1] +
                          (e.spans[d][i] - e.spans[d][i - 1]) * k / (2 * kPartsPerSpan));
      at[d].push_back(e.spans[d].back());
    }
    std::vector<Vector3d> grid;
    for (const double u : at[0])
      for (const double v : at[1]) grid.push_back(position(index, {u, v}));
    std::vector<BoxTree::Box> boxes;
    for (std::size_t i = 1; i + 1 < at[0].size(); i += 2)
      for (std::size_t j = 1; j + 1 < at[1].size(); j += 2) {
        BoxTree::Box box;
        for (std::size_t a = i - 1; a <= i + 1; ++a)
          for (std::size_t b = j - 1; b <= j + 1; ++b) box.extend(grid[a * at[1].size() + b]);
        all.extend(box);
        const Vector3d slack = Vector3d::Constant(kSlack * box.diagonal().norm());
        boxes.emplace_back(box.min() - slack, box.max() + slack);
        e.middles.emplace_back(at[0][i], at[1][j]);
        e.places.push_back(grid[i * at[1].size() + j]);
      }
    e.tree = BoxTree(boxes, e.places);
  }
  size_ = all.diagonal().norm();
}

PatchSearch::~PatchSearch() = default;

int PatchSearch::patchCount() const {
  return static_cast<int>(entries_.size());
}

std::array<double, 2> PatchSearch::range(int patch, int direction) const {
  const auto& spans = entries_[patch]->spans[direction];
  return {spans.front(), spans.back()};
}

const std::vector<double>& PatchSearch::spans(int patch, int direction) const {
  return entries_[patch]->spans[direction];
}

PatchJet PatchSearch::jet(int patch, const Vector2d& uv) const {
  gp_Pnt p;
  gp_Vec u, v, uu, vv, mixed;
  entries_[patch]->surface->D2(uv.x(), uv.y(), p, u, v, uu, vv, mixed);
  return {toEigen(p.XYZ()),  toEigen(u.XYZ()),     toEigen(v.XYZ()),
          toEigen(uu.XYZ()), toEigen(mixed.XYZ()), toEigen(vv.XYZ())};
}

Vector3d PatchSearch::position(int patch, const Vector2d& uv) const {
  gp_Pnt p;
  entries_[patch]->surface->D0(uv.x(), uv.y(), p);
  return toEigen(p.XYZ());
}

/// Newton's method for the minimum of f = |S(u, v) − x|² / 2 in the rectangle of the parameters:
/// gradient g = (r·Su, r·Sv) with r = S − x, Hessian H = J'J + (r·Suu, r·Suv, r·Svv); J'J alone
/// where H is not positive definite. Parameters at a bound towards which f falls stay there.
/// Returns the squared distance.
double PatchSearch::improve(int patch, Vector2d& uv, const Vector3d& x, double limit) const {
  const Vector2d low = entries_[patch]->low(), high = entries_[patch]->high();
  double squared = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMaxSteps; ++step) {
    const PatchJet s = jet(patch, uv);
    const Vector3d r = s.position - x;
    squared = r.squaredNorm();
    Vector2d g(r.dot(s.u), r.dot(s.v));
    Eigen::Matrix2d gauss, newton;
    gauss << s.u.dot(s.u), s.u.dot(s.v), s.u.dot(s.v), s.v.dot(s.v);
    newton << r.dot(s.uu), r.dot(s.uv), r.dot(s.uv), r.dot(s.vv);
    newton += gauss;
    std::array<bool, 2> isFree{};
    for (int k = 0; k < 2; ++k)
      isFree[k] = !((uv[k] <= low[k] && g[k] > 0) || (uv[k] >= high[k] && g[k] < 0));
    const auto solve = [&](const Eigen::Matrix2d& h) {
      Vector2d way = Vector2d::Zero();
      const double floor = 1e-14 * gauss.trace();
      if (isFree[0] && isFree[1]) {
        const double determinant = h.determinant();
        if (h(0, 0) > floor && determinant > 1e-14 * gauss.trace() * gauss.trace())
          way = -h.inverse() * g;
      } else {
        for (int k = 0; k < 2; ++k)
          if (isFree[k] && h(k, k) > floor) way[k] = -g[k] / h(k, k);
      }
      return way;
    };
    Vector2d way = solve(newton);
    if (way.isZero(0)) way = solve(gauss + 1e-9 * gauss.trace() * Eigen::Matrix2d::Identity());
    // The squared distance falls by about −g·way; by several times as much on a curved part.
    const double fall = -g.dot(way);
    if (squared - kMaxFall * fall > limit) return squared;
    if (fall <= kMinFall * squared) break;
    // Shorter steps until the distance falls.
    Vector2d next = uv;
    double share = 1;
    for (int k = 0; k < 30; ++k, share *= 0.5) {
      next = (uv + share * way).cwiseMax(low).cwiseMin(high);
      if ((position(patch, next) - x).squaredNorm() <= squared) break;
      next = uv;
    }
    const Vector2d change = next - uv;
    const double moved = std::abs(change.x()) * s.u.norm() + std::abs(change.y()) * s.v.norm();
    uv = next;
    if (moved <= kStepEnd * size_) break;
  }
  return std::min(squared, (position(patch, uv) - x).squaredNorm());
}

void PatchSearch::search(int patch, const Vector3d& x, double& squared, PatchPoint& best) const {
  const Entry& e = *entries_[patch];
  const auto take = [&](Vector2d uv) {
    const double found = improve(patch, uv, x, squared);
    if (found >= squared) return;
    squared = found;
    best = {patch, uv, position(patch, uv)};
  };
  // A good first distance discards most parts.
  std::size_t first = 0;
  for (std::size_t k = 1; k < e.places.size(); ++k)
    if ((e.places[k] - x).squaredNorm() < (e.places[first] - x).squaredNorm()) first = k;
  take(e.middles[first]);
  e.tree.visitNear(x, std::sqrt(squared), [&](int k, double) {
    // Boxes around the same minimum are closer by their slack alone.
    take(e.middles[k]);
    return std::sqrt(squared);
  });
}

PatchPoint PatchSearch::nearest(int patch, const Vector3d& x) const {
  PatchPoint best;
  double squared = std::numeric_limits<double>::infinity();
  search(patch, x, squared, best);
  return best;
}

PatchPoint PatchSearch::nearest(const Vector3d& x) const {
  PatchPoint best;
  double squared = std::numeric_limits<double>::infinity();
  // A good first distance discards most patches.
  int first = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (int patch = 0; patch < patchCount(); ++patch)
    for (const Vector3d& place : entries_[patch]->places)
      if (const double distance = (place - x).squaredNorm(); distance < nearest) {
        nearest = distance;
        first = patch;
      }
  search(first, x, squared, best);
  for (int patch = 0; patch < patchCount(); ++patch) {
    if (patch == first) continue;
    bool mayBeNearer = false;
    entries_[patch]->tree.visitNear(x, std::sqrt(squared), [&](int, double) {
      mayBeNearer = true;
      return 0.0;
    });
    if (mayBeNearer) search(patch, x, squared, best);
  }
  return best;
}

/// Newton's method for S(u, v) = origin + s direction in the three unknowns.
std::optional<double> PatchSearch::hit(int patch, Vector2d uv, const Vector3d& origin,
                                       const Vector3d& direction) const {
  const Vector2d low = entries_[patch]->low(), high = entries_[patch]->high();
  for (int step = 0; step < kMaxSteps; ++step) {
    const PatchJet at = jet(patch, uv);
    const Vector3d from = at.position - origin;
    const double s = from.dot(direction);
    if ((from - s * direction).norm() <= kHitEnd * size_) return s;
    Eigen::Matrix3d system;
    system << at.u, at.v, -direction;
    const Vector3d way = system.fullPivLu().solve(s * direction - from);
    if (!way.allFinite()) return std::nullopt;
    const Vector2d next = (uv + way.head<2>()).cwiseMax(low).cwiseMin(high);
    if (next == uv) return std::nullopt;  // the ray passes beside the patch
    uv = next;
  }
  return std::nullopt;
}

std::optional<double> PatchSearch::firstHit(const Vector3d& origin, const Vector3d& direction,
                                            double least) const {
  double reach = 4 * size_ + (origin - entries_.front()->places.front()).norm();
  bool isFound = false;
  for (int patch = 0; patch < patchCount(); ++patch) {
    const Entry& e = *entries_[patch];
    e.tree.visitAlong(origin, direction, reach, [&](int k, double) {
      const auto s = hit(patch, e.middles[k], origin, direction);
      if (s && *s > least && *s < reach) {
        reach = *s;
        isFound = true;
      }
      return reach;
    });
  }
  return isFound ? std::optional(reach) : std::nullopt;
}

std::vector<Vector3d> PatchSearch::samples(int patch) const {
  return entries_[patch]->places;
}

}  // namespace palpa::modeling
