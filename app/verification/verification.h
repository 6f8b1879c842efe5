#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/verification/check.h"
#include "app/verification/reference_data.h"
#include "base/job.h"

/// The verification of both engines against exact and finite element solutions: what `palpa-cli
/// verify` prints and the tests demand.
namespace palpa::verification {

struct Selection {
  bool triangles = true, splines = true;
  /// Names of cases, or of families of cases ("kelvin_exterior_sphere"); none: all.
  std::vector<std::string> names;
  /// A few cases, one material each, coarser where that is stated. With names: those, but shorter.
  bool isQuick = false;
};

/// One case for one engine.
struct Task {
  std::string name;
  std::string engine;  ///< as Result::engine
  /// Throws ModelingError when the reference data are not as they should be; SolverError,
  /// Cancelled.
  std::function<Result(const Job&)> run;
};

struct Omitted {
  std::string name, reason;
};

struct Plan {
  std::vector<Task> tasks;       ///< with what they need of the reference data
  std::vector<Omitted> omitted;  ///< selected cases, some for one engine alone
};

/// What a selection of cases comes to; cases in the order of the files, each with triangles first,
/// then the series of refinements. Throws ModelingError when a name is not known (the message lists
/// those that are) or a file has cases of unknown families.
Plan makePlan(const ReferenceData& reference, const Selection& selection);

/// Names of families and cases that a selection may have, without the materials of each family.
std::vector<std::string> knownNames(const ReferenceData& reference);

}  // namespace palpa::verification
