#include "app/core/results/mask_compliance.h"

#include <algorithm>
#include <string>
#include <vector>

#include "app/core/results/field_sample.h"
#include "bem/base/error.h"

namespace palpa::app {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;

/// Places that are solved together: enough for the solver to be efficient, few enough to stop soon.
constexpr std::size_t kBlock = 16;

std::vector<bem::ContactMask> masksAt(const bem::ContactSurface& surface,
                                      std::span<const Eigen::Vector3d> places, double radius) {
  std::vector<bem::ContactMask> masks;
  masks.reserve(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    checkNearSurface(surface.mesh(), places[k], "the place " + std::to_string(k));
    masks.push_back(bem::makeContactMask(surface, places[k], radius));
  }
  return masks;
}

}  // namespace

bem::BoundaryField unitFields(const TouchableModel& model, std::span<const bem::ContactMask> masks,
                              const Job& job) {
  const auto columns = 3 * static_cast<Index>(masks.size());
  bem::BoundaryField known{Eigen::MatrixXd::Zero(model.base().u.rows(), columns),
                           Eigen::MatrixXd::Zero(model.base().p.rows(), columns)};
  const std::vector<int>& firstSlot = model.surface().slots().firstOfNode;
  for (std::size_t m = 0; m < masks.size(); ++m)
    for (std::size_t k = 0; k < masks[m].nodes.size(); ++k)
      for (int slot = firstSlot[masks[m].nodes[k]]; slot < firstSlot[masks[m].nodes[k] + 1]; ++slot)
        known.p.block<3, 3>(3 * slot, 3 * static_cast<Index>(m)) =
            masks[m].traction[k] * Matrix3d::Identity();
  return model.model().problem()->solveField(known, bem::ReferenceProblem::Effort::kRefined, job);
}

Eigen::MatrixXd maskCompliance(const TouchableModel& model, std::span<const Eigen::Vector3d> places,
                               double radius, const Job& job) {
  if (places.size() > kMaxCompliancePlaces)
    throw bem::SolverError(bem::SolverError::Kind::kTooLarge,
                           "there are " + std::to_string(places.size()) +
                               " places; a block of the compliance has at most " +
                               std::to_string(kMaxCompliancePlaces) + "; ask for several blocks");
  const std::vector<bem::ContactMask> masks = masksAt(model.surface(), places, radius);
  Job quiet = job;
  quiet.progress = nullptr;
  const auto size = 3 * static_cast<Index>(masks.size());
  Eigen::MatrixXd compliance(size, size);
  for (std::size_t first = 0; first < masks.size(); first += kBlock) {
    job.throwIfCancelled();
    const std::size_t count = std::min(kBlock, masks.size() - first);
    const bem::BoundaryField field =
        unitFields(model, std::span(masks).subspan(first, count), quiet);
    for (std::size_t k = 0; k < masks.size(); ++k)
      compliance.block(3 * static_cast<Index>(k), 3 * static_cast<Index>(first), 3,
                       3 * static_cast<Index>(count)) = masks[k].displacement(field.u);
    job.report(Phase::kSolve,
               static_cast<double>(first + count) / static_cast<double>(masks.size()));
  }
  return 0.5 * (compliance + compliance.transpose());
}

}  // namespace palpa::app
