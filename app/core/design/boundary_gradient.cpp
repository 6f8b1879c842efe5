#include "app/core/design/boundary_gradient.h"

#include <utility>
#include <vector>

namespace palpa::app {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

std::vector<bem::BoundaryForm::Motion> motionsOf(const DesignSurface& surface) {
  std::vector<bem::BoundaryForm::Motion> motions;
  for (const bem::FieldSampler::Functions& block : surface.sampler.blocks())
    motions.push_back(surface.basis.motion(block.first, block.count));
  return motions;
}

}  // namespace

BoundaryGradient::BoundaryGradient(const DesignSurface& surface, const TouchModel& model)
    : model_(model),
      form_(surface.sampler, motionsOf(surface),
            static_cast<int>(surface.basis.solid().controlPoints().size()), model.setup().material),
      nearest_(surface.basis.solid()) {}

Matrix3Xd BoundaryGradient::of(const ContactStiffness& stiffness, const Job& job) const {
  const std::vector<int>& firstSlot = model_.setup().discretisation->slots().firstOfNode;
  Matrix3Xd result = form_.ofEnergy(stiffness.load, stiffness.adjoint, job);
  modeling::NearestOnPatches nearest = nearest_;
  for (std::size_t m = 0; m < stiffness.masks.size(); ++m) {
    const bem::ContactMask& mask = stiffness.masks[m];
    const bem::MaskTraction traction = bem::maskTraction(mask, firstSlot);
    const Vector3d load = stiffness.loadForces.col(static_cast<Index>(m)),
                   adjoint = stiffness.adjointForces.col(static_cast<Index>(m));
    Vector3d ofCentre = Vector3d::Zero();
    if (!load.isZero(0))
      ofCentre += form_.addMask(mask, traction, load, stiffness.adjoint.u.col(0), -1, result);
    if (!adjoint.isZero(0))
      ofCentre += form_.addMask(mask, traction, adjoint, stiffness.load.u.col(0), -1, result);
    for (const auto& [point, weight] : nearest.of(mask.point.position))
      result.col(point) += weight * ofCentre;
  }
  return result;
}

}  // namespace palpa::app
