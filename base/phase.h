#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace palpa {

/// Phases of long operations, as Job::progress reports them.
enum class Phase {
  kImport,
  kRead,
  kSew,
  kRepair,
  kTriangulate,
  kExport,
  kMesh,
  kCheck,
  kSetup,
  kAssemble,
  kFactorise,
  kSolve,
  kUpdate,
  kGreensFunction,
  kStiffness,
  kTouch,
  kReplay,
  kErrorEstimate,
  kSearch,
};

/// The phase's name in output for users: "assemble".
constexpr std::string_view nameOf(Phase phase) {
  constexpr std::array<std::string_view, 19> kNames{"import",      "read",
                                                    "sew",         "repair",
                                                    "triangulate", "export",
                                                    "mesh",        "check",
                                                    "setup",       "assemble",
                                                    "factorise",   "solve",
                                                    "update",      "Green's function",
                                                    "stiffness",   "touch",
                                                    "replay",      "estimate errors",
                                                    "find a shape"};
  static_assert(kNames.size() == static_cast<std::size_t>(Phase::kSearch) + 1);
  return kNames[static_cast<std::size_t>(phase)];
}

}  // namespace palpa
