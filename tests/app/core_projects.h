#pragma once

#include "modeling/project/project.h"

/// Projects the tests of app/core begin from.
namespace palpa::app::test {

/// Sphere R = 25 mm about the origin, fixed below z = -20 mm.
modeling::Project clampedSphere(double edgeLength, double poissonRatio = 0.45);

/// The same sphere, fixed where it is painted: with a ball about its lowest point that reaches up
/// to z = -20 mm.
modeling::Project paintedSphere(double edgeLength, double poissonRatio = 0.45);

/// Cylinder R = 20 mm, 60 mm high, fixed at its bottom.
modeling::Project clampedCylinder(double edgeLength, double poissonRatio = 0.45);

/// Box 40 x 30 x 20 mm without supports.
modeling::Project freeBox(double edgeLength);

}  // namespace palpa::app::test
