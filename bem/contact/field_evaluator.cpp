#include "bem/contact/field_evaluator.h"

#include <algorithm>
#include <utility>

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Column = Eigen::Map<const Eigen::VectorXf>;
using PatchForce = ContactSimulation::PatchForce;

}  // namespace

FieldEvaluator::FieldEvaluator(const ContactSurface& surface, const GreensColumns& columns,
                               const BoundaryField& base)
    : surface_(surface),
      columns_(columns),
      base_(base),
      workspace_(surface.makeWorkspace()),
      unknowns_(columns.rows()),
      traction_(surface.dofs().nodeCount(), Vector3d::Zero()),
      direct_(surface.dofs().nodeCount(), Vector3d::Zero()),
      isLoaded_(surface.dofs().nodeCount(), 0) {
  const DegreesOfFreedom& dofs = surface.dofs();
  for (int dof = 0; dof < dofs.count(); ++dof) {
    if (dof < dofs.nodalCount() && !dofs.isConstrained(dof)) continue;
    for (const auto& weight : dofs.tractionOf(dof))
      reactions_.push_back({dof, weight.slot, weight.traction});
  }
  for (int node = 0; node < dofs.nodeCount(); ++node)
    if (!dofs.isFree(node)) fixedNodes_.push_back(node);
}

void FieldEvaluator::evaluate(std::span<const PatchForce> patches, bool withTractions,
                              BoundaryField& field) {
  for (Kept& kept : kept_) kept.isUsed = false;
  unknowns_.setZero();
  const std::size_t known = kept_.size();
  for (const PatchForce& patch : patches) {
    if (Kept* kept = find(patch)) {
      // The mask was in the same place before, so it is likely to stay: storing its response pays.
      if (kept->isRough) improve(*kept);
      if (kept->response.rows() == 0) sum(*kept);
      unknowns_.noalias() += kept->response * patch.force.cast<float>();
      addTraction(kept->mask, patch.force);
      kept->isUsed = true;
    } else {
      addMask(patch);
    }
  }
  addNodes();
  expand(withTractions, field);
  for (const int node : loaded_) {
    traction_[node].setZero();
    direct_[node].setZero();
    isLoaded_[node] = 0;
  }
  loaded_.clear();
  for (std::size_t k = known; k < kept_.size(); ++k) kept_[k].isUsed = true;
  std::erase_if(kept_, [](const Kept& kept) { return !kept.isUsed; });
}

int FieldEvaluator::keptCount() const {
  return static_cast<int>(std::count_if(kept_.begin(), kept_.end(),
                                        [](const Kept& kept) { return kept.response.rows() > 0; }));
}

FieldEvaluator::Kept* FieldEvaluator::find(const PatchForce& patch) {
  const auto place = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) {
    return kept.mask.point.triangle == patch.point.triangle && kept.asked == patch.radius &&
           kept.mask.point.position == patch.point.position;
  });
  return place == kept_.end() ? nullptr : &*place;
}

void FieldEvaluator::addMask(const PatchForce& patch) {
  Kept kept;
  kept.asked = patch.radius;
  if (!surface_.makeMask(patch.point, patch.radius, *workspace_, kept.mask)) return;
  if (!columns_.hasAll(kept.mask.nodes)) {
    if (const auto* known = columns_.responses().find(patch.point, patch.radius)) {
      kept.response = known->unknowns;
      kept.isRough = known->isRough;
      unknowns_.noalias() += kept.response * patch.force.cast<float>();
    } else if (columns_.hasAllRough(kept.mask.nodes)) {
      kept.isRough = true;
    } else {
      return;
    }
  }
  addTraction(kept.mask, patch.force);
  if (kept.response.rows() == 0)
    for (std::size_t k = 0; k < kept.mask.nodes.size(); ++k)
      direct_[kept.mask.nodes[k]] += kept.mask.traction[k] * patch.force;
  kept_.push_back(std::move(kept));
}

void FieldEvaluator::sum(Kept& kept) const {
  kept.response.setZero(columns_.rows(), 3);
  for (std::size_t k = 0; k < kept.mask.nodes.size(); ++k)
    for (int axis = 0; axis < 3; ++axis)
      kept.response.col(axis) +=
          static_cast<float>(kept.mask.traction[k] / surface_.dofs().tractionScale()) *
          Column(columns_.column(kept.mask.nodes[k], axis), columns_.rows());
}

void FieldEvaluator::improve(Kept& kept) const {
  const auto* known = columns_.responses().find(kept.mask.point, kept.asked);
  if (columns_.hasAll(kept.mask.nodes))
    kept.response.resize(0, 3);  // sum()
  else if (known && !known->isRough)
    kept.response = known->unknowns;
  else
    return;
  kept.isRough = false;
}

void FieldEvaluator::addTraction(const ContactMask& mask, const Vector3d& force) {
  for (std::size_t k = 0; k < mask.nodes.size(); ++k) {
    const int node = mask.nodes[k];
    traction_[node] += mask.traction[k] * force;
    if (isLoaded_[node] == 0) loaded_.push_back(node);
    isLoaded_[node] = 1;
  }
}

void FieldEvaluator::addNodes() {
  for (const int node : loaded_) {
    if (direct_[node].isZero(0)) continue;
    const Eigen::Vector3f value = (direct_[node] / surface_.dofs().tractionScale()).cast<float>();
    // Three columns at once: the sum is read and written once.
    unknowns_ += value[0] * Column(columns_.column(node, 0), columns_.rows()) +
                 value[1] * Column(columns_.column(node, 1), columns_.rows()) +
                 value[2] * Column(columns_.column(node, 2), columns_.rows());
  }
}

/// Computes DegreesOfFreedom::expand() for one state, with the precomputed reactions.
void FieldEvaluator::expand(bool withTractions, BoundaryField& field) const {
  const DegreesOfFreedom& dofs = surface_.dofs();
  field.u.resize(dofs.nodalCount(), 1);
  field.u.col(0) = base_.u.col(0) + unknowns_.head(dofs.nodalCount()).cast<double>();
  for (const int node : fixedNodes_) {
    Vector3d moved = base_.u.col(0).segment<3>(3 * node);
    for (int k = dofs.constrained(node); k < 3; ++k)
      moved += dofs.frame(node).col(k) * static_cast<double>(unknowns_[3 * node + k]);
    field.u.col(0).segment<3>(3 * node) = moved;
  }
  if (!withTractions) return;
  field.p = base_.p;
  for (const Reaction& reaction : reactions_)
    field.p.col(0).segment<3>(3 * reaction.slot) +=
        reaction.traction * static_cast<double>(unknowns_[reaction.dof]);
  const std::vector<int>& firstSlot = surface_.slots().firstOfNode;
  for (const int node : loaded_)
    for (int slot = firstSlot[node]; slot < firstSlot[node + 1]; ++slot)
      field.p.col(0).segment<3>(3 * slot) += traction_[node];
}

}  // namespace palpa::bem
