#pragma once

#include <Eigen/Dense>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "app/core/live/touchable_model.h"
#include "base/job.h"
#include "bem/contact/contact_compliance.h"
#include "bem/contact/contact_mask.h"

namespace palpa::app {

/// Full solutions of a model for unit forces on masks of one radius.
class PageSolutions {
 public:
  /// Computes all Green's columns. Phase of progress: "Green's function". Throws Cancelled.
  PageSolutions(const TouchableModel& model, double radius, const Job& job);

  /// What a touch meets at a place.
  struct Own {
    Eigen::Matrix3d compliance;  ///< mm/N, symmetric
    Eigen::Vector3d loaded;      ///< displacement without touches, mm
  };
  /// From the Green's columns, tens of microseconds. None if supports hold the whole place.
  std::optional<Own> own(const bem::SurfacePoint& point);
  /// Compliance between the masks at points, 3 x 3 for each pair, mm/N; zero for places held by
  /// supports.
  Eigen::MatrixXd between(std::span<const bem::SurfacePoint> points);
  /// The mask at a point; empty if supports hold the whole place.
  bem::ContactMask mask(const bem::SurfacePoint& point) const;

  /// Calls use(k, u) for each mask k with the displacement coefficients u for unit forces along x,
  /// y, z (three columns, mm; unitFields()). `report`: fraction done. Throws Cancelled.
  void forEach(std::span<const bem::ContactMask> masks,
               const std::function<void(std::size_t k, const Eigen::MatrixXd& u)>& use,
               const std::function<void(double fraction)>& report, const Job& job) const;

 private:
  const TouchableModel& model_;
  double radius_;
  bem::ContactCompliance one_;
};

}  // namespace palpa::app
