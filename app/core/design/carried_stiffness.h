#pragma once

#include <vector>

#include "app/core/design/contact_stiffness.h"
#include "modeling/project/project.h"

namespace palpa::app {

/// The project with other control points (mm) of its solid. Throws as
/// modeling::Solid::withControlPoints().
modeling::Project withControlPoints(const modeling::Project& project,
                                    std::vector<Eigen::Vector3d> points);

/// The rule on the moved body: its masks move along with the material.
StiffnessRule carriedRule(const StiffnessRule& rule, const modeling::Solid& from,
                          const modeling::Solid& to);

/// Stiffness of the rule on the moved body, N/mm, from operators that are assembled and factorised
/// from scratch, on the same elements as `model`: with splines the same knots, otherwise the moved
/// mesh. A rebuild of the project may choose other elements, which changes the stiffness by a part
/// of its error. `project`: of `model`. Throws as buildTouchModel() and contactStiffness();
/// SolverError (kBadMesh) if the body must be meshed again.
double movedStiffness(const modeling::Project& project, const TouchModel& model,
                      const StiffnessRule& rule, std::vector<Eigen::Vector3d> points,
                      const Job& job = {});

}  // namespace palpa::app
