#pragma once

#include <string>
#include <vector>

#include "app/core/results/touch_study.h"

// Sections of a report, as HTML without pictures. Internal to app/report.
namespace palpa::report {

/// The touches, one row each: given motion or force, force with its error, stiffness, motion,
/// largest displacement of the body, estimated error. If there are several, alone and together.
std::string touchTables(const app::TouchStudy& study);

/// Body, material with its source, supports, loads, engine and mesh.
std::string modelTables(const app::TouchStudy& study);

/// All numbers of one state: contacts, supports, loads, balance, energy.
std::string stateTable(const app::TouchModel& model, const app::TouchState& state);

/// Findings about this study: from `notes`, the build, the geometry check, and where displacements
/// or errors are large. Empty list: nothing to note.
std::vector<std::string> notices(const app::TouchStudy& study,
                                 const std::vector<std::string>& notes);

/// Assumptions of the linear model, one sentence or two each. `share`: the largest
/// displacement over the diagonal of the body.
std::vector<std::string> assumptions(double share);

/// Of the states of a study.
double largestShare(const app::TouchStudy& study);

/// Source of the constants of a material, if the library has the same one.
std::string materialSource(const modeling::Material& material);

/// "pressed 2 mm", "pulled with 0.36 N", …: what a touch prescribes.
std::string givenText(const modeling::Touch& touch);

}  // namespace palpa::report
