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
  bool quadratic = true;  ///< quadratic triangles: finite element cases
  /// Names of cases, or of families of cases ("kelvin_exterior_sphere"); none: all.
  std::vector<std::string> names;
  /// A few cases, one material each, some on coarser meshes. With names: the short form of these.
  bool isQuick = false;
};

/// One case for one engine.
struct Task {
  std::string name;
  std::string engine;  ///< as Result::engine
  /// Throws ModelingError if the reference data are malformed; SolverError, Cancelled.
  std::function<Result(const Job&)> run;
};

struct Omitted {
  std::string name, reason;
};

struct Plan {
  std::vector<Task> tasks;       ///< with their copies of the reference data
  std::vector<Omitted> omitted;  ///< selected cases, some for one engine only
};

/// Tasks of a selection: cases in the order of the files, each with triangles first, then the
/// series of refinements. Throws ModelingError if a name is unknown (the message lists the known
/// names) or a file has cases of unknown families.
Plan makePlan(const ReferenceData& reference, const Selection& selection);

/// Names of families and cases that a selection may have, without the materials of each family.
std::vector<std::string> knownNames(const ReferenceData& reference);

}  // namespace palpa::verification
