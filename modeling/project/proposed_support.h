#pragma once

#include <string>
#include <vector>

#include "modeling/project/project.h"

namespace palpa::modeling {

/// A fixed support for a body that has none.
struct ProposedSupport {
  Support support;  ///< named "base"
  /// Names of the patches or faces that form the flat face; empty: the lowest tenth of the body.
  std::vector<std::string> flatFace;

  /// What it holds, for messages: `the largest flat face, "bottom"`, or `the lowest tenth`.
  std::string description() const;
};

/// The largest flat face of the body, which may consist of several adjacent patches in one plane;
/// of faces whose areas differ by less than a tenth, the one that looks down most, then the lowest
/// one. If no flat face has a fiftieth of the surface: the lowest tenth of the body's height.
/// Deterministic. Cost: below 0.1 s for 100,000 triangles.
ProposedSupport proposeSupport(const Body& body);

/// A fixed support "base" on the lowest tenth of a body.
Support supportOfLowestTenth(const Body& body);

}  // namespace palpa::modeling
