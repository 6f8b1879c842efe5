#include "app/core/results/body_section.h"

#include <Eigen/Geometry>
#include <utility>

#include "bem/triangle/results.h"

namespace palpa::app {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double diagonalOf(const std::vector<Vector3d>& positions) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& x : positions) box.extend(x);
  return box.diagonal().norm();
}

}  // namespace

BodySection::BodySection(std::shared_ptr<const DrawnBody> body, const modeling::Plane& plane,
                         const Job& job, double coarseness)
    : body_(std::move(body)), plane_(plane) {
  const modeling::DisplayMesh& drawn = body_->mesh();
  mesh_ = modeling::planeSection(drawn.positions, drawn.triangles, plane,
                                 coarseness * kEdge * diagonalOf(drawn.positions), job);
  distances_.reserve(drawn.positions.size());
  for (const Vector3d& x : drawn.positions) distances_.push_back(plane.distance(x));
}

BodySection::Shape BodySection::deformed(const std::vector<Vector3d>& displacements,
                                         double scale) const {
  Shape shape;
  shape.positions.reserve(mesh_.positions.size());
  for (std::size_t k = 0; k < mesh_.positions.size(); ++k)
    shape.positions.push_back(mesh_.positions[k] + scale * displacements[k]);
  shape.normals.assign(mesh_.positions.size(), Vector3d::Zero());
  for (const auto& triangle : mesh_.triangles) {
    const auto at = [&](std::size_t k) { return static_cast<std::size_t>(triangle[k]); };
    const Vector3d area = (shape.positions[at(1)] - shape.positions[at(0)])
                              .cross(shape.positions[at(2)] - shape.positions[at(0)]);
    for (std::size_t k = 0; k < 3; ++k) shape.normals[at(k)] += area;
  }
  for (Vector3d& normal : shape.normals) {
    const double size = normal.norm();
    normal = size > 0 ? Vector3d(normal / size) : plane_.normal;
  }
  return shape;
}

std::vector<Vector3d> BodySection::interiorPoints() const {
  return {mesh_.positions.begin() + static_cast<std::ptrdiff_t>(mesh_.outline.size()),
          mesh_.positions.end()};
}

SectionField::SectionField(std::shared_ptr<const BodySection> section, const Job& job)
    : section_(std::move(section)) {
  const BoundarySetup& setup = section_->body().model().setup();
  inside_ =
      setup.discretisation->makeInteriorEvaluator(section_->interiorPoints(), setup.bulk(), job);
}

std::vector<bem::InteriorState> SectionField::states(const bem::BoundaryField& field,
                                                     const Job& job) const {
  const DrawnBody& body = section_->body();
  const std::vector<Vector3d> moved = section_->onOutline(body.displacements(field.u.col(0)));
  const std::vector<Matrix3d> stress = section_->onOutline(body.stresses(field));
  std::vector<bem::InteriorState> states;
  states.reserve(section_->mesh().positions.size());
  for (std::size_t k = 0; k < moved.size(); ++k) states.push_back({moved[k], stress[k]});
  const std::vector<bem::InteriorState> inside =
      inside_->evaluate(field.u.col(0), field.p.col(0), job);
  states.insert(states.end(), inside.begin(), inside.end());
  return states;
}

double sectionValue(SurfaceQuantity quantity, const bem::InteriorState& state,
                    const modeling::Plane& plane) {
  switch (quantity) {
    case SurfaceQuantity::kDisplacement:
      return state.displacement.norm();
    case SurfaceQuantity::kNormalTraction:
      return plane.normal.dot(state.stress * plane.normal);
    case SurfaceQuantity::kVonMises:
      return bem::vonMises(state.stress);
    case SurfaceQuantity::kNone:
    case SurfaceQuantity::kStiffness:
    case SurfaceQuantity::kStiffnessGradient:
      break;
  }
  return 0;
}

}  // namespace palpa::app
