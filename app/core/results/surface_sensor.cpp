#include "app/core/results/surface_sensor.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "app/core/results/field_sample.h"
#include "base/parallel.h"
#include "base/scratch_pool.h"
#include "bem/contact/field_evaluator.h"

namespace palpa::app {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

/// Touches per task of a thread: some 0.1 ms each.
constexpr Index kTask = 8;

struct Scratch {
  bem::FieldEvaluator evaluator;
  bem::BoundaryField field;
};

}  // namespace

SurfaceSensor::SurfaceSensor(std::shared_ptr<const TouchableModel> model,
                             std::span<const Vector3d> places)
    : model_(std::move(model)), normals_(3, static_cast<Index>(places.size())) {
  const bem::ContactSurface& surface = model_->surface();
  for (std::size_t k = 0; k < places.size(); ++k) {
    checkNearSurface(surface.mesh(), places[k], "the place " + std::to_string(k));
    places_.push_back(surface.nearest(places[k]));
    normals_.col(static_cast<Index>(k)) = surface.normal(places_.back());
  }
  weights_ = model_->model().setup().discretisation->displacementWeights(places_);
}

Matrix3Xd SurfaceSensor::displacements(const bem::BoundaryField& field) const {
  const Eigen::Map<const Matrix3Xd> coefficients(field.u.col(0).data(), 3, field.u.rows() / 3);
  return (weights_ * coefficients.transpose()).transpose();
}

Eigen::VectorXd SurfaceSensor::pressures(const bem::BoundaryField& field) const {
  const bem::Discretisation& on = *model_->model().setup().discretisation;
  const Eigen::VectorXd p = field.p.col(0);
  Eigen::VectorXd pressures(normals_.cols());
  for (Index k = 0; k < pressures.size(); ++k)
    pressures[k] =
        0.0 - normals_.col(k).dot(on.tractionAt(places_[static_cast<std::size_t>(k)], p));
  return pressures;
}

template <class Read>
void SurfaceSensor::forEach(const TouchBatch& batch, bool needsTractions, const Job& job,
                            const Read& read) const {
  ScratchPool<std::unique_ptr<Scratch>> pool([this] {
    return std::make_unique<Scratch>(
        Scratch{bem::FieldEvaluator(model_->surface(), *model_->columns(), model_->base()), {}});
  });
  const auto count = static_cast<Index>(batch.size());
  parallelFor((count + kTask - 1) / kTask, job, Phase::kTouch, [&](Index task) {
    std::unique_ptr<Scratch> scratch = pool.take();
    const Index last = std::min(count, (task + 1) * kTask);
    for (Index k = task * kTask; k < last; ++k) {
      scratch->evaluator.evaluate(batch.patches[static_cast<std::size_t>(k)], needsTractions,
                                  scratch->field);
      read(k, scratch->field);
    }
    pool.giveBack(std::move(scratch));
  });
}

Eigen::MatrixXd SurfaceSensor::displacements(const TouchBatch& batch, const Job& job) const {
  Eigen::MatrixXd result(3 * normals_.cols(), static_cast<Index>(batch.size()));
  forEach(batch, false, job, [&](Index touch, const bem::BoundaryField& field) {
    result.col(touch) = displacements(field).reshaped();
  });
  return result;
}

Eigen::MatrixXd SurfaceSensor::pressures(const TouchBatch& batch, const Job& job) const {
  Eigen::MatrixXd result(normals_.cols(), static_cast<Index>(batch.size()));
  forEach(batch, true, job, [&](Index touch, const bem::BoundaryField& field) {
    result.col(touch) = pressures(field);
  });
  return result;
}

}  // namespace palpa::app
