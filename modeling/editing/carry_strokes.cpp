#include "modeling/editing/carry_strokes.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "modeling/solid/basis.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

/// The surface point nearest to a point of a stroke as a sum of control points.
struct Place {
  std::vector<std::pair<int, double>> weights;
};

/// Finds the nearest surface points: the nearest of many samples, from there Gauss and Newton's
/// method within the patch.
class NearestOnPatches {
 public:
  explicit NearestOnPatches(const Solid& solid) : solid_(solid), surface_(solid) {
    constexpr int kPerSpan = 6;
    for (int patch = 0; patch < surface_.patchCount(); ++patch) {
      const auto parameters = [&](int direction) {
        const std::vector<double>& spans = surface_.spans(patch, direction);
        std::vector<double> values{spans.front()};
        for (std::size_t i = 1; i < spans.size(); ++i)
          for (int k = 1; k <= kPerSpan; ++k)
            values.push_back(spans[i - 1] + (spans[i] - spans[i - 1]) * k / kPerSpan);
        return values;
      };
      const std::vector<double> along = parameters(1);
      for (const double u : parameters(0))
        for (const double v : along)
          samples_.push_back({patch, u, v, surface_.position(patch, u, v)});
    }
  }

  Place of(const Vector3d& x) const {
    Sample at =
        *std::min_element(samples_.begin(), samples_.end(), [&](const Sample& a, const Sample& b) {
          return (a.position - x).squaredNorm() < (b.position - x).squaredNorm();
        });
    improve(at, x);
    return place(at);
  }

 private:
  struct Sample {
    int patch;
    double u;
    double v;
    Vector3d position;
  };

  void improve(Sample& at, const Vector3d& x) const {
    constexpr int kIterations = 12;
    const auto [uLow, uHigh] = surface_.range(at.patch, 0);
    const auto [vLow, vHigh] = surface_.range(at.patch, 1);
    for (int iteration = 0; iteration < kIterations; ++iteration) {
      const SurfacePoint p = surface_.evaluate(at.patch, at.u, at.v);
      Eigen::Matrix<double, 3, 2> jacobian;
      jacobian << p.du, p.dv;
      Eigen::Matrix2d metric = jacobian.transpose() * jacobian;
      metric.diagonal().array() += 1e-9 * metric.trace();
      const Eigen::Vector2d step = metric.inverse() * (jacobian.transpose() * (x - p.position));
      if (!step.allFinite()) return;
      Sample next = at;
      double part = 1.0;
      for (int halving = 0; halving < 6; ++halving, part *= 0.5) {
        next.u = std::clamp(at.u + part * step[0], uLow, uHigh);
        next.v = std::clamp(at.v + part * step[1], vLow, vHigh);
        next.position = surface_.position(at.patch, next.u, next.v);
        if ((next.position - x).squaredNorm() < (p.position - x).squaredNorm()) break;
      }
      if ((next.position - x).squaredNorm() >= (p.position - x).squaredNorm()) return;
      const bool done = (next.position - p.position).norm() <= 1e-9 * (1.0 + p.position.norm());
      at = next;
      if (done) return;
    }
  }

  Place place(const Sample& at) const {
    const Patch& patch = solid_.patches()[at.patch];
    const auto u = basisAt(patch.knots[0], patch.degree[0], at.u);
    const auto v = basisAt(patch.knots[1], patch.degree[1], at.v);
    Place result;
    for (int i = 0; i <= patch.degree[0]; ++i)
      for (int j = 0; j <= patch.degree[1]; ++j)
        if (const double weight = u.value[i] * v.value[j]; weight != 0.0)
          result.weights.emplace_back(patch.net[u.first + i][v.first + j], weight);
    return result;
  }

  const Solid& solid_;
  SurfaceEvaluator surface_;
  std::vector<Sample> samples_;
};

template <class What>
void forStrokes(Project& project, What what) {
  const auto visit = [&](Region& region) {
    for (RegionPart& part : region.parts)
      if (auto* stroke = std::get_if<Stroke>(&part)) what(*stroke);
  };
  for (Support& support : project.supports) visit(support.where);
  for (Load& load : project.loads) {
    if (auto* pressure = std::get_if<Pressure>(&load.what)) visit(pressure->where);
    if (auto* traction = std::get_if<UniformTraction>(&load.what)) visit(traction->where);
  }
}

/// The last answer: a drag asks the same again and again.
struct Memory {
  Solid solid;
  std::vector<Vector3d> points;
  std::vector<Place> places;
};

const std::vector<Place>& placesOf(const Solid& solid, std::vector<Vector3d> points) {
  static thread_local std::optional<Memory> last;
  if (last && last->solid.sharesTopologyWith(solid) && last->points == points &&
      last->solid.controlPoints() == solid.controlPoints())
    return last->places;
  const NearestOnPatches nearest(solid);
  std::vector<Place> places;
  for (const Vector3d& point : points) places.push_back(nearest.of(point));
  last = Memory{solid, std::move(points), std::move(places)};
  return last->places;
}

}  // namespace

void carryStrokes(const Solid& before, Project& project) {
  const Solid& after = std::get<Solid>(project.body);
  std::vector<Vector3d> points;
  forStrokes(project, [&](const Stroke& stroke) {
    points.insert(points.end(), stroke.points.begin(), stroke.points.end());
  });
  if (points.empty() || before.controlPoints() == after.controlPoints()) return;
  auto place = placesOf(before, std::move(points)).begin();
  forStrokes(project, [&](Stroke& stroke) {
    for (Vector3d& point : stroke.points) {
      Vector3d moved = Vector3d::Zero();
      for (const auto& [control, weight] : place->weights)
        moved += weight * (after.controlPoints()[control] - before.controlPoints()[control]);
      if (moved != Vector3d::Zero()) point += moved;
      ++place;
    }
  });
}

}  // namespace palpa::modeling
