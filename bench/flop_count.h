#pragma once

#include <cmath>

#include "bem/base/inverse_square_root.h"

namespace palpa::bench {

/// A number that counts its operations; it replaces a batch in the kernels of the assembly.
/// Additions, multiplications, comparisons, divisions and roots count 1, fused operations 2,
/// logarithms and arc tangents kTranscendental.
struct Counted {
  static constexpr long kTranscendental = 20;
  static inline long operations = 0;
  double value = 0;

  Counted() = default;
  Counted(double of) : value(of) {}  // NOLINT: batches convert from numbers too
  static Counted of(double result, long count = 1) {
    operations += count;
    return {result};
  }
  friend Counted operator+(Counted a, Counted b) { return of(a.value + b.value); }
  friend Counted operator-(Counted a, Counted b) { return of(a.value - b.value); }
  friend Counted operator*(Counted a, Counted b) { return of(a.value * b.value); }
  friend Counted operator/(Counted a, Counted b) { return of(a.value / b.value); }
  friend Counted operator-(Counted a) { return of(-a.value); }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  friend bool operator<(Counted a, Counted b) { return of(a.value - b.value).value < 0; }
  friend bool operator<=(Counted a, Counted b) { return of(a.value - b.value).value <= 0; }
  friend bool operator>=(Counted a, Counted b) { return of(a.value - b.value).value >= 0; }
  friend bool operator==(Counted a, Counted b) { return of(a.value - b.value).value == 0; }
};

}  // namespace palpa::bench

// The kernels call these functions by their full names, so these must be declared before.
namespace xsimd {
using Counted = palpa::bench::Counted;
inline Counted fma(Counted a, Counted b, Counted c) {
  return Counted::of(a.value * b.value + c.value, 2);
}
inline Counted sqrt(Counted a) {
  return Counted::of(std::sqrt(a.value));
}
inline Counted abs(Counted a) {
  return Counted::of(std::abs(a.value));
}
inline Counted max(Counted a, Counted b) {
  return Counted::of(std::fmax(a.value, b.value));
}
inline Counted log(Counted a) {
  return Counted::of(std::log(a.value), Counted::kTranscendental);
}
inline Counted atan2(Counted a, Counted b) {
  return Counted::of(std::atan2(a.value, b.value), Counted::kTranscendental);
}
}  // namespace xsimd
namespace palpa::bem {
/// As with AVX-512: two Newton steps.
template <>
inline bench::Counted inverseSquareRoot<bench::Counted>(const bench::Counted& x) {
  return bench::Counted::of(1 / std::sqrt(x.value), 9);
}
namespace detail {
inline bench::Counted choose(bool condition, bench::Counted a, bench::Counted b) {
  return condition ? a : b;
}
}  // namespace detail
}  // namespace palpa::bem
