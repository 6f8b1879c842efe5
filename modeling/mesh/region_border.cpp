#include "modeling/mesh/region_border.h"

#include <algorithm>
#include <limits>

namespace palpa::modeling {
namespace {

constexpr std::size_t kGroup = 8;  // segments
constexpr double kOfRadius = 0.75;
constexpr double kOfLongestAtEnds = 1.0 / 12.0;
constexpr double kOfLongestAlong = 1.0 / 4.0;

}  // namespace

RegionBorder::RegionBorder(const HalfSpace& half) : half_(half) {}

RegionBorder::RegionBorder(std::vector<Stroke> strokes) : strokes_(std::move(strokes)) {
  for (const Stroke& stroke : strokes_) {
    const auto& points = stroke.points;
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      segments_.push_back(
          {points[i], points[i + 1] - points[i], stroke.radius, i == 0, i + 2 == points.size()});
    if (points.size() == 1)
      segments_.push_back({points.front(), Eigen::Vector3d::Zero(), stroke.radius, true, true});
  }
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Segment& segment = segments_[i];
    const Eigen::Vector3d end = segment.start + segment.along;
    if (i % kGroup == 0) groups_.push_back({i, segment.start, segment.start, segment.radius});
    Group& group = groups_.back();
    group.end = i + 1;
    group.low = group.low.cwiseMin(segment.start).cwiseMin(end);
    group.high = group.high.cwiseMax(segment.start).cwiseMax(end);
    group.radius = std::max(group.radius, segment.radius);
  }
}

bool RegionBorder::operator==(const RegionBorder& other) const {
  return half_ == other.half_ && strokes_ == other.strokes_;
}

Eigen::Vector3d RegionBorder::Segment::nearest(const Eigen::Vector3d& x) const {
  const double length = along.squaredNorm();
  return length > 0.0 ? start + std::clamp(along.dot(x - start) / length, 0.0, 1.0) * along : start;
}

RegionBorder::Nearest RegionBorder::nearest(const Eigen::Vector3d& x) const {
  Nearest best{std::numeric_limits<double>::infinity(), nullptr};
  std::size_t first = 0;
  for (const Group& group : groups_) {
    const double away = (x - x.cwiseMax(group.low).cwiseMin(group.high)).norm() - group.radius;
    if (away < best.value)
      for (std::size_t i = first; i < group.end; ++i) {
        const double value = (x - segments_[i].nearest(x)).norm() - segments_[i].radius;
        if (value < best.value) best = {value, &segments_[i]};
      }
    first = group.end;
  }
  return best;
}

double RegionBorder::value(const Eigen::Vector3d& x) const {
  return half_ ? half_->value(x) : nearest(x).value;
}

Eigen::Vector3d RegionBorder::gradient(const Eigen::Vector3d& x) const {
  return half_ ? half_->normal : (x - nearest(x).segment->nearest(x)).stableNormalized().eval();
}

double RegionBorder::edgeAt(const Eigen::Vector3d& x, double longest) const {
  if (half_) return std::numeric_limits<double>::infinity();
  const Segment& segment = *nearest(x).segment;
  const Eigen::Vector3d from = segment.nearest(x) - segment.start;
  const bool nearEnd = (segment.isFirst && from.norm() <= segment.radius) ||
                       (segment.isLast && (segment.along - from).norm() <= segment.radius);
  return strokeEdge(segment.radius, longest, nearEnd);
}

bool RegionBorder::isLike(const RegionBorder& other) const {
  return half_ == other.half_ &&
         std::equal(
             strokes_.begin(), strokes_.end(), other.strokes_.begin(), other.strokes_.end(),
             [](const Stroke& a, const Stroke& b) { return a.points.size() == b.points.size(); });
}

double strokeEdge(double radius, double longest, bool nearEnd) {
  return std::max(kOfRadius * radius, (nearEnd ? kOfLongestAtEnds : kOfLongestAlong) * longest);
}

}  // namespace palpa::modeling
