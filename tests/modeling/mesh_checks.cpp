#include "mesh_checks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "modeling/solid/surface_evaluator.h"

namespace palpa::modeling::checks {
namespace {

Eigen::Vector3d areaVector(const SurfaceMesh& mesh, int t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return 0.5 * (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
}

}  // namespace

std::string manifoldFault(const SurfaceMesh& mesh) {
  std::map<std::pair<int, int>, int> uses;
  std::set<int> nodes;
  for (const auto& n : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      nodes.insert(n[k]);
      if (++uses[{n[k], n[(k + 1) % 3]}] > 1) return "an edge is used twice in one direction";
    }
  for (const auto& [edge, count] : uses)
    if (!uses.contains({edge.second, edge.first})) return "an edge has only one triangle";
  if (nodes.size() != mesh.positions.size()) return "a node belongs to no triangle";
  const long euler = static_cast<long>(nodes.size()) - static_cast<long>(uses.size() / 2) +
                     static_cast<long>(mesh.triangles.size());
  return euler == 2 ? "" : "Euler characteristic " + std::to_string(euler);
}

double enclosedVolume(const SurfaceMesh& mesh) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    sum += mesh.positions[mesh.triangles[t][0]].dot(areaVector(mesh, static_cast<int>(t))) / 3.0;
  return sum;
}

double totalArea(const SurfaceMesh& mesh) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    sum += areaVector(mesh, static_cast<int>(t)).norm();
  return sum;
}

double regionArea(const SurfaceMesh& mesh, int region) {
  double sum = 0.0;
  for (int t : mesh.trianglesOfRegion[region]) sum += areaVector(mesh, t).norm();
  return sum;
}

double distanceFromSurface(const SurfaceMesh& mesh, const Solid& solid) {
  const SurfaceEvaluator surface(solid);
  double worst = 0.0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const SurfaceParameter& at = mesh.parameters[i];
    worst = std::max(worst, (surface.position(at.patch, at.u, at.v) - mesh.positions[i]).norm());
  }
  return worst;
}

std::vector<int> borderNodes(const SurfaceMesh& mesh, int region) {
  const std::set<int> chosen(mesh.trianglesOfRegion[region].begin(),
                             mesh.trianglesOfRegion[region].end());
  std::set<int> inside;
  std::set<int> outside;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int node : mesh.triangles[t])
      (chosen.contains(static_cast<int>(t)) ? inside : outside).insert(node);
  std::vector<int> shared;
  std::set_intersection(inside.begin(), inside.end(), outside.begin(), outside.end(),
                        std::back_inserter(shared));
  return shared;
}

double borderFault(const SurfaceMesh& mesh, int region, const HalfSpace& half) {
  double worst = 0.0;
  for (int node : borderNodes(mesh, region))
    worst = std::max(worst, std::abs(half.value(mesh.positions[node])));
  return worst;
}

}  // namespace palpa::modeling::checks
