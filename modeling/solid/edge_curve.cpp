#include "modeling/solid/edge_curve.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace palpa::modeling {

SurfaceParameter onSide(const SurfaceEvaluator& surface, PatchEdge edge, double t) {
  const int direction = directionOf(edge.side);
  const auto [low, high] = surface.range(edge.patch, direction);
  const auto across = surface.range(edge.patch, 1 - direction);
  const bool atEnd = edge.side == Side::kUMax || edge.side == Side::kVMax;
  // Exact at the ends, independent of the rounding of the interpolation.
  const double along = t <= 0.0 ? low : (t >= 1.0 ? high : low + t * (high - low));
  const double fixed = atEnd ? across[1] : across[0];
  if (direction == 0) return {edge.patch, along, fixed};
  return {edge.patch, fixed, along};
}

SurfaceParameter onEdge(const SurfaceEvaluator& surface, const SolidEdge& edge, int use, double t) {
  return onSide(surface, edge.uses[use], use == 1 && edge.reversed ? 1.0 - t : t);
}

IsoCurve::IsoCurve(const SurfaceEvaluator& surface, int patch, int direction, double fixed) {
  // Chords of 1/16 span and of their halves, improved by Richardson extrapolation: error O(h⁴).
  constexpr int kSamplesPerSpan = 16;
  const auto& spans = surface.spans(patch, direction);
  const auto [low, high] = surface.range(patch, direction);
  const auto point = [&](double t) {
    return direction == 0 ? surface.position(patch, t, fixed) : surface.position(patch, fixed, t);
  };
  fractions_.push_back(0.0);
  lengths_.push_back(0.0);
  turns_.push_back(0.0);
  Eigen::Vector3d before = point(low);
  for (std::size_t i = 1; i < spans.size(); ++i)
    for (int k = 1; k <= kSamplesPerSpan; ++k) {
      const double step = (spans[i] - spans[i - 1]) / kSamplesPerSpan;
      const double t = spans[i - 1] + k * step;
      const Eigen::Vector3d middle = point(t - 0.5 * step);
      const Eigen::Vector3d here = point(t);
      const double fine = (middle - before).norm() + (here - middle).norm();
      const double coarse = (here - before).norm();
      fractions_.push_back((t - low) / (high - low));
      lengths_.push_back(lengths_.back() + fine + (fine - coarse) / 3.0);
      // The angle between the half chords is the turn over half of the step.
      const Eigen::Vector3d first = middle - before;
      const Eigen::Vector3d second = here - middle;
      turns_.push_back(turns_.back() +
                       2.0 * std::atan2(first.cross(second).norm(), first.dot(second)));
      before = here;
    }
  fractions_.back() = 1.0;
}

std::vector<double> IsoCurve::density(double pieceLength) const {
  constexpr double kFinest = 64.0;  // factor on the number of pieces by bends
  std::vector<double> result{0.0};
  bool bends = false;
  for (std::size_t i = 1; i < lengths_.size(); ++i) {
    const double straight = (lengths_[i] - lengths_[i - 1]) / pieceLength;
    const double bent = std::min((turns_[i] - turns_[i - 1]) / kPieceAngle, kFinest * straight);
    bends = bends || bent > straight;
    result.push_back(result.back() + std::max(straight, bent));
  }
  // Without strong bends the result is exactly the arc length, independent of the rounding of the
  // sum.
  if (!bends)
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = lengths_[i] / pieceLength;
  return result;
}

std::vector<double> IsoCurve::cut(int count, double pieceLength) const {
  const std::vector<double> share = density(pieceLength);
  std::vector<double> result(count + 1);
  for (int k = 0; k <= count; ++k) {
    const double wanted = static_cast<double>(k) / count * share.back();
    const auto above = std::upper_bound(share.begin() + 1, share.end() - 1, wanted);
    const std::size_t i = above - share.begin();
    const double width = share[i] - share[i - 1];
    const double part = width > 0.0 ? (wanted - share[i - 1]) / width : 0.5;
    result[k] =
        fractions_[i - 1] + std::clamp(part, 0.0, 1.0) * (fractions_[i] - fractions_[i - 1]);
  }
  result.front() = 0.0;
  result.back() = 1.0;
  return result;
}

}  // namespace palpa::modeling
