#include "modeling/measure/mesh_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "modeling/body/smooth_regions.h"

namespace palpa::modeling {

using Eigen::Vector3d;

Vector3d nearestOnSegment(const Vector3d& a, const Vector3d& b, const Vector3d& x) {
  const double squared = (b - a).squaredNorm();
  return squared > 0 ? Vector3d(a + std::clamp((x - a).dot(b - a) / squared, 0.0, 1.0) * (b - a))
                     : a;
}

double heightOf(const std::vector<Vector3d>& line) {
  Vector3d far = line.front();
  for (const Vector3d& point : line)
    if ((point - line.front()).norm() > (far - line.front()).norm()) far = point;
  const Vector3d along = (far - line.front()).normalized();
  double height = 0;
  for (const Vector3d& point : line)
    height = std::max(height, (point - line.front()).cross(along).norm());
  return height;
}

MeshEdges::MeshEdges(const MeshBody& body, std::span<const std::array<int, 3>> neighbours)
    : body_(body) {
  for (std::size_t t = 0; t < body.triangles().size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int here = body.faceOfTriangle()[t], there = body.faceOfTriangle()[neighbours[t][k]];
      const auto& n = body.triangles()[t];
      if (here < there) borders_[{here, there}].push_back({n[k], n[(k + 1) % 3]});
    }
}

std::optional<MeshEdge> MeshEdges::at(int face, int other, const Vector3d& point,
                                      double reach) const {
  const auto border = borders_.find(std::minmax(face, other));
  if (border == borders_.end()) return std::nullopt;
  const std::vector<Segment>& segments = border->second;
  const auto& p = body_.positions();
  std::size_t first = 0;
  MeshEdge chain;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Vector3d found = nearestOnSegment(p[segments[i][0]], p[segments[i][1]], point);
    if ((found - point).norm() >= least) continue;
    least = (found - point).norm();
    chain.position = found;
    first = i;
  }
  if (least > reach) return std::nullopt;
  // Segments of one border run in one direction, so each vertex has one in front and one behind.
  std::multimap<int, std::size_t> after, before;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    after.emplace(segments[i][0], i);
    before.emplace(segments[i][1], i);
  }
  const auto continues = [&](std::size_t a, std::size_t b) {  // b follows a
    const Vector3d u = p[segments[a][1]] - p[segments[a][0]];
    const Vector3d v = p[segments[b][1]] - p[segments[b][0]];
    return std::atan2(u.cross(v).norm(), u.dot(v)) < kSharpEdgeDegrees * std::numbers::pi / 180.0;
  };
  std::vector<std::size_t> list{first};
  bool isClosed = false;
  // Faces that meet at a vertex twice could lead into a circle without the first segment.
  const auto isWhole = [&] { return list.size() >= segments.size(); };
  for (std::size_t at = first; !isWhole() || segments[at][1] == segments[first][0];) {
    if (after.count(segments[at][1]) != 1) break;
    const std::size_t next = after.find(segments[at][1])->second;
    if (!continues(at, next)) break;
    if (next == first) {
      isClosed = true;
      break;
    }
    list.push_back(at = next);
  }
  for (std::size_t at = first; !isClosed && !isWhole();) {
    if (before.count(segments[at][0]) != 1) break;
    const std::size_t next = before.find(segments[at][0])->second;
    if (!continues(next, at)) break;
    list.insert(list.begin(), at = next);
    ++chain.segment;
  }
  for (const std::size_t i : list) chain.points.push_back(p[segments[i][0]]);
  chain.points.push_back(p[segments[list.back()][1]]);
  return chain;
}

std::optional<MeshEdges::Near> MeshEdges::nearest(int face, const Vector3d& point) const {
  std::optional<Near> best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [faces, segments] : borders_) {
    if (faces.first != face && faces.second != face) continue;
    const int other = faces.first == face ? faces.second : faces.first;
    for (const auto& [a, b] : segments) {
      const Vector3d found = nearestOnSegment(body_.positions()[a], body_.positions()[b], point);
      const double distance = (found - point).norm();
      if (distance >= least) continue;
      least = distance;
      best = {found, other};
    }
  }
  return best;
}

}  // namespace palpa::modeling
