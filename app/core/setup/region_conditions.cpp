#include "app/core/setup/region_conditions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "app/core/setup/support_conflict.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Support;

/// True if two fixed supports prescribe different displacements.
bool displaceDifferently(const Support& a, const Support& b) {
  return (a.displacement - b.displacement).norm() > 1e-12 * (1 + b.displacement.norm());
}

/// True if two supports contradict each other on a surface with this unit normal.
bool contradict(const Support& a, const Support& b, const Vector3d& normal) {
  const bool areFixed = a.kind == Support::Kind::kFixed && b.kind == Support::Kind::kFixed;
  if (areFixed) return displaceDifferently(a, b);
  return std::abs(normal.dot(a.displacement - b.displacement)) >
         1e-9 * (1 + a.displacement.norm() + b.displacement.norm());
}

/// The one of the places that is nearest to their mean.
Vector3d middleOf(const std::vector<Vector3d>& places) {
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& place : places) mean += place / static_cast<double>(places.size());
  return *std::min_element(places.begin(), places.end(), [&](const auto& a, const auto& b) {
    return (a - mean).squaredNorm() < (b - mean).squaredNorm();
  });
}

/// Throws the error for the first pair of supports with places.
using PlacesOfPair = std::map<std::pair<int, int>, std::vector<Vector3d>>;
void throwIfAny(const PlacesOfPair& conflicts, const modeling::Project& project, bool overlaps) {
  if (conflicts.empty()) return;
  const auto& [pair, places] = *conflicts.begin();
  throw SupportConflictError({project.supports[pair.first].name, project.supports[pair.second].name,
                              middleOf(places), overlaps});
}

}  // namespace

RegionTags::RegionTags(const modeling::Project& project, const modeling::SurfaceMesh& mesh) {
  for (const Support& support : project.supports)
    isFixed_.push_back(support.kind == Support::Kind::kFixed);
  std::vector<std::vector<int>> regions(mesh.triangles.size());
  for (std::size_t r = 0; r < mesh.trianglesOfRegion.size(); ++r)
    for (const int t : mesh.trianglesOfRegion[r])
      regions[t] = united(std::move(regions[t]), static_cast<int>(r));
  for (const auto& combination : regions) ofTriangle_.push_back(tagOf(combination));
}

int RegionTags::tagOf(const std::vector<int>& combination) {
  const auto [found, added] =
      tags_.try_emplace(combination, static_cast<int>(combinations_.size()));
  if (added) combinations_.push_back(combination);
  return found->second;
}

std::vector<int> RegionTags::united(std::vector<int> combination, int region) const {
  const auto isSupport = [this](int r) { return static_cast<std::size_t>(r) < isFixed_.size(); };
  if (isSupport(region) && !combination.empty() && isSupport(combination.front())) {
    int& present = combination.front();
    const bool isStronger = isFixed_[region] != isFixed_[present]
                                ? static_cast<bool>(isFixed_[region])
                                : region < present;
    if (isStronger) present = region;
    return combination;
  }
  combination.insert(std::upper_bound(combination.begin(), combination.end(), region), region);
  return combination;
}

int RegionTags::with(int tag, int region) {
  if (isIn(tag, region)) return tag;
  return tagOf(united(combinations_[tag], region));
}

bool RegionTags::isIn(int tag, int region) const {
  return std::binary_search(combinations_[tag].begin(), combinations_[tag].end(), region);
}

std::optional<int> RegionTags::supportOf(int tag) const {
  const std::vector<int>& regions = combinations_[tag];
  if (regions.empty() || static_cast<std::size_t>(regions.front()) >= isFixed_.size()) return {};
  return regions.front();
}

std::vector<int> RegionTags::ofSupports() const {
  std::vector<int> tags;
  for (int tag = 0; tag < static_cast<int>(combinations_.size()); ++tag)
    if (supportOf(tag)) tags.push_back(tag);
  return tags;
}

