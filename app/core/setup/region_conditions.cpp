#include "app/core/setup/region_conditions.h"

#include <algorithm>
#include <limits>

#include "base/text.h"
#include "bem/base/error.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Support;

[[noreturn]] void badCondition(const std::string& message) {
  throw bem::SolverError(bem::SolverError::Kind::kBadCondition, message);
}

}  // namespace

RegionTags::RegionTags(const modeling::SurfaceMesh& mesh) {
  std::vector<std::vector<int>> regions(mesh.triangles.size());
  for (std::size_t r = 0; r < mesh.trianglesOfRegion.size(); ++r)
    for (const int t : mesh.trianglesOfRegion[r]) regions[t].push_back(static_cast<int>(r));
  for (const auto& combination : regions) ofTriangle_.push_back(tagOf(combination));
}

int RegionTags::tagOf(const std::vector<int>& combination) {
  const auto [found, added] =
      tags_.try_emplace(combination, static_cast<int>(combinations_.size()));
  if (added) combinations_.push_back(combination);
  return found->second;
}

int RegionTags::with(int tag, int region) {
  if (isIn(tag, region)) return tag;
  std::vector<int> combination = combinations_[tag];
  combination.insert(std::upper_bound(combination.begin(), combination.end(), region), region);
  return tagOf(combination);
}

bool RegionTags::isIn(int tag, int region) const {
  return std::binary_search(combinations_[tag].begin(), combinations_[tag].end(), region);
}

bem::BoundaryMesh boundaryMesh(const modeling::SurfaceMesh& surface, std::vector<int> tags) {
  bem::BoundaryMesh mesh{surface.positions, surface.triangles, surface.smoothingGroupOfTriangle,
                         std::move(tags)};
  mesh.validate();
  return mesh;
}

std::vector<int> supportOfTriangle(const modeling::Project& project,
                                   const modeling::SurfaceMesh& surface) {
  std::vector<int> owner(surface.triangles.size(), -1);
  for (std::size_t s = 0; s < project.supports.size(); ++s)
    for (const int t : surface.trianglesOfRegion[s]) {
      if (owner[t] >= 0) {
        const auto& c = surface.triangles[t];
        badCondition("supports \"" + project.supports[owner[t]].name + "\" and \"" +
                     project.supports[s].name + "\" both hold the surface near " +
                     placeText(surface.positions[c[0]]) +
                     "; change their regions so that they do not overlap");
      }
      owner[t] = static_cast<int>(s);
    }
  return owner;
}

void PrescribedDisplacement::addFixed(const Support& support, const Vector3d& position) {
  if (fixed_ && (fixed_->displacement - support.displacement).norm() >
                    1e-12 * (1 + support.displacement.norm()))
    badCondition("supports \"" + fixed_->name + "\" and \"" + support.name + "\" meet at " +
                 placeText(position) +
                 " and prescribe different displacements there; separate them or make them agree");
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
