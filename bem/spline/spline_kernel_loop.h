#pragma once

#include <algorithm>
#include <xsimd/xsimd.hpp>

#include "bem/spline/spline_kernel.h"

/// Loops of spline_kernel.h, included by one source file per instruction set.
namespace palpa::bem::detail {

template <class Batch>
struct Functions1d {
  Batch value[kMaxSplineDegree + 1], derivative[kMaxSplineDegree + 1];

  Functions1d(const SpanPolynomials& span, const Batch& parameter) {
    const Batch s = (parameter - Batch(span.lower)) * Batch(span.scale) - Batch(1.0);
    const int size = span.degree + 1;
    for (int f = 0; f < size; ++f) {
      Batch v(span.coefficients[span.degree * size + f]), slope(0.0);
      for (int m = span.degree - 1; m >= 0; --m) {
        slope = xsimd::fma(slope, s, v);
        v = xsimd::fma(v, s, Batch(span.coefficients[m * size + f]));
      }
      value[f] = v;
      derivative[f] = slope * Batch(span.scale);
    }
  }
};

template <class Arch>
void placePoints(const PlacePointsTask& task) {
  using Batch = xsimd::batch<double, Arch>;
  constexpr int kLanes = static_cast<int>(Batch::size);
  const int sizeU = task.direction[0].degree + 1, sizeV = task.direction[1].degree + 1;
  for (int first = 0; first < task.count; first += kLanes) {
    const Functions1d<Batch> a(task.direction[0], Batch::load_unaligned(task.u + first));
    const Functions1d<Batch> b(task.direction[1], Batch::load_unaligned(task.v + first));
    Batch position[3], du[3], dv[3];
    for (int c = 0; c < 3; ++c) position[c] = du[c] = dv[c] = Batch(0.0);
    for (int j = 0; j < sizeV; ++j) {
      Batch along[3], slope[3];
      for (int c = 0; c < 3; ++c) along[c] = slope[c] = Batch(0.0);
      for (int i = 0; i < sizeU; ++i) {
        const double* point = task.points + static_cast<std::ptrdiff_t>(3) * (i + j * sizeU);
        for (int c = 0; c < 3; ++c) {
          along[c] = xsimd::fma(a.value[i], Batch(point[c]), along[c]);
          slope[c] = xsimd::fma(a.derivative[i], Batch(point[c]), slope[c]);
        }
        if (!task.basis) continue;
        alignas(64) double product[kLanes];
        (a.value[i] * b.value[j]).store_aligned(product);
        double* basis = task.basis + static_cast<std::ptrdiff_t>(first) * task.functionStride + i +
                        static_cast<std::ptrdiff_t>(j) * sizeU;
        for (int lane = 0; lane < kLanes; ++lane) basis[lane * task.functionStride] = product[lane];
      }
      for (int c = 0; c < 3; ++c) {
        position[c] = xsimd::fma(b.value[j], along[c], position[c]);
        du[c] = xsimd::fma(b.value[j], slope[c], du[c]);
        dv[c] = xsimd::fma(b.derivative[j], along[c], dv[c]);
      }
    }
    const Batch weight = Batch::load_unaligned(task.weight + first);
    const auto count = static_cast<std::ptrdiff_t>(task.count);
    double* geometry = task.geometry + first;
    Batch squared(0.0);
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      const Batch area = weight * (du[d] * dv[e] - du[e] * dv[d]);
      squared = xsimd::fma(area, area, squared);
      area.store_unaligned(geometry + (3 + c) * count);
      position[c].store_unaligned(geometry + c * count);
    }
    xsimd::sqrt(squared).store_unaligned(geometry + 6 * count);
  }
}

template <class Arch>
void tabulate(const TabulateTask& task) {
  using Batch = xsimd::batch<double, Arch>;
  constexpr int kLanes = static_cast<int>(Batch::size);
  const int size = task.polynomials.degree + 1;
  alignas(64) double points[kElementLanes] = {}, values[kElementLanes];
  std::copy_n(task.points, task.count, points);
  for (int first = 0; first < task.count; first += kLanes) {
    const Functions1d<Batch> functions(task.polynomials, Batch::load_aligned(points + first));
    const int last = std::min(task.count - first, kLanes);
    for (int f = 0; f < size; ++f) {
      functions.value[f].store_aligned(values);
      for (int k = 0; k < last; ++k) task.values[(first + k) * size + f] = values[k];
    }
  }
}

}  // namespace palpa::bem::detail
