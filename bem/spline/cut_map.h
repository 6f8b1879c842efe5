#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>

#include "base/byte_stream.h"

namespace palpa::bem {

/// Map from the unit square onto a part of a knot rectangle bounded by a curve: in (u, v), or in
/// (v, u), the points between two graphs over an interval. The local coordinates (s, t) have the
/// orientation of (u, v). Where the border of a support is one of the graphs, the coordinate across
/// can be the root of the distance from it, so that fields like √ρ are smooth in it.
class CutMap {
 public:
  static constexpr int kPoints = 9;
  using Values = std::array<double, kPoints>;
  /// Node k = 0 … kPoints - 1 at which the graphs are given: from -1 to 1 (Chebyshev-Lobatto).
  static double node(int k);

  /// Graph from which the distance is the square of the local coordinate.
  enum class Root { kNone, kLower, kUpper };

  /// Part between two graphs over u (axis 0) or over v (axis 1), from `begin` to `end`. `lower` and
  /// `upper` are the values of the graphs at the nodes.
  CutMap(int axis, double begin, double end, const Values& lower, const Values& upper,
         Root root = Root::kNone);
  CutMap withRoot(Root root) const;

  bool operator==(const CutMap&) const = default;

  struct Image {
    Eigen::Vector2d parameters;  ///< (u, v)
    /// Of (u, v) with respect to (s, t); determinant > 0, but 0 on a graph with root.
    Eigen::Matrix2d derivative;
  };
  Image at(double s, double t) const;
  /// Local coordinates of (u, v); none if the point lies outside the part by more than `slack` of
  /// the unit square.
  std::optional<Eigen::Vector2d> invert(double u, double v, double slack) const;

  /// Writes all data byte by byte, for a hash.
  void write(const ByteSink& sink) const;

 private:
  struct Value {
    double value, slope;  ///< with respect to the coordinate from -1 to 1
  };
  static Value evaluate(const Values& polynomial, double x);

  int axis_;
  Root root_;
  double begin_, end_;
  Values lower_, upper_;  ///< polynomial coefficients, by power
};

}  // namespace palpa::bem
