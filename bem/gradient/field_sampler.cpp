#include "bem/gradient/field_sampler.h"

#include <algorithm>

#include "base/parallel.h"
#include "bem/model/surface_gradient.h"
#include "bem/triangle/results.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::MatrixX3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

void gatherRows(const VectorXd& from, const std::vector<int>& list, MatrixX3d& rows) {
  rows.resize(static_cast<Index>(list.size()), 3);
  for (std::size_t k = 0; k < list.size(); ++k)
    rows.row(static_cast<Index>(k)) = from.segment<3>(3 * static_cast<Index>(list[k])).transpose();
}

}  // namespace

void FieldSampler::add(Block block) {
  blocks_.push_back({pointCount(), static_cast<int>(block.points.size()),
                     std::move(block.coefficients), std::move(block.slots),
                     std::move(block.displacement), std::move(block.traction)});
  points_.insert(points_.end(), block.points.begin(), block.points.end());
}

double FieldSampler::area() const {
  double sum = 0;
  for (const SampledPoint& point : points_) sum += point.weight;
  return sum;
}

std::vector<SampledState> FieldSampler::evaluate(const VectorXd& u, const VectorXd& p,
                                                 const Material& material, const Job& job) const {
  std::vector<SampledState> states(points_.size());
  const auto evaluateBlock = [&](const Functions& block) {
    MatrixX3d coefficients, slots;
    gatherRows(u, block.coefficients, coefficients);
    gatherRows(p, block.slots, slots);
    const MatrixX3d values = block.displacement * coefficients, tractions = block.traction * slots;
    for (int k = 0; k < block.count; ++k) {
      SampledState& state = states[block.first + k];
      const Eigen::Matrix3d& frame = points_[block.first + k].frame;
      state.displacement = values.row(3 * k).transpose();
      state.traction = tractions.row(k).transpose();
      const Eigen::Matrix<double, 3, 2> along = values.middleRows<2>(3 * k + 1).transpose();
      state.gradient = surfaceGradient(frame, along, state.traction, material);
      state.stress = surfaceStress(frame, along, state.traction, material);
    }
  };
  const std::size_t perTask = 64;
  parallelFor(static_cast<std::ptrdiff_t>((blocks_.size() + perTask - 1) / perTask), job,
              [&](std::ptrdiff_t task) {
                const std::size_t first = static_cast<std::size_t>(task) * perTask;
                for (std::size_t k = first; k < std::min(first + perTask, blocks_.size()); ++k)
                  evaluateBlock(blocks_[k]);
              });
  return states;
}

VectorXd FieldSampler::tractionValues(std::span<const int> slots, std::span<const double> values,
                                      int slotCount) const {
  VectorXd all = VectorXd::Zero(slotCount);
  for (std::size_t k = 0; k < slots.size(); ++k) all[slots[k]] = values[k];
  VectorXd result = VectorXd::Zero(pointCount());
  for (const Functions& block : blocks_) {
    const VectorXd own = all(block.slots);
    if (!own.isZero(0)) result.segment(block.first, block.count) = block.traction * own;
  }
  return result;
}

}  // namespace palpa::bem
