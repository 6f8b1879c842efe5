#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/core/model/build_touch_model.h"
#include "base/job.h"
#include "modeling/project/project.h"

/// Cases of fem.json: finite element solutions, on which two independent programs agree to 0.03 %
/// of the largest displacement. Functions throw nlohmann::json::exception and ModelingError for a
/// case that does not follow resources/reference/README.md.
namespace palpa::verification {

/// Relative errors of a solution of one of the cases.
struct FemErrors {
  double atLoad = 0;    ///< displacement at the first point, the middle of the load
  double anywhere = 0;  ///< largest at any point, over the largest displacement
  double points = 0;    ///< rms over all points, over the rms of the displacements
  double reaction = 0, energy = 0;

  /// `displacements`: one per point of the case.
  FemErrors(const nlohmann::json& reference, const std::vector<Eigen::Vector3d>& displacements,
            const Eigen::Vector3d& reactionForce, double energyFound);
  FemErrors() = default;
};

/// The case as a project: body, material, supports and load, without mesh settings.
modeling::Project femProject(const nlohmann::json& reference);

struct FemSolution {
  int coefficients = 0;  ///< nodes, or control points of the displacement
  FemErrors errors;
  double balance = 0;  ///< sum of all forces on the body over the largest
};

/// Builds the model of a case and compares displacements, reactions and energy. Throws as
/// app::buildTouchModel().
FemSolution solveFem(const nlohmann::json& reference, const modeling::MeshSettings& mesh,
                     const Job& job);

}  // namespace palpa::verification
