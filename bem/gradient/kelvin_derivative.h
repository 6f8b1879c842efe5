#pragma once

#include <numbers>

#include "bem/model/material.h"

namespace palpa::bem {

/// Derivative of the contribution of a surface point y to a row of the boundary integral equation,
/// weighted by λ,
///   s = λ · [ U(r) p α − T(r, A) w ],  r = y − x,
/// with Kelvin's solution U, T (docs/theory.md), the traction p, the area α it acts on, w = u(y) −
/// u(x) and the area vector A. Vectors are any types with three components of `Number`, a scalar or
/// an array of numbers.
///   s_U = c_U α [ k (λ·p) / R + (r·λ)(r·p) / R³ ],  k = 3 − 4 nu
///   s_T = c_T { (r·A) [ h (λ·w) / R³ + 3 (r·λ)(r·w) / R⁵ ] − h [ (r·λ)(A·w) − (r·w)(A·λ) ] / R³ },
/// h = 1 − 2 nu.
template <class Number>
struct KelvinDerivative {
  Number byPoint[3];  ///< ∂s/∂y = −∂s/∂x, with A and α fixed
  Number byArea[3];   ///< ∂s/∂A of the T term
  Number perArea;     ///< ∂s/∂α of the U term
};

class KelvinDerivatives {
 public:
  explicit KelvinDerivatives(const Material& material)
      : ofU_(1 / (16 * std::numbers::pi * material.shear() * (1 - material.poissonRatio))),
        ofT_(-1 / (8 * std::numbers::pi * (1 - material.poissonRatio))),
        diagonalU_(3 - 4 * material.poissonRatio),
        diagonalT_(1 - 2 * material.poissonRatio) {}

  template <class Number, class Root>
  KelvinDerivative<Number> at(const Number (&r)[3], const Number (&lambda)[3], const Number (&w)[3],
                              const double (&p)[3], double alpha, const double (&area)[3],
                              const Root& root) const {
    const Number square = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
    const Number inverse = 1.0 / root(square), inverse2 = inverse * inverse,
                 inverse3 = inverse2 * inverse, inverse5 = inverse3 * inverse2;
    const Number rp = r[0] * p[0] + r[1] * p[1] + r[2] * p[2];
    const Number lp = lambda[0] * p[0] + lambda[1] * p[1] + lambda[2] * p[2];
    const Number a = r[0] * area[0] + r[1] * area[1] + r[2] * area[2];
    const Number b = r[0] * lambda[0] + r[1] * lambda[1] + r[2] * lambda[2];
    const Number c = r[0] * w[0] + r[1] * w[1] + r[2] * w[2];
    const Number m = lambda[0] * w[0] + lambda[1] * w[1] + lambda[2] * w[2];
    const Number aw = area[0] * w[0] + area[1] * w[1] + area[2] * w[2];
    const Number al = area[0] * lambda[0] + area[1] * lambda[1] + area[2] * lambda[2];
    const double h = diagonalT_, u = ofU_ * alpha;

    KelvinDerivative<Number> result;
    result.perArea = ofU_ * (diagonalU_ * lp * inverse + b * rp * inverse3);
    const Number alongU = -u * (diagonalU_ * lp * inverse3 + 3.0 * b * rp * inverse5);
    const Number ofPU = u * b * inverse3, ofLambdaU = u * rp * inverse3;
    const Number bc = b * c, skew = b * aw - c * al;
    const Number ofArea = h * m * inverse3 + 3.0 * bc * inverse5;
    const Number alongT =
        -3.0 * a * inverse5 * (h * m + 5.0 * bc * inverse2) + 3.0 * h * skew * inverse5;
    const Number ofLambda = 3.0 * a * c * inverse5 - h * aw * inverse3;
    const Number ofW = 3.0 * a * b * inverse5 + h * al * inverse3;
    const Number minusB = h * b * inverse3, plusC = h * c * inverse3;
    for (int k = 0; k < 3; ++k) {
      result.byPoint[k] =
          alongU * r[k] + ofPU * p[k] + ofLambdaU * lambda[k] -
          ofT_ * (ofArea * area[k] + alongT * r[k] + ofLambda * lambda[k] + ofW * w[k]);
      result.byArea[k] = -ofT_ * (ofArea * r[k] - minusB * w[k] + plusC * lambda[k]);
    }
    return result;
  }

 private:
  double ofU_, ofT_, diagonalU_, diagonalT_;
};

}  // namespace palpa::bem
