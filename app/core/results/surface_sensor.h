#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "app/core/live/touchable_model.h"
#include "app/core/results/touch_batch.h"

namespace palpa::app {

/// Sensor that reads fields at fixed places of the surface: markers of a tactile skin, or taxels
/// that measure pressure, also below the body, where a support holds it. Const use from several
/// threads is safe.
class SurfaceSensor {
 public:
  /// `model` must outlive this object. `places`: mm; the sensor reads at the nearest points of the
  /// surface. Throws SolverError (kBadCondition) for a place far from the surface.
  SurfaceSensor(std::shared_ptr<const TouchableModel> model,
                std::span<const Eigen::Vector3d> places);

  const std::vector<bem::SurfacePoint>& places() const { return places_; }
  /// Outward unit normals, one column per place.
  const Eigen::Matrix3Xd& normals() const { return normals_; }

  /// One column per place, mm.
  Eigen::Matrix3Xd displacements(const bem::BoundaryField& field) const;
  /// −n · t with the traction t on the surface, MPa: positive where the surface is pressed.
  Eigen::VectorXd pressures(const bem::BoundaryField& field) const;

  /// Displacements of every touch of a batch: 3 places() numbers per column, one column per touch.
  /// Single precision, as the Green's columns. Costs some 0.1 ms per touch for 1,000 coefficients.
  /// Phase of progress: "touch". `batch`: of the same model. Throws Cancelled.
  Eigen::MatrixXd displacements(const TouchBatch& batch, const Job& job = {}) const;
  /// Pressures of every touch of a batch: one number per place and column per touch.
  Eigen::MatrixXd pressures(const TouchBatch& batch, const Job& job = {}) const;

 private:
  template <class Read>
  void forEach(const TouchBatch& batch, bool needsTractions, const Job& job,
               const Read& read) const;

  std::shared_ptr<const TouchableModel> model_;
  std::vector<bem::SurfacePoint> places_;
  Eigen::Matrix3Xd normals_;
  bem::Discretisation::Weights weights_;  // of the displacement coefficients at the places
};

}  // namespace palpa::app
