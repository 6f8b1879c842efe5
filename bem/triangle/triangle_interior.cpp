#include "bem/triangle/triangle_interior.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/parallel.h"
#include "base/scratch_pool.h"
#include "bem/base/triangle_rule.h"
#include "bem/model/body_force.h"
#include "bem/triangle/results.h"

namespace palpa::bem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Distance of a point from the centroid over the radius of a triangle, from which a rule suffices.
/// Measured in tests/bem/interior_evaluator_test.cpp.
constexpr double kRatio3 = 7, kRatio7 = 2.7, kRatio16 = 1.5;
constexpr int kDeepest = 10;
constexpr int kMaxLevels = 3;  ///< layers of up to three faces meet at a corner
constexpr std::size_t kScratch = 1024;

struct Rule {
  std::span<const TrianglePoint> points;
  double ratio;
};
std::array<Rule, 3> rules() {
  return {Rule{triangleRule3(), kRatio3}, Rule{triangleRule7(), kRatio7},
          Rule{triangleRule16(), kRatio16}};
}

double sizeOf(double area) {
  return std::sqrt(2 * area);
}

}  // namespace

/// A field, as sources at the points of each rule, and its stress at the slots.
struct TriangleInterior::Fields {
  const VectorXd &u, &p;
  std::array<InteriorSources, 3> sources;
  std::vector<Matrix3d> stress;
};

TriangleInterior::TriangleInterior(const BoundaryMesh& mesh, const TractionSlots& slots,
                                   const Bulk& bulk, std::vector<Vector3d> points, const Job& job,
                                   double layer)
    : InteriorEvaluator(std::move(points)),
      mesh_(mesh),
      slots_(slots),
      bulk_(bulk),
      centre_(mesh.nodes.front()),
      constants_(bulk.material),
      sum_(sumInteriorForThisProcessor()),
      tree_(mesh) {
  triangles_.reserve(mesh.triangles.size());
  for (int t = 0; t < mesh.triangleCount(); ++t) {
    Geometry geometry{mesh.point(t, Vector3d::Constant(1.0 / 3)), mesh.normal(t), mesh.area(t), 0};
    for (const int node : mesh.triangles[t])
      geometry.radius = std::max(geometry.radius, (mesh.nodes[node] - geometry.centroid).norm());
    triangles_.push_back(geometry);
  }
  parts_.resize(this->points().size());
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    if (k % 256 == 0) job.throwIfCancelled();
    resolve(this->points()[k], 1, 0, layer, parts_[k], targets_);
  }
}

void TriangleInterior::resolve(const Vector3d& x, double weight, int level, double layer,
                               std::vector<Part>& parts, std::vector<Vector3d>& targets) const {
  const SurfacePoint foot = tree_.nearest(x);
  const Vector3d& normal = triangles_[foot.triangle].normal;
  const double size = sizeOf(triangles_[foot.triangle].area);
  if ((x - foot.position).dot(normal) >= 0) {
    // Points between the flat triangles and the curved surface count as surface points.
    parts.push_back({weight, -1, foot});
    return;
  }
  double thickness = layer * size;
  if (foot.distance >= 0.999 * thickness || level == kMaxLevels) {
    parts.push_back({weight, static_cast<int>(targets.size()), foot});
    targets.push_back(x);
    return;
  }
  const Vector3d inwards = foot.distance > 1e-6 * size
                               ? Vector3d((x - foot.position) / foot.distance)
                               : Vector3d(-normal);
  // In thin walls the layer ends before the middle.
  Vector3d end = foot.position + thickness * inwards;
  for (int halving = 0; halving < 8 && thickness > foot.distance; ++halving) {
    const SurfacePoint other = tree_.nearest(end);
    const Vector3d& opposite = triangles_[other.triangle].normal;
    const bool isInside = (end - other.position).dot(opposite) < 0;
    if (isInside && (opposite.dot(normal) > -0.5 || other.distance > 0.9 * thickness)) break;
    thickness = std::max(foot.distance, 0.75 * thickness);
    end = foot.position + thickness * inwards;
  }
  const double share = std::min(1.0, foot.distance / thickness);
  if (share < 1) parts.push_back({weight * (1 - share), -1, foot});
  if (share > 0)
    resolve(end, weight * share, share < 1 ? level + 1 : kMaxLevels, layer, parts, targets);
}

