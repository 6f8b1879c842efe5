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

// Most bodies of these tests are bodies of the verification.
using namespace verification;

/// Discretisation of a solid whose elements have the tags that `tagOf` returns for their centres,
/// with a mesh of the given edge length, mm. Tags should change at borders of patches only:
/// triangles take the tag of the element under their centroid.
std::unique_ptr<SplineDiscretisation> discretised(
    const modeling::Solid& solid, double edgeLength,
    const std::function<int(const Eigen::Vector3d&)>& tagOf);

/// Fixed where the tag is 1.
std::vector<SlotCondition> fixedWhereTagged(const TractionSlots& slots);

}  // namespace palpa::bem::test
