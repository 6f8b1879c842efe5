#include "app/core/design/stiffness_gradient.h"

#include <algorithm>

#include "bem/base/error.h"
#include "bem/dense/transposed_solution.h"
#include "bem/gradient/flat_mask_derivative.h"
#include "bem/gradient/moving_elements.h"
#include "modeling/editing/nearest_on_patches.h"

namespace palpa::app {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

/// Tolerance of the integrals; with 1e-6 gradients of the examples change by less than 1e-4.
constexpr double kTolerance = 1e-4;
/// How far from the border of a half space points of splines slide, over the size of the body.
constexpr double kSlideWidth = 0.15;

/// As gradientObstacle(), of the supports alone.
std::string supportObstacle(const modeling::Project& project) {
  for (const modeling::Support& support : project.supports) {
    const bool isPlain =
        support.where.except.empty() &&
        std::none_of(support.where.parts.begin(), support.where.parts.end(), [](const auto& part) {
          return std::holds_alternative<modeling::Stroke>(part);
        });
    if (support.kind != modeling::Support::Kind::kFixed || !isPlain)
      return "support \"" + support.name +
             "\": gradients know fixed patches and half spaces only; replace rollers, strokes and "
             "exceptions";
  }
  return {};
}

void checkSupports(const modeling::Project& project) {
  const std::string obstacle = supportObstacle(project);
  if (!obstacle.empty()) throw bem::SolverError(bem::SolverError::Kind::kBadCondition, obstacle);
}

std::vector<modeling::SurfaceParameter> placesOf(const bem::ResidualShape& shape,
                                                 const TouchModel& model) {
  if (!shape.splines()) return model.surface().parameters;
  std::vector<modeling::SurfaceParameter> places;
  for (const bem::MovingSplines::Place& place : shape.splines()->places())
    places.push_back({place.patch, place.parameters[0], place.parameters[1]});
  return places;
}

double slideWidth(const bem::ResidualShape& shape, const modeling::Project& project) {
  if (!shape.splines()) return 0;
  const auto [low, high] = modeling::boundingBox(project.body);
  return kSlideWidth * (high - low).norm();
}

}  // namespace

std::string gradientObstacle(const modeling::Project& project) {
  if (!std::holds_alternative<modeling::Solid>(project.body))
    return "a mesh body has no control points that a gradient could move; use a solid of patches";
  return supportObstacle(project);
}

StiffnessGradients::StiffnessGradients(const modeling::Project& project, const TouchModel& model,
                                       const Job& job)
    : model_(model),
      surface_((checkSupports(project), makeDesignSurface(model))),
      contactSurface_(model.setup().discretisation->makeContactSurface(model.problem()->dofs())),
      shape_(bem::makeResidualShape(*model.setup().discretisation, model.problem()->dofs(),
                                    model.setup().material, kTolerance, job)),
      points_(project, surface_.basis.solid(), placesOf(*shape_, model),
              slideWidth(*shape_, project)) {}

StiffnessGradient StiffnessGradients::of(const StiffnessRule& rule, const Job& job) const {
  const ContactStiffness stiffness =
      contactStiffness(*model_.problem(), *contactSurface_, rule, job);
  return {rule.name, stiffness.value, gradient(stiffness, job)};
}

Matrix3Xd StiffnessGradients::ofMasks(const ContactStiffness& stiffness,
                                      const Eigen::VectorXd& lambda) const {
  const Eigen::VectorXd bySlots = bem::transposedTractions(*model_.problem(), lambda);
  const modeling::Solid& solid = surface_.basis.solid();
  const std::vector<int>& firstSlot = model_.setup().discretisation->slots().firstOfNode;
  modeling::NearestOnPatches nearest(solid);
  Matrix3Xd result = Matrix3Xd::Zero(3, static_cast<Index>(solid.controlPoints().size()));
  for (std::size_t m = 0; m < stiffness.masks.size(); ++m) {
    const bem::ContactMask& mask = stiffness.masks[m];
    bem::MaskWork work{Eigen::VectorXd::Zero(static_cast<Index>(mask.nodes.size())),
                       stiffness.adjointForces.col(static_cast<Index>(m))};
    for (std::size_t k = 0; k < mask.nodes.size(); ++k)
      for (int slot = firstSlot[mask.nodes[k]]; slot < firstSlot[mask.nodes[k] + 1]; ++slot)
        work.ofTraction[static_cast<Index>(k)] +=
            stiffness.loadForces.col(static_cast<Index>(m)).dot(bySlots.segment<3>(3 * slot));
    const auto below = makeMaskSurface(model_, *contactSurface_, mask);
    if (!below) {
      result -= points_.byControlPoints(bem::flatMaskDerivative(contactSurface_->mesh(),
                                                                contactSurface_->meshSlots(), mask,
                                                                work, stiffness.load.u.col(0)));
      continue;
    }
    Vector3d ofCentre;
    const bem::ShapeDensity density = bem::maskDerivative(
        below->sampled.blocks, mask, work, below->shares, stiffness.load.u.col(0), ofCentre);
    result -=
        points_.byControlPoints(bem::byMaterialPoints(*below->moving, below->sampled, density));
    for (const auto& [point, weight] : nearest.of(mask.point.position))
      result.col(point) -= weight * ofCentre;
  }
  return result;
}

// D(a, f) = ψ·u_f with the means ψ of the masks, weighted by a. Its derivative is λ·(dG p − dH u)
// with the transposed solution λ for ψ, plus the changes of ψ and of the traction of the load.
Matrix3Xd StiffnessGradients::gradient(const ContactStiffness& stiffness, const Job& job) const {
  const bem::DegreesOfFreedom& dofs = model_.problem()->dofs();
  Eigen::VectorXd psi = Eigen::VectorXd::Zero(dofs.nodalCount());
  for (std::size_t m = 0; m < stiffness.masks.size(); ++m) {
    const bem::ContactMask& mask = stiffness.masks[m];
    for (std::size_t k = 0; k < mask.measureNodes.size(); ++k)
      psi.segment<3>(3 * static_cast<Index>(mask.measureNodes[k])) +=
          mask.measure[k] * stiffness.adjointForces.col(static_cast<Index>(m));
  }
  const Eigen::VectorXd lambda =
      bem::solveTransposed(*model_.problem(), bem::derivativeByUnknowns(dofs, psi));
  const Matrix3Xd byPoints =
      shape_->derivative(lambda, stiffness.load.u.col(0), stiffness.load.p.col(0), job);
  return ofMasks(stiffness, lambda) - points_.byControlPoints(byPoints);
}

Matrix3Xd StiffnessGradients::boundaryForm(const ContactStiffness& stiffness,
                                           const Job& job) const {
  return boundary_.get(surface_, model_).of(stiffness, job);
}

}  // namespace palpa::app