void TriangleInterior::setSource(InteriorSources& sources, std::size_t index, const Vector3d& y,
                                 const Vector3d& area, Vector3d displacement,
                                 Vector3d force) const {
  if (bulk_.hasBodyForce()) {
    const ParticularState particular = particularState(y - centre_, area, bulk_);
    displacement -= particular.displacement;
    force -= particular.traction;  // linear in the area vector
  }
  sources.set(index, y, area, displacement, force);
}

void TriangleInterior::addNear(int triangle, const Vector3d& x, const Matrix3d& cell, double part,
                               int depth, const Fields& fields, InteriorSources& scratch,
                               InteriorSums& sums) const {
  const auto& nodes = mesh_.triangles[triangle];
  Matrix3d corners;
  for (int a = 0; a < 3; ++a) corners.col(a) = mesh_.nodes[nodes[a]];
  const Matrix3d cellCorners = corners * cell;
  const Vector3d centroid = cellCorners.rowwise().mean();
  const double radius = (cellCorners.colwise() - centroid).colwise().norm().maxCoeff();
  const double ratio = (centroid - x).norm() / radius;
  if (ratio < kRatio16 && depth < kDeepest) {
    const Vector3d m0 = (cell.col(0) + cell.col(1)) / 2, m1 = (cell.col(1) + cell.col(2)) / 2,
                   m2 = (cell.col(2) + cell.col(0)) / 2;
    Matrix3d sub;
    const auto addPart = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
      sub << a, b, c;
      addNear(triangle, x, sub, part / 4, depth + 1, fields, scratch, sums);
    };
    addPart(cell.col(0), m0, m2);
    addPart(m0, cell.col(1), m1);
    addPart(m2, m1, cell.col(2));
    addPart(m0, m1, m2);
    return;
  }
  Matrix3d u, p;
  for (int a = 0; a < 3; ++a) {
    u.col(a) = fields.u.segment<3>(3 * nodes[a]);
    p.col(a) = fields.p.segment<3>(3 * slots_.ofCorner[triangle][a]);
  }
  const Geometry& geometry = triangles_[triangle];
  for (const TrianglePoint& q : ratio >= kRatio7 ? triangleRule7() : triangleRule16()) {
    const Vector3d weights = cell * Vector3d(q.barycentric[0], q.barycentric[1], q.barycentric[2]);
    const double area = q.weight * part * geometry.area;
    setSource(scratch, scratch.append(), corners * weights, area * geometry.normal, u * weights,
              area * (p * weights));
  }
  if (scratch.count() + triangleRule16().size() > kScratch) {
    const LinearState none;
    sum_(scratch.task(constants_, 0, scratch.count(), none, x, sums.displacement.data(),
                      sums.stress.data()));
    scratch.clear();
  }
}

