#pragma once

#include "modeling/shapes/exact_shape.h"
#include "modeling/shapes/shape_parameters.h"

// One function per shape: checks its parameters and describes its surface by exact patches, with
// the bases that will represent them. All throw ModelingError if a parameter is invalid; the
// message begins with the shape's name.
namespace palpa::modeling {

ExactShape describe(const BoxShape& box, const NetSize& net);
ExactShape describe(const SphereShape& sphere, const NetSize& net);
ExactShape describe(const EllipsoidShape& ellipsoid, const NetSize& net);
ExactShape describe(const CylinderShape& cylinder, const NetSize& net);
ExactShape describe(const ConeShape& cone, const NetSize& net);
ExactShape describe(const CapsuleShape& capsule, const NetSize& net);
ExactShape describe(const TorusShape& torus, const NetSize& net);
ExactShape describe(const RevolveShape& revolve, const NetSize& net);
ExactShape describe(const ExtrudeShape& extrude, const NetSize& net);
ExactShape describe(const LoftShape& loft, const NetSize& net);

}  // namespace palpa::modeling
