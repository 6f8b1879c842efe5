#pragma once

#include <cstdint>
#include <string>

#include "modeling/project/project.h"

namespace palpa::bench {

/// A random body with a support, a material, and one touch or load: input of the sweep that
/// compares stated with true errors. No mesh settings.
struct RandomCase {
  std::string shape, support, action;  ///< kinds, for tables
  modeling::Project project;
};

/// The case of a number: the same on every machine. Shapes: sphere, ellipsoid, box, cylinder, cone,
/// capsule, torus, bent and stretched by a random quadratic map, some with a dent or a bump.
/// Supports: a half space in a random direction, a patch, or a painted stroke. Actions: grab,
/// force, ball, bump. Throws ModelingError if the number gives no valid body (one in ten).
RandomCase randomCase(std::uint64_t number);

}  // namespace palpa::bench
