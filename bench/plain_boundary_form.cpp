#include "bench/plain_boundary_form.h"

#include <algorithm>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "bem/model/surface_gradient.h"
#include "bem/triangle/results.h"
#include "bench/timing.h"
#include "modeling/editing/nearest_on_patches.h"

namespace palpa::bench {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixX3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// A field at a point.
struct SampledState {
  Vector3d displacement;     ///< mm
  Vector3d traction;         ///< MPa
  Eigen::Matrix3d gradient;  ///< of the displacement; column j: derivative along axis j
  Eigen::Matrix3d stress;    ///< Cauchy, MPa
};
using States = std::vector<SampledState>;

void gatherRows(const VectorXd& from, const std::vector<int>& list, MatrixX3d& rows) {
  rows.resize(static_cast<Index>(list.size()), 3);
  for (std::size_t k = 0; k < list.size(); ++k)
    rows.row(static_cast<Index>(k)) = from.segment<3>(3 * static_cast<Index>(list[k])).transpose();
}

States statesOf(const bem::FieldSampler& sampler, const bem::BoundaryField& field,
                const bem::Material& material, const Job& job) {
  const VectorXd u = field.u.col(0), p = field.p.col(0);
  States states(sampler.points().size());
  const auto evaluateBlock = [&](const bem::FieldSampler::Functions& block) {
    MatrixX3d coefficients, slots;
    gatherRows(u, block.coefficients, coefficients);
    gatherRows(p, block.slots, slots);
    const MatrixX3d values = block.displacement * coefficients, tractions = block.traction * slots;
    for (int k = 0; k < block.count; ++k) {
      SampledState& state = states[static_cast<std::size_t>(block.first + k)];
      const Eigen::Matrix3d& frame =
          sampler.points()[static_cast<std::size_t>(block.first + k)].frame;
      state.displacement = values.row(3 * k).transpose();
      state.traction = tractions.row(k).transpose();
      const Eigen::Matrix<double, 3, 2> along = values.middleRows<2>(3 * k + 1).transpose();
      state.gradient = bem::surfaceGradient(frame, along, state.traction, material);
      state.stress = bem::surfaceStress(frame, along, state.traction, material);
    }
  };
  const auto& blocks = sampler.blocks();
  const std::size_t perTask = 64;
  parallelFor(static_cast<std::ptrdiff_t>((blocks.size() + perTask - 1) / perTask), job,
              [&](std::ptrdiff_t task) {
                const std::size_t first = static_cast<std::size_t>(task) * perTask;
                for (std::size_t k = first; k < std::min(first + perTask, blocks.size()); ++k)
                  evaluateBlock(blocks[k]);
              });
  return states;
}

/// Values at all points of a scalar traction field that is given by a few slots.
VectorXd tractionValues(const bem::FieldSampler& sampler, const bem::MaskTraction& traction,
                        int slotCount) {
  VectorXd all = VectorXd::Zero(slotCount);
  for (std::size_t k = 0; k < traction.slots.size(); ++k)
    all[traction.slots[k]] = traction.values[k];
  VectorXd result = VectorXd::Zero(sampler.pointCount());
  for (const bem::FieldSampler::Functions& block : sampler.blocks())
    result.segment(block.first, block.count) = block.traction * all(block.slots);
  return result;
}

void addEnergyDensity(const bem::FieldSampler& sampler, const States& a, const States& b,
                      bem::ShapeDensity& density) {
  for (int q = 0; q < sampler.pointCount(); ++q) {
    const std::size_t k = static_cast<std::size_t>(q);
    const bem::SampledPoint& point = sampler.points()[k];
    // The stress is symmetric, so that σ:ε = σ:∇u.
    const double energy = a[k].stress.cwiseProduct(b[k].gradient).sum();
    density.value.col(q) +=
        point.weight * (energy * point.frame.col(2) - a[k].gradient.transpose() * b[k].traction -
                        b[k].gradient.transpose() * a[k].traction);
  }
}

/// Adds the part of a mask, see bem::BoundaryForm::addMask().
Vector3d addMaskDensity(const bem::FieldSampler& sampler, const bem::ContactMask& mask,
                        const VectorXd& support, const Vector3d& force, const States& states,
                        double factor, bem::ShapeDensity& density) {
  const double inverse = 1 / (mask.radius * mask.radius);
  const Vector3d& centre = mask.point.position;
  const auto& points = sampler.points();
  const auto height = [&](std::size_t q) {
    if (support[static_cast<Index>(q)] == 0) return 0.0;
    return std::max(0.0, 1 - (points[q].position - centre).squaredNorm() * inverse);
  };
  double total = 0, mean = 0;
  for (std::size_t q = 0; q < points.size(); ++q)
    if (const double h = height(q); h > 0) {
      total += points[q].weight * h * h;
      mean += points[q].weight * h * h * force.dot(states[q].displacement);
    }
  mean /= total;
  Vector3d ofCentre = Vector3d::Zero();
  for (std::size_t q = 0; q < points.size(); ++q) {
    const double h = height(q);
    if (h <= 0) continue;
    const bem::SampledPoint& point = points[q];
    const double work = factor * point.weight / total * (force.dot(states[q].displacement) - mean);
    const Vector3d pull = -4 * h * inverse * work * (point.position - centre);
    density.value.col(static_cast<Index>(q)) += pull;
    ofCentre -= pull;
    density.slope.middleCols<2>(2 * static_cast<Index>(q)) +=
        work * h * h * point.frame.leftCols<2>();
  }
  return ofCentre;
}

Matrix3Xd addMasks(const app::DesignSurface& surface, const app::TouchModel& model,
                   const app::ContactStiffness& stiffness, const States& ofLoad,
                   const States& ofAdjoint, bem::ShapeDensity& density) {
  const modeling::Solid& solid = surface.basis.solid();
  const std::vector<int>& firstSlot = model.setup().discretisation->slots().firstOfNode;
  modeling::NearestOnPatches nearest(solid);
  Matrix3Xd ofCentres = Matrix3Xd::Zero(3, static_cast<Index>(solid.controlPoints().size()));
  for (std::size_t m = 0; m < stiffness.masks.size(); ++m) {
    const bem::ContactMask& mask = stiffness.masks[m];
    const VectorXd support =
        tractionValues(surface.sampler, bem::maskTraction(mask, firstSlot), firstSlot.back());
    const Vector3d load = stiffness.loadForces.col(static_cast<Index>(m)),
                   adjoint = stiffness.adjointForces.col(static_cast<Index>(m));
    Vector3d ofCentre = Vector3d::Zero();
    if (!load.isZero(0))
      ofCentre += addMaskDensity(surface.sampler, mask, support, load, ofAdjoint, -1, density);
    if (!adjoint.isZero(0))
      ofCentre += addMaskDensity(surface.sampler, mask, support, adjoint, ofLoad, -1, density);
    for (const auto& [point, weight] : nearest.of(mask.point.position))
      ofCentres.col(point) += weight * ofCentre;
  }
  return ofCentres;
}

}  // namespace

Matrix3Xd plainBoundaryForm(const app::DesignSurface& surface, const app::TouchModel& model,
                            const app::ContactStiffness& stiffness, const Job& job,
                            PlainBoundaryTimes* times) {
  PlainBoundaryTimes spent;
  States load, adjoint;
  bem::ShapeDensity density(surface.sampler.pointCount());
  Matrix3Xd ofCentres, result;
  spent.states = processorSecondsFor([&] {
    load = statesOf(surface.sampler, stiffness.load, model.setup().material, job);
    adjoint = statesOf(surface.sampler, stiffness.adjoint, model.setup().material, job);
  });
  spent.density =
      processorSecondsFor([&] { addEnergyDensity(surface.sampler, load, adjoint, density); });
  spent.masks = processorSecondsFor(
      [&] { ofCentres = addMasks(surface, model, stiffness, load, adjoint, density); });
  spent.sum = processorSecondsFor([&] { result = surface.basis.gradient(density) + ofCentres; });
  if (times) *times = spent;
  return result;
}

}  // namespace palpa::bench
