#pragma once

#include "app/verification/exact/exact_fields.h"

/// Solutions of textbooks (S. P. Timoshenko, J. N. Goodier: Theory of Elasticity, 3rd ed. 1970).
namespace palpa::verification {

/// Lamé's hollow sphere about `centre` under a pressure (MPa) inside, free outside (section 136).
/// Holds at all places except the centre. inner < outer, mm.
ExactField pressurisedSphereField(double inner, double outer, double pressure,
                                  const bem::Material& material,
                                  const Eigen::Vector3d& centre = Eigen::Vector3d::Zero());

/// Pure bending of a bar along x by couples about y (section 102): the curvature (1/mm) of its axis
/// is positive where the axis bends towards z.
ExactField bendingField(double curvature, const bem::Material& material);

}  // namespace palpa::verification
