#include "app/core/boundary_setup.h"

#include <cstdio>
#include <limits>
#include <map>
#include <numeric>

#include "bem/error.h"
#include "bem/triangle_discretisation.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Support;

std::string formatPoint(const Vector3d& p) {
  char text[80];
  std::snprintf(text, sizeof text, "(%.4g, %.4g, %.4g) mm", p[0], p[1], p[2]);
  return text;
}

[[noreturn]] void badCondition(const std::string& message) {
  throw bem::SolverError(bem::SolverError::Kind::kBadCondition, message);
}

/// Which support holds each triangle; -1 for none.
std::vector<int> supportOfTriangle(const modeling::Project& project,
                                   const modeling::SurfaceMesh& surface) {
  std::vector<int> owner(surface.triangles.size(), -1);
  for (std::size_t s = 0; s < project.supports.size(); ++s)
    for (const int t : surface.trianglesOfRegion[s]) {
      if (owner[t] >= 0) {
        const auto& c = surface.triangles[t];
        badCondition("supports \"" + project.supports[owner[t]].name + "\" and \"" +
                     project.supports[s].name + "\" both hold the surface near " +
                     formatPoint(surface.positions[c[0]]) +
                     "; change their regions so that they do not overlap");
      }
      owner[t] = static_cast<int>(s);
    }
  return owner;
}

/// One tag per combination of support and load regions that occurs.
std::vector<int> tagTriangles(const modeling::SurfaceMesh& surface) {
  std::vector<std::vector<int>> regions(surface.triangles.size());
  for (std::size_t r = 0; r < surface.trianglesOfRegion.size(); ++r)
    for (const int t : surface.trianglesOfRegion[r]) regions[t].push_back(static_cast<int>(r));
  std::map<std::vector<int>, int> tagOf{{{}, 0}};
  std::vector<int> tags;
  for (const auto& combination : regions)
    tags.push_back(tagOf.try_emplace(combination, static_cast<int>(tagOf.size())).first->second);
  return tags;
}

bem::BoundaryMesh boundaryMesh(const modeling::SurfaceMesh& surface) {
  bem::BoundaryMesh mesh{surface.positions, surface.triangles, surface.smoothingGroupOfTriangle,
                         tagTriangles(surface)};
  mesh.validate();
  return mesh;
}

/// The displacement that the supports meeting at a node prescribe: that of a fixed one, otherwise
/// the shortest vector with all the rollers' normal components.
class PrescribedDisplacement {
 public:
  void addFixed(const Support& support, const Vector3d& position) {
    if (fixed_ && (fixed_->displacement - support.displacement).norm() >
                      1e-12 * (1 + support.displacement.norm()))
      badCondition(
          "supports \"" + fixed_->name + "\" and \"" + support.name + "\" meet at " +
          formatPoint(position) +
          " and prescribe different displacements there; separate them or make them agree");
    fixed_ = &support;
  }
  void addRoller(const Support& support, const Vector3d& normal) {
    rows_.emplace_back(normal, normal.dot(support.displacement));
  }
  Vector3d value() const {
    if (fixed_) return fixed_->displacement;
    Eigen::MatrixXd normals(rows_.size(), 3);
    Eigen::VectorXd components(rows_.size());
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      normals.row(static_cast<Eigen::Index>(k)) = rows_[k].first.transpose();
      components[static_cast<Eigen::Index>(k)] = rows_[k].second;
    }
    return normals.completeOrthogonalDecomposition().solve(components);
  }

 private:
  const Support* fixed_ = nullptr;
  std::vector<std::pair<Vector3d, double>> rows_;
};

void applySupports(const modeling::Project& project, const std::vector<int>& owner,
                   BoundarySetup& setup) {
  std::map<int, int> supportOfSlot;
  for (std::size_t t = 0; t < owner.size(); ++t)
    if (owner[t] >= 0)
      for (const int slot : setup.meshSlots().ofCorner[t]) supportOfSlot[slot] = owner[t];
  std::map<int, PrescribedDisplacement> ofNode;
  for (const auto& [slot, index] : supportOfSlot) {
    const Support& support = project.supports[index];
    const auto& place = setup.meshSlots().slots[slot];
    if (support.kind == Support::Kind::fixed) {
      setup.conditions.ofSlot[slot] = bem::SlotCondition::kFixed;
      ofNode[place.node].addFixed(support, setup.mesh().nodes[place.node]);
    } else {
      setup.conditions.ofSlot[slot] = bem::SlotCondition::kRoller;
      ofNode[place.node].addRoller(support, place.normal);
    }
  }
  for (const auto& [node, prescribed] : ofNode)
    setup.conditions.displacement.segment<3>(3 * node) = prescribed.value();
}

