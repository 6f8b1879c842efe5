#pragma once

#include <string>

#include "app/core/model/touch_model.h"
#include "modeling/mesh/surface_mesh.h"

// States in words, the same in the output of the command line and in reports.
namespace palpa::report {

/// "612 nodes, 1,220 triangles, smallest angle 30.1°".
std::string meshText(const app::TouchModel& model);

/// "features below 0.5 mm are meshed over; …": what a mesh left out of a body; empty for nothing.
std::string simplificationText(const modeling::MeshSimplification& simplification);

/// "force (0, 0, 1.2) N, |1.20 ± 0.02| N, moment (0, 0, 0) N·mm". `error`: relative, of the force,
/// 0 for a given load; `lever`: mm, of errors of forces in the moment.
std::string resultantText(const bem::Resultant& resultant, double error, double lever);

/// "displacements and forces are good to about 1 % (estimated)", of a state with an estimate.
std::string accuracyText(const app::TouchState& state);

/// "0.0012 N (0.1 % of the largest force)".
std::string balanceText(const app::TouchState& state);

/// "grab", …, "node" for a single one.
const char* kindName(const app::TouchState::Contact& contact);

}  // namespace palpa::report
