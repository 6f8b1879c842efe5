#pragma once

#include <Eigen/Dense>
#include <vector>

#include "app/core/model/touch_model.h"
#include "app/core/results/touch.h"
#include "bem/model/surface_point.h"

// The residual of solved fields at places of the surface. Internal to the error estimates.
namespace palpa::app {

/// Factors from the estimates to errors that cover the true ones of 95 % of random bodies, for the
/// field and at contacts: the residual sees only a part where flat triangles change the body, or
/// splines are cut. Measured by bench/coverage (docs/verification.md) and with finer models of the
/// examples (tests/app).
struct CoverFactors {
  double field, contact;
};
CoverFactors coverFactors(const BoundarySetup& setup);

/// The error of one of several fields: the part that the functions can represent, dominated by the
/// soft modes of slender bodies, and the part that varies within elements.
class SampledError {
 public:
  /// `bulk`: with the body force that the fields contain; `carried`:
  /// bem::Discretisation::estimatedError() of `fields`.
  SampledError(const BoundarySetup& setup, const bem::Bulk& bulk, const bem::BoundaryField& fields,
               const bem::BoundaryField& carried, Eigen::Index column)
      : setup_(setup),
        bulk_(bulk),
        u_(fields.u.col(column)),
        p_(fields.p.col(column)),
        carried_(carried.u.col(column)) {}

  /// Squares of the error and of the displacement, mm^2, at a place or summed over places.
  struct Squares {
    double error = 0, moved = 0, weights = 0;
    void add(const Squares& place, double weight = 1) {
      error += weight * place.error;
      moved += weight * place.moved;
      weights += weight;
    }
    void addSums(const Squares& sums) {
      error += sums.error;
      moved += sums.moved;
      weights += sums.weights;
    }
    /// Over the displacement of the places, or a larger one, mm.
    double relative(double displacement = 0) const {
      const double over = std::max(moved, weights * displacement * displacement);
      return over > 0 ? std::sqrt(error / over) : 0;
    }
  };
  Squares at(const bem::SurfacePoint& place) const;
  /// Error of the displacement, mm.
  Eigen::Vector3d vectorAt(const bem::SurfacePoint& place) const;

 private:
  const BoundarySetup& setup_;
  const bem::Bulk bulk_;
  const Eigen::VectorXd u_, p_, carried_;
};

/// bem::Discretisation::estimatedError() of fields that contain the body force of `bulk`.
bem::BoundaryField carriedError(const TouchModel& model, const bem::Bulk& bulk,
                                const bem::BoundaryField& fields, const Job& job);

/// Error and displacement at places, on the threads of the job.
std::vector<SampledError::Squares> errorsAt(const std::vector<bem::SurfacePoint>& places,
                                            const SampledError& error, const Job& job);

/// Middles of at least `samples` evenly spread triangles of a list, if it has so many: triangles
/// with close numbers are close in space.
std::vector<bem::SurfacePoint> spread(const bem::BoundaryMesh& mesh,
                                      const std::vector<int>& triangles, int samples);

/// Radius of a contact on the surface, mm.
double reachOf(const TouchState::Contact& contact);

/// Relative error of the force of a contact by the errors of displacements at its middle and four
/// places half-way to its border, root mean squares: over the displacement of the contact, or, if
/// that is larger and the compliance C known, the error C^-1 e of the force by the error e of the
/// displacement, over the force or C^-1 d with the displacement d. It is larger for a place that
/// moves in a direction in which it yields easily. 0 for a contact that does not move.
double errorAtContact(const bem::BoundaryMesh& mesh, const SampledError& error,
                      const TouchState::Contact& contact);

}  // namespace palpa::app