bem::SurfaceLoad surfaceLoad(const modeling::Load& load, std::vector<int> regionTriangles,
                             int triangleCount) {
  constexpr double kSmooth = std::numeric_limits<double>::infinity();
  if (const auto* pressure = std::get_if<modeling::Pressure>(&load.what))
    return {
        std::move(regionTriangles),
        [p = pressure->pressure](const Vector3d&, const Vector3d& n) { return Vector3d(-p * n); },
        kSmooth};
  if (const auto* uniform = std::get_if<modeling::UniformTraction>(&load.what))
    return {std::move(regionTriangles),
            [t = uniform->traction](const Vector3d&, const Vector3d&) { return t; }, kSmooth};
  const auto bump = std::get<modeling::Bump>(load.what);
  std::vector<int> all(triangleCount);
  std::iota(all.begin(), all.end(), 0);
  return {std::move(all),
          [bump](const Vector3d& x, const Vector3d&) {
            const double s = (x - bump.center).squaredNorm() / (bump.radius * bump.radius);
            return s < 1 ? Vector3d(bump.direction * bump.peak * (1 - s) * (1 - s))
                         : Vector3d(Vector3d::Zero());
          },
          bump.radius};
}

/// Mean place of coefficients of traction, weighted by their size.
Vector3d meanPlace(const bem::Discretisation& on, const Eigen::VectorXd& traction) {
  Vector3d sum = Vector3d::Zero();
  double weights = 0;
  for (int slot = 0; slot < on.slots().count(); ++slot) {
    const double weight = traction.segment<3>(3 * slot).norm();
    sum += weight * on.places()[on.slots().slots[slot].node];
    weights += weight;
  }
  return weights > 0 ? Vector3d(sum / weights) : sum;
}

void applyLoads(const modeling::Project& project, const modeling::SurfaceMesh& surface,
                BoundarySetup& setup) {
  std::vector<int> all(setup.mesh().triangles.size());
  std::iota(all.begin(), all.end(), 0);
  std::size_t region = project.supports.size();
  for (const modeling::Load& load : project.loads) {
    std::vector<int> triangles;
    if (modeling::regionOf(load)) triangles = surface.trianglesOfRegion[region++];
    BoundarySetup::LoadPart part{load.name, {}, {}, Vector3d::Zero()};
    part.traction =
        bem::projectTraction(setup.mesh(), setup.meshSlots(),
                             surfaceLoad(load, std::move(triangles), setup.mesh().triangleCount()));
    part.resultant = setup.discretisation->resultant(part.traction, all);
    part.place = meanPlace(*setup.discretisation, part.traction);
    setup.conditions.traction += part.traction;
    setup.loads.push_back(std::move(part));
  }
}

}  // namespace

BoundarySetup makeBoundarySetup(const modeling::Project& project,
                                const modeling::SurfaceMesh& surface) {
  auto discretisation = std::make_shared<bem::TriangleDiscretisation>(boundaryMesh(surface));
  bem::BoundaryConditions conditions(discretisation->displacementCount(),
                                     discretisation->slots().count());
  BoundarySetup setup{std::move(discretisation),
                      nullptr,
                      nullptr,
                      {project.material.youngsModulus, project.material.poissonRatio},
                      std::move(conditions),
                      {},
                      {}};
  for (std::size_t s = 0; s < project.supports.size(); ++s)
    setup.supports.push_back({project.supports[s].name, surface.trianglesOfRegion[s],
                              surface.trianglesOfRegion[s],
                              project.supports[s].kind == Support::Kind::fixed});
  applySupports(project, supportOfTriangle(project, surface), setup);
  applyLoads(project, surface, setup);
  return setup;
}

}  // namespace palpa::app
