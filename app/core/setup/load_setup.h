#pragma once

#include <functional>

#include "app/core/setup/boundary_setup.h"
#include "app/core/setup/region_conditions.h"

namespace palpa::app {

/// Coefficients (3 per slot, MPa) of a traction on the region of a load, in the engine of a setup.
using TractionProjection = std::function<Eigen::VectorXd(const LoadTraction&)>;

/// Adds the load with this index to the setup. The tractions of total forces and moments are scaled
/// so that the projected tractions have exactly the given resultant:
///   force F (N):      t = F / A, with the area A of the region;
///   moment M (N mm):  t = w × (x - c), with the region's centroid c and w from
///                     M = ∫ (x - c) × t dΓ.
/// The traction of a moment has no net force; it bends a bar by a linear stress and twists it by
/// tractions proportional to the radius.
/// Throws SolverError (kBadCondition) if the region has no area or is too narrow for a moment,
/// ModelingError for gravity without a density.
void addLoad(const modeling::Project& project, std::size_t index, BoundarySetup& setup,
             const TractionProjection& onRegion);

}  // namespace palpa::app
