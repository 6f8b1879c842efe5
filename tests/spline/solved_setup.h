#pragma once

#include "app/core/setup/spline_setup.h"
#include "bem/problem/reference_problem.h"
#include "bem/spline/spline_discretisation.h"

/// Projects as spline problems, without the cache and the triangles of a model.
namespace palpa::app::test {

BoundarySetup setupOf(const modeling::Project& project, const SplineRefinement& net);
/// With the net of the project for fingertips of 6 mm.
BoundarySetup setupOf(const modeling::Project& project);

/// A setup and its solution without contacts.
struct SolvedSetup {
  BoundarySetup setup;
  bem::ReferenceProblemTimes times;
  bem::BoundaryField field;

  explicit SolvedSetup(BoundarySetup made);
  explicit SolvedSetup(const modeling::Project& project) : SolvedSetup(setupOf(project)) {}

  const bem::SplineSurface& surface() const { return setup.splines->surface(); }

  Eigen::Vector3d u(const bem::ElementPlace& place) const;  ///< mm
  Eigen::Vector3d p(const bem::ElementPlace& place) const;  ///< MPa
  Eigen::Vector3d reaction(int support) const;              ///< N
};

/// Box 40 x 30 x 20 mm without supports, nu = 0.3.
modeling::Project boxOfSplines();

}  // namespace palpa::app::test
