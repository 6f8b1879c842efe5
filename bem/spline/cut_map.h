#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>

#include "base/byte_stream.h"

namespace palpa::bem {

/// A part of a knot rectangle that a curve bounds: in (u, v), or (v, u), the points between two
/// graphs over an interval. Local coordinates (s, t) run over the unit square and keep the
/// orientation of (u, v).
class CutMap {
 public:
  static constexpr int kPoints = 9;
  using Values = std::array<double, kPoints>;
  /// Where the graphs are to be given: from -1 to 1 (Chebyshev-Lobatto).
  static double node(int k);

  /// Graphs over u (axis 0) or v (axis 1) from `begin` to `end`, by their values at the nodes.
  CutMap(int axis, double begin, double end, const Values& lower, const Values& upper);

  bool operator==(const CutMap&) const = default;

  struct Image {
    Eigen::Vector2d parameters;  ///< (u, v)
    Eigen::Matrix2d derivative;  ///< of (u, v) by (s, t); positive determinant
  };
  Image at(double s, double t) const;
  /// Local coordinates of (u, v), none outside of the part (beyond `slack` of the unit square).
  std::optional<Eigen::Vector2d> invert(double u, double v, double slack) const;

  /// All of it, byte by byte, for a hash.
  void write(const ByteSink& sink) const;

 private:
  struct Value {
    double value, slope;  ///< by the coordinate from -1 to 1
  };
  static Value evaluate(const Values& polynomial, double x);

  int axis_;
  double begin_, end_;
  Values lower_, upper_;  ///< polynomials, by powers
};

}  // namespace palpa::bem
