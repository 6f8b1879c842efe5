#include "modeling/mesh/patch_folds.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

constexpr int kSamples = 4;          // per span and direction, at least
constexpr int kMinSamples = 16;      // per patch and direction
constexpr double kOpposite = -0.97;  // cosine between normals on both sides of a fold
constexpr double kFlat = 1e-9;       // of the patch's mean |du × dv|
constexpr double kParallel = 1e-7;   // sine of the angle between du and dv

class FoldSearch {
 public:
  FoldSearch(const SurfaceEvaluator& surface, int patch) : surface_(surface), patch_(patch) {}

  std::optional<PatchFold> run() {
    const std::vector<double> us = samples(0);
    const std::vector<double> vs = samples(1);
    std::vector<std::vector<Vector3d>> products(us.size(), std::vector<Vector3d>(vs.size()));
    double mean = 0.0;
    for (std::size_t i = 0; i < us.size(); ++i)
      for (std::size_t j = 0; j < vs.size(); ++j) {
        products[i][j] = product(us[i], vs[j]);
        mean += products[i][j].norm() / static_cast<double>(us.size() * vs.size());
      }
    for (std::size_t i = 0; i < us.size(); ++i)
      for (std::size_t j = 0; j < vs.size(); ++j) {
        if (products[i][j].norm() <= kFlat * mean) return PatchFold{{patch_, us[i], vs[j]}, true};
        if (i > 0)
          if (const auto fold = between(us[i - 1], vs[j], us[i], vs[j])) return fold;
        if (j > 0)
          if (const auto fold = between(us[i], vs[j - 1], us[i], vs[j])) return fold;
      }
    return std::nullopt;
  }

 private:
  std::vector<double> samples(int direction) const {
    const std::vector<double>& spans = surface_.spans(patch_, direction);
    const int count = static_cast<int>(spans.size()) - 1;
    const int perSpan = std::max(kSamples, (kMinSamples + count - 1) / count);
    std::vector<double> result;
    for (std::size_t i = 1; i < spans.size(); ++i)
      for (int k = 0; k < perSpan; ++k)
        result.push_back(spans[i - 1] + (spans[i] - spans[i - 1]) * (k + 0.5) / perSpan);
    return result;
  }

  Vector3d product(double u, double v) const {
    const SurfacePoint p = surface_.evaluate(patch_, u, v);
    return p.du.cross(p.dv);
  }

  std::optional<PatchFold> between(double u0, double v0, double u1, double v1) const {
    constexpr int kHalvings = 30;
    Vector3d first = product(u0, v0).normalized();
    Vector3d second = product(u1, v1).normalized();
    for (int i = 0; i < kHalvings && first.dot(second) < 0.0; ++i) {
      const double u = 0.5 * (u0 + u1);
      const double v = 0.5 * (v0 + v1);
      const SurfacePoint p = surface_.evaluate(patch_, u, v);
      const Vector3d middle = p.du.cross(p.dv);
      if (middle.norm() <= kParallel * p.du.norm() * p.dv.norm()) break;
      const Vector3d normal = middle.normalized();
      if (first.dot(normal) < normal.dot(second)) {
        u1 = u;
        v1 = v;
        second = normal;
      } else {
        u0 = u;
        v0 = v;
        first = normal;
      }
    }
    if (first.dot(second) > kOpposite) return std::nullopt;
    return PatchFold{{patch_, 0.5 * (u0 + u1), 0.5 * (v0 + v1)}, false};
  }

  const SurfaceEvaluator& surface_;
  int patch_;
};

}  // namespace

std::vector<PatchFold> patchFolds(const SurfaceEvaluator& surface, const Job& job) {
  std::vector<PatchFold> folds;
  for (int patch = 0; patch < surface.patchCount(); ++patch) {
    job.throwIfCancelled();
    if (const auto fold = FoldSearch(surface, patch).run()) folds.push_back(*fold);
  }
  return folds;
}

}  // namespace palpa::modeling