InteriorState TriangleInterior::sumAt(const Vector3d& x, const Fields& fields,
                                      InteriorSources& scratch) const {
  const LinearState none;
  InteriorSums sums;
  scratch.reserve(kScratch);
  const std::array<Rule, 3> all = rules();
  // Triangles in a row with the same rule are one call.
  int runRule = -1, runStart = 0;
  const auto finish = [&](int end) {
    if (runRule < 0 || end == runStart) return;
    const auto rule = static_cast<std::size_t>(runRule);
    const std::size_t points = all[rule].points.size();
    sum_(fields.sources[rule].task(constants_, points * runStart, points * (end - runStart), none,
                                   x, sums.displacement.data(), sums.stress.data()));
  };
  for (int t = 0; t < mesh_.triangleCount(); ++t) {
    const Geometry& geometry = triangles_[t];
    const double squared =
        (geometry.centroid - x).squaredNorm() / (geometry.radius * geometry.radius);
    int rule = 0;
    while (rule < 3 && squared < all[rule].ratio * all[rule].ratio) ++rule;
    const int kept = rule == 3 ? -1 : rule;
    if (kept != runRule) {
      finish(t);
      runRule = kept;
      runStart = t;
    }
    if (kept < 0) addNear(t, x, Matrix3d::Identity(), 1, 0, fields, scratch, sums);
  }
  finish(mesh_.triangleCount());
  sum_(scratch.task(constants_, 0, scratch.count(), none, x, sums.displacement.data(),
                    sums.stress.data()));
  InteriorState state = sums.state();
  if (bulk_.hasBodyForce()) {
    state.displacement += particularState(x - centre_, Vector3d::Zero(), bulk_).displacement;
    state.stress += particularStress(x - centre_, bulk_);
  }
  return state;
}

std::vector<InteriorState> TriangleInterior::evaluateAll(const VectorXd& u, const VectorXd& p,
                                                         const Job& job) const {
  Fields fields{u, p, {}, {}};
  const std::array<Rule, 3> all = rules();
  for (std::size_t r = 0; r < all.size(); ++r) {
    InteriorSources& sources = fields.sources[r];
    sources.resize(all[r].points.size() * triangles_.size());
    std::size_t index = 0;
    for (int t = 0; t < mesh_.triangleCount(); ++t) {
      Matrix3d corners, atU, atP;
      for (int a = 0; a < 3; ++a) {
        corners.col(a) = mesh_.nodes[mesh_.triangles[t][a]];
        atU.col(a) = u.segment<3>(3 * mesh_.triangles[t][a]);
        atP.col(a) = p.segment<3>(3 * slots_.ofCorner[t][a]);
      }
      for (const TrianglePoint& q : all[r].points) {
        const Vector3d weights(q.barycentric[0], q.barycentric[1], q.barycentric[2]);
        const double area = q.weight * triangles_[t].area;
        setSource(sources, index++, corners * weights, area * triangles_[t].normal, atU * weights,
                  area * (atP * weights));
      }
    }
  }
  fields.stress = surfaceStress(mesh_, slots_, u, p, bulk_.material);

  std::vector<InteriorState> ofTargets(targets_.size());
  ScratchPool<InteriorSources> pool([] { return InteriorSources{}; });
  constexpr std::ptrdiff_t kPerTask = 8;
  const auto count = static_cast<std::ptrdiff_t>(targets_.size());
  parallelFor((count + kPerTask - 1) / kPerTask, job, [&](std::ptrdiff_t task) {
    InteriorSources scratch = pool.take();
    for (std::ptrdiff_t k = task * kPerTask; k < std::min(count, (task + 1) * kPerTask); ++k)
      ofTargets[k] = sumAt(targets_[k], fields, scratch);
    pool.giveBack(std::move(scratch));
  });

  std::vector<InteriorState> states;
  states.reserve(parts_.size());
  for (const std::vector<Part>& parts : parts_) {
    InteriorState state{Vector3d::Zero(), Matrix3d::Zero()};
    for (const Part& part : parts) {
      if (part.target >= 0) {
        state.displacement += part.weight * ofTargets[part.target].displacement;
        state.stress += part.weight * ofTargets[part.target].stress;
        continue;
      }
      for (int a = 0; a < 3; ++a) {
        const double weight = part.weight * part.place.weights[a];
        const int triangle = part.place.triangle;
        state.displacement += weight * u.segment<3>(3 * mesh_.triangles[triangle][a]);
        state.stress += weight * fields.stress[slots_.ofCorner[triangle][a]];
      }
    }
    states.push_back(state);
  }
  return states;
}

}  // namespace palpa::bem
