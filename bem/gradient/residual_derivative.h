#pragma once

#include "base/job.h"
#include "bem/element/element_equations.h"
#include "bem/element/element_quadrature.h"
#include "bem/gradient/moving_elements.h"
#include "bem/model/material.h"

namespace palpa::bem {

/// Derivative of λ · (G p − H u) by the material points of a surface, N/mm units of λ times mm per
/// mm: one column per point. H and G are the operators of `equations` (element_assembly.h); u and p
/// are the coefficients of a field, which stay, as do the parameters of all collocation and
/// quadrature points. `lambda`: one number per row of the operators.
///
/// This is the discrete adjoint: where u and p solve the equations and λ is the transposed solution
/// for a linear function of the unknowns, it is the derivative of this function as rebuilds compute
/// it, at any border of a support, because no trace of the field is squared. The kernels are
/// differentiated at the quadrature points of the assembly (kelvin_derivative.h); near a point, y −
/// x and its derivative cancel the higher singularity.
///
/// Cost: two to four times the assembly of the operators. The result does not depend on the number
/// of threads. Throws Cancelled.
Eigen::Matrix3Xd residualDerivative(
    const ElementSurface& surface, const ElementQuadrature& quadrature,
    const MovingElements& motion, const WeightedEquations& equations, const Eigen::VectorXd& lambda,
    const Eigen::VectorXd& u, const Eigen::VectorXd& p, const Material& material, const Job& job);

}  // namespace palpa::bem