std::vector<int> RegionTags::trianglesIn(int region) const {
  std::vector<int> triangles;
  for (std::size_t t = 0; t < ofTriangle_.size(); ++t)
    if (isIn(ofTriangle_[t], region)) triangles.push_back(static_cast<int>(t));
  return triangles;
}

void checkSupports(const modeling::Project& project, const RegionTags& tags,
                   const modeling::SurfaceMesh& mesh) {
  std::vector<std::vector<int>> supports(mesh.triangles.size());
  PlacesOfPair overlaps;
  for (std::size_t s = 0; s < project.supports.size(); ++s)
    for (const int t : mesh.trianglesOfRegion[s]) {
      const auto& [a, b, c] = mesh.triangles[t];
      const auto& p = mesh.positions;
      const Vector3d normal = (p[b] - p[a]).cross(p[c] - p[a]).normalized();
      for (const int other : supports[t])
        if (contradict(project.supports[other], project.supports[s], normal))
          overlaps[{other, static_cast<int>(s)}].emplace_back((p[a] + p[b] + p[c]) / 3);
      supports[t].push_back(static_cast<int>(s));
    }
  throwIfAny(overlaps, project, true);
  std::map<int, std::set<int>> fixedOfNode;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (const auto s = tags.supportOf(tags.ofTriangle()[t]);
        s && project.supports[*s].kind == Support::Kind::kFixed)
      for (const int node : mesh.triangles[t]) fixedOfNode[node].insert(*s);
  PlacesOfPair meetings;
  for (const auto& [node, meeting] : fixedOfNode)
    for (const int a : meeting)
      for (const int b : meeting)
        if (a < b && displaceDifferently(project.supports[a], project.supports[b]))
          meetings[{a, b}].push_back(mesh.positions[node]);
  throwIfAny(meetings, project, false);
}

bem::BoundaryMesh boundaryMesh(const modeling::SurfaceMesh& surface, std::vector<int> tags) {
  bem::BoundaryMesh mesh{surface.positions, surface.triangles, surface.smoothingGroupOfTriangle,
                         std::move(tags)};
  mesh.validate();
  return mesh;
}

void PrescribedDisplacement::addFixed(const Support& support, const Vector3d& position) {
  if (fixed_ && displaceDifferently(*fixed_, support))
    throw SupportConflictError({fixed_->name, support.name, position, false});
  fixed_ = &support;
}

void PrescribedDisplacement::addRoller(const Support& support, const Vector3d& normal) {
  rows_.emplace_back(normal, normal.dot(support.displacement));
}

Vector3d PrescribedDisplacement::value() const {
  if (fixed_) return fixed_->displacement;
  Eigen::MatrixXd normals(rows_.size(), 3);
  Eigen::VectorXd components(rows_.size());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    normals.row(static_cast<Eigen::Index>(k)) = rows_[k].first.transpose();
    components[static_cast<Eigen::Index>(k)] = rows_[k].second;
  }
  return normals.completeOrthogonalDecomposition().solve(components);
}

LoadTraction loadTraction(const modeling::Load& load) {
  constexpr double kSmooth = std::numeric_limits<double>::infinity();
  if (const auto* pressure = std::get_if<modeling::Pressure>(&load.what))
    return {
        [p = pressure->pressure](const Vector3d&, const Vector3d& n) { return Vector3d(-p * n); },
        kSmooth};
  if (const auto* uniform = std::get_if<modeling::UniformTraction>(&load.what))
    return {[t = uniform->traction](const Vector3d&, const Vector3d&) { return t; }, kSmooth};
  const auto bump = std::get<modeling::Bump>(load.what);
  return {[bump](const Vector3d& x, const Vector3d&) {
            const double s = (x - bump.center).squaredNorm() / (bump.radius * bump.radius);
            return s < 1 ? Vector3d(bump.direction * bump.peak * (1 - s) * (1 - s))
                         : Vector3d(Vector3d::Zero());
          },
          bump.radius};
}

}  // namespace palpa::app
