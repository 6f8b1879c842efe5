#pragma once

#include "app/verification/analytic_case.h"
#include "base/job.h"

namespace palpa::verification {

/// Errors of a solution with splines.
struct SplineErrors {
  int coefficients;  ///< control points of the displacement
  double points;     ///< as TriangleErrors::points
};

/// Whether there is a solid of the case's shape; hollow ones are missing.
bool hasSolid(const AnalyticCase& body);

/// Solves a case with about 400 control points. The body is held by the exact displacement on a
/// part of its surface, whatever the case states, and has the exact tractions on the rest;
/// integrals are good to 1e-5. Throws as AnalyticCase, and SolverError, Cancelled.
SplineErrors solveWithSplines(const AnalyticCase& body, const Job& job);

}  // namespace palpa::verification
