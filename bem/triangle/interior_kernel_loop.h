#pragma once

#include <xsimd/xsimd.hpp>

#include "bem/base/inverse_square_root.h"
#include "bem/triangle/interior_kernel.h"

/// Loop of interior_kernel.h, included by one source file per instruction set.
namespace palpa::bem::detail {

/// 1 in the first `count` lanes, 0 in the others.
template <class Batch>
inline Batch lanesBelow(int count) {
  constexpr int kLanes = static_cast<int>(Batch::size);
  alignas(64) double lanes[kLanes];
  for (int lane = 0; lane < kLanes; ++lane) lanes[lane] = lane < count ? 1.0 : 0.0;
  return Batch::load_aligned(lanes);
}

template <class Arch>
void sumInterior(const InteriorSumTask& task) {
  using Batch = xsimd::batch<double, Arch>;
  constexpr int kLanes = static_cast<int>(Batch::size);
  const double nu = task.constants.poissonRatio;
  const LinearState& linear = *task.linear;
  const Batch twist(1 - 2 * nu), diagonal(3 - 4 * nu), three(3.0), five(5.0), ratio(nu),
      last(1 - 4 * nu);
  Batch moved[3], stress[6];
  for (Batch& sum : moved) sum = Batch(0.0);
  for (Batch& sum : stress) sum = Batch(0.0);
  for (int first = 0; first < task.count; first += kLanes) {
    const auto load = [&](int value) {
      return Batch::load_unaligned(task.sources + value * task.stride + first);
    };
    const Batch y[3] = {load(0), load(1), load(2)};
    Batch n[3] = {load(3), load(4), load(5)}, p[3] = {load(9), load(10), load(11)};
    if (task.count - first < kLanes) {
      const Batch inside = lanesBelow<Batch>(task.count - first);
      for (int i = 0; i < 3; ++i) {
        n[i] *= inside;
        p[i] *= inside;
      }
    }
    Batch u[3];
    for (int i = 0; i < 3; ++i) {
      u[i] = load(6 + i) - Batch(linear.shift[i]);
      for (int k = 0; k < 3; ++k) {
        u[i] = xsimd::fnma(Batch(linear.gradient[i][k]), y[k], u[i]);
        p[i] = xsimd::fnma(Batch(linear.stress[i][k]), n[k], p[i]);
      }
    }
    Batch e[3] = {y[0] - Batch(task.x[0]), y[1] - Batch(task.x[1]), y[2] - Batch(task.x[2])};
    const auto dot = [](const Batch(&a)[3], const Batch(&b)[3]) {
      return xsimd::fma(a[0], b[0], xsimd::fma(a[1], b[1], a[2] * b[2]));
    };
    const Batch inverse = inverseSquareRoot(dot(e, e));
    for (Batch& component : e) component *= inverse;
    const Batch squared = inverse * inverse;
    const Batch ep = dot(e, p), en = dot(e, n), eu = dot(e, u), un = dot(u, n);
    const Batch scaleU = inverse * Batch(task.constants.weightU),
                scaleT = squared * Batch(task.constants.weightT),
                scaleS = squared * inverse * Batch(task.constants.weightS);
    for (int i = 0; i < 3; ++i) {
      const Batch fromP = xsimd::fma(diagonal, p[i], e[i] * ep);
      const Batch fromU = en * xsimd::fma(twist, u[i], three * e[i] * eu) +
                          twist * xsimd::fnma(e[i], un, n[i] * eu);
      moved[i] += xsimd::fma(scaleU, fromP, scaleT * fromU);
    }
    // D p: (1-2nu)(e p + p e - delta e.p) + 3 e e e.p
    // S u: 3 e.n [(1-2nu) delta e.u + nu (e u + u e) - 5 e e e.u] + 3 nu e.u (n e + e n)
    //      + (1-2nu)(3 n.u e e + n u + u n) - (1-4nu) delta n.u
    const Batch ofEe = scaleT * three * ep - scaleS * (three * twist * un - three * five * en * eu),
                ofDelta = scaleS * (last * un - three * twist * en * eu) - scaleT * twist * ep,
                ofEp = scaleT * twist, ofEu = scaleS * three * ratio * en,
                ofEn = scaleS * three * ratio * eu, ofUn = scaleS * twist;
    // Symmetric products a b + b a, gathered by their factor: e (ofEp p - ofEu u - ofEn n).
    Batch besideE[3], besideU[3];
    for (int i = 0; i < 3; ++i) {
      besideE[i] = ofEp * p[i] - ofEu * u[i] - ofEn * n[i];
      besideU[i] = ofUn * n[i];
    }
    constexpr int kRow[6] = {0, 0, 1, 0, 1, 2}, kColumn[6] = {0, 1, 1, 2, 2, 2};
    for (int k = 0; k < 6; ++k) {
      const int i = kRow[k], j = kColumn[k];
      Batch value = ofEe * e[i] * e[j] + e[i] * besideE[j] + e[j] * besideE[i] - u[i] * besideU[j] -
                    u[j] * besideU[i];
      if (i == j) value += ofDelta;
      stress[k] += value;
    }
  }
  for (int i = 0; i < 3; ++i) task.displacement[i] += xsimd::hadd(moved[i]);
  for (int k = 0; k < 6; ++k) task.stress[k] += xsimd::hadd(stress[k]);
}

}  // namespace palpa::bem::detail
