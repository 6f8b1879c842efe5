#pragma once

#include "app/verification/analytic_case.h"
#include "base/job.h"

namespace palpa::verification {

/// Errors of a solution with splines.
struct SplineErrors {
  int coefficients;  ///< control points of the displacement
  double points;     ///< as TriangleErrors::points
};

/// True if there is a solid of the case's shape; hollow ones are missing.
bool hasSolid(const AnalyticCase& body);

/// Solves a case with about 400 control points. Independently of the conditions of the case, the
/// exact displacement is prescribed on a part of the surface and the exact tractions on the rest;
/// integrals are exact to 1e-5. Throws as AnalyticCase, and SolverError, Cancelled.
SplineErrors solveWithSplines(const AnalyticCase& body, const Job& job);

}  // namespace palpa::verification
