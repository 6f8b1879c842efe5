#include "app/gui/document/point_groups.h"

#include <algorithm>

#include "modeling/solid/control_normals.h"
#include "modeling/solid/surface_properties.h"
#include "modeling/solid/tessellation.h"

namespace palpa::gui {

using modeling::Solid;

std::set<int> allPoints(const Solid& solid) {
  std::set<int> all;
  for (std::size_t i = 0; i < solid.controlPoints().size(); ++i)
    all.insert(all.end(), static_cast<int>(i));
  return all;
}

std::set<int> pointsOfPatch(const Solid& solid, int patch) {
  std::set<int> points;
  for (const std::vector<int>& row : solid.patches()[patch].net)
    points.insert(row.begin(), row.end());
  return points;
}

std::set<int> pointsOfEdge(const Solid& solid, int edge) {
  const modeling::PatchEdge& use = solid.edges()[edge].uses[0];
  const std::vector<std::vector<int>>& net = solid.patches()[use.patch].net;
  if (use.side == modeling::Side::kUMin) return {net.front().begin(), net.front().end()};
  if (use.side == modeling::Side::kUMax) return {net.back().begin(), net.back().end()};
  std::set<int> points;
  for (const std::vector<int>& row : net)
    points.insert(use.side == modeling::Side::kVMin ? row.front() : row.back());
  return points;
}

std::set<int> pointsOf(const Selection& selection, const Solid& solid) {
  std::set<int> points = selection.points;
  for (int patch : selection.patches) points.merge(pointsOfPatch(solid, patch));
  for (int edge : selection.edges) points.merge(pointsOfEdge(solid, edge));
  return points;
}

std::set<int> grown(const std::set<int>& points, const Solid& solid) {
  std::set<int> result = points;
  for (const auto& [a, b] : modeling::controlNetLines(solid)) {
    if (points.contains(a)) result.insert(b);
    if (points.contains(b)) result.insert(a);
  }
  return result;
}

std::set<int> shrunk(const std::set<int>& points, const Solid& solid) {
  return inverted(grown(inverted(points, solid), solid), solid);
}

std::set<int> inverted(const std::set<int>& points, const Solid& solid) {
  std::set<int> others = allPoints(solid);
  for (int point : points) others.erase(point);
  return others;
}

std::set<int> followersOf(const std::set<int>& points, const modeling::Reach& reach,
                          const Solid& solid) {
  const std::vector<Eigen::Vector3d>& places = solid.controlPoints();
  std::set<int> followers;
  std::vector<Eigen::Vector3d> leaders;
  for (int point : points) leaders.push_back(places[point]);
  if (reach.mirror) {
    const auto [low, high] = modeling::boundingBox(solid);
    const double tolerance = 1e-6 * (high - low).norm();  // of Reach::mirror
    const Eigen::Vector3d normal = reach.mirror->normal.normalized();
    for (int point : points) {
      const double height = normal.dot(places[point] - reach.mirror->point);
      if (std::abs(height) <= tolerance) continue;
      const Eigen::Vector3d image = places[point] - 2.0 * height * normal;
      leaders.push_back(image);
      for (std::size_t i = 0; i < places.size(); ++i)
        if ((places[i] - image).norm() <= tolerance) followers.insert(static_cast<int>(i));
    }
  }
  if (reach.falloff) {
    for (std::size_t i = 0; i < places.size(); ++i)
      if (std::any_of(leaders.begin(), leaders.end(), [&](const Eigen::Vector3d& leader) {
            return (places[i] - leader).norm() < *reach.falloff;
          }))
        followers.insert(static_cast<int>(i));
  }
  for (int point : points) followers.erase(point);
  return followers;
}

Eigen::Vector3d meanOf(const std::set<int>& points, const Solid& solid) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int point : points) sum += solid.controlPoints()[point];
  return sum / static_cast<double>(points.size());
}

Eigen::Vector3d meanNormal(const std::set<int>& points, const Solid& solid) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& normal :
       modeling::controlNormals(solid, {points.begin(), points.end()}))
    sum += normal;
  if (sum.norm() < 1e-6 * static_cast<double>(points.size())) return Eigen::Vector3d::Zero();
  return sum.normalized();
}

}  // namespace palpa::gui
