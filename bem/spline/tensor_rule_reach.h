#pragma once

namespace palpa::bem {

/// Smallest distance over the radius of a cell at which a tensor Gauss rule of `points` per
/// direction keeps a relative error in the integrals of Kelvin's kernels times functions of a
/// degree. Measured on spheres, cylinders, tori and plates of degree 3
/// (tests/spline/spline_quadrature_test.cpp): the error is at most 12 rho^-2n near the cell, with
/// rho = 0.93 (R + sqrt(R^2 - 1)), and 0.1 3^(3-n) R^(p-2n) at larger distances, where the rule's
/// degree 2n - 1 minus the degree p of the functions is left for the kernel.
double tensorRuleReach(int points, int degree, double error);

}  // namespace palpa::bem
