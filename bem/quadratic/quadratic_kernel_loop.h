#pragma once

#include <xsimd/xsimd.hpp>

#include "bem/quadratic/quadratic_kernel.h"

/// Loops of quadratic_kernel.h, included by one source file per instruction set.
namespace palpa::bem::detail {

template <class Arch>
void placeOnTriangle(const PlaceOnTriangleTask& task) {
  using Batch = xsimd::batch<double, Arch>;
  constexpr int kLanes = static_cast<int>(Batch::size);
  const auto count = static_cast<std::ptrdiff_t>(task.count);
  for (int first = 0; first < task.count; first += kLanes) {
    const Batch u = Batch::load_unaligned(task.u + first),
                v = Batch::load_unaligned(task.v + first),
                weight = Batch::load_unaligned(task.weight + first);
    double* geometry = task.geometry + first;
    Batch du[3], dv[3], area[3];
    for (int i = 0; i < 3; ++i) {
      const auto c = [&](int k) { return Batch(task.polynomial[3 * k + i]); };
      const Batch alongU = xsimd::fma(u, c(3), xsimd::fma(v, c(4), c(1)));
      const Batch alongV = xsimd::fma(v, c(5), c(2));
      xsimd::fma(u, alongU, xsimd::fma(v, alongV, c(0))).store_unaligned(geometry + i * count);
      du[i] = weight * xsimd::fma(u, c(3), alongU);
      dv[i] = xsimd::fma(u, c(4), xsimd::fma(v, c(5), alongV));
    }
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      area[i] = du[j] * dv[k] - du[k] * dv[j];
      area[i].store_unaligned(geometry + (3 + i) * count);
    }
    xsimd::sqrt(xsimd::fma(area[0], area[0], xsimd::fma(area[1], area[1], area[2] * area[2])))
        .store_unaligned(geometry + 6 * count);
  }
}

template <class Arch>
void triangleBasis(const TriangleBasisTask& task) {
  using Batch = xsimd::batch<double, Arch>;
  constexpr int kLanes = static_cast<int>(Batch::size);
  // Coefficients of 1, u, v, u^2, uv, v^2 of the functions, in the order of QuadraticBasis.
  alignas(64) static constexpr double kCoefficients[6][kElementLanes] = {
      {1, 0, 0, 0, 0, 0, 0, 0},  {-3, -1, 0, 4, 0, 0, 0, 0}, {-3, 0, -1, 0, 0, 4, 0, 0},
      {2, 2, 0, -4, 0, 0, 0, 0}, {4, 0, 0, -4, 4, -4, 0, 0}, {2, 0, 2, 0, 0, -4, 0, 0}};
  for (int lane = 0; lane < kElementLanes; lane += kLanes) {
    Batch c[6];
    for (int k = 0; k < 6; ++k) c[k] = Batch::load_aligned(kCoefficients[k] + lane);
    for (int p = 0; p < task.count; ++p) {
      const Batch u(task.u[p]), v(task.v[p]);
      const Batch alongU = xsimd::fma(u, c[3], xsimd::fma(v, c[4], c[1]));
      const Batch alongV = xsimd::fma(v, c[5], c[2]);
      xsimd::fma(u, alongU, xsimd::fma(v, alongV, c[0]))
          .store_unaligned(task.basis + static_cast<std::ptrdiff_t>(kElementLanes) * p + lane);
    }
  }
}

}  // namespace palpa::bem::detail
