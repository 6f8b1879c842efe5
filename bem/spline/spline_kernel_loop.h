#pragma once
#include <xsimd/xsimd.hpp>

#include "bem/inverse_square_root.h"
#include "bem/spline/spline_kernel.h"

/// The loops of spline_kernel.h, included by one source file per instruction set.
namespace palpa::bem::detail {

template <class Batch>
struct Functions1d {
  Batch value[kMostSplineDegree + 1], derivative[kMostSplineDegree + 1];

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
    Batch squared(0.0);
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      const Batch area = weight * (du[d] * dv[e] - du[e] * dv[d]);
      squared = xsimd::fma(area, area, squared);
      area.store_unaligned(task.area[c] + first);
      position[c].store_unaligned(task.position[c] + first);
    }
    xsimd::sqrt(squared).store_unaligned(task.areaSize + first);
  }
}

/// Kelvin's kernels times the weights, [kernel][point].
template <class Batch>
void evaluateKernels(const SumKernelsTask& task) {
  constexpr int kLanes = static_cast<int>(Batch::size);
  constexpr int kRow[6] = {0, 0, 1, 0, 1, 2}, kColumn[6] = {0, 1, 1, 2, 2, 2};
  for (int first = 0; first < task.count; first += kLanes) {
    Batch r[3], n[3];
    for (int c = 0; c < 3; ++c) {
      r[c] = Batch::load_unaligned(task.position[c] + first) - Batch(task.x[c]);
      n[c] = Batch::load_unaligned(task.area[c] + first);
    }
    const Batch inverse =
        inverseSquareRoot(xsimd::fma(r[0], r[0], xsimd::fma(r[1], r[1], r[2] * r[2])));
    const Batch inverseSquared = inverse * inverse, inverseCubed = inverse * inverseSquared;
    const Batch along = xsimd::fma(r[0], n[0], xsimd::fma(r[1], n[1], r[2] * n[2]));
    const Batch weightU = Batch::load_unaligned(task.areaSize + first) * inverseCubed;
    const Batch weightT = along * inverseCubed * inverseSquared;
    double* out = task.kernels + first;
    const auto store = [&](int kernel, const Batch& value) {
      value.store_unaligned(out + static_cast<std::ptrdiff_t>(kernel) * task.count);
    };
    for (int k = 0; k < 6; ++k) {
      const Batch product = r[kRow[k]] * r[kColumn[k]];
      store(k, weightU * product);
      store(6 + k, weightT * product);
    }
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      store(12 + c, inverseCubed * (r[d] * n[e] - r[e] * n[d]));
    }
  }
}

template <class Arch>
void sumKernels(const SumKernelsTask& task) {
  using Batch = xsimd::batch<double, Arch>;
  constexpr int kLanes = static_cast<int>(Batch::size);
  evaluateKernels<Batch>(task);
  for (int function = 0; function < task.functionStride; function += kLanes) {
    Batch sum[kKernelSums];
    double* sums = task.sums + function;
    for (int k = 0; k < kKernelSums; ++k)
      sum[k] = Batch::load_unaligned(sums + static_cast<std::ptrdiff_t>(k) * task.functionStride);
    const double* basis = task.basis + function;
    for (int p = 0; p < task.used; ++p) {
      const Batch value =
          Batch::load_unaligned(basis + static_cast<std::ptrdiff_t>(p) * task.functionStride);
      const double* kernel = task.kernels + p;
      for (int k = 0; k < kKernelSums; ++k)
        sum[k] =
            xsimd::fma(value, Batch(kernel[static_cast<std::ptrdiff_t>(k) * task.count]), sum[k]);
    }
    for (int k = 0; k < kKernelSums; ++k)
      sum[k].store_unaligned(sums + static_cast<std::ptrdiff_t>(k) * task.functionStride);
  }
}

}  // namespace palpa::bem::detail
