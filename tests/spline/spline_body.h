#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>

#include "app/core/setup/to_spline_surface.h"
#include "app/verification/exact/exact_fields.h"
#include "app/verification/spline_body.h"
#include "bem/problem/reference_problem.h"
#include "bem/spline/spline_discretisation.h"
#include "bem/spline/spline_projection.h"
#include "modeling/shapes/primitives.h"

// Bodies of splines, and what tests of them include.

namespace palpa::bem::test {

// Most bodies of these tests are those of the verification.
using namespace verification;

/// The discretisation of a solid whose elements have the tags that `tagOf` gives for their middles,
/// with a mesh of edges of some length on it, mm. Tags should change at borders of patches only:
/// triangles take that of the element under their middle.
std::unique_ptr<SplineDiscretisation> discretised(
    const modeling::Solid& solid, double edgeLength,
    const std::function<int(const Eigen::Vector3d&)>& tagOf);

/// Held where the tag is 1.
std::vector<SlotCondition> fixedWhereTagged(const TractionSlots& slots);

}  // namespace palpa::bem::test
