#pragma once

#include <array>
#include <vector>

#include "app/core/results/drawn_body.h"

namespace palpa::app {

/// Pairs the surfaces of two similar bodies at rest: each point of one with the nearest point of
/// the other that faces the same side (normals within 60°). Points farther apart than reach() have
/// no partner: there the bodies do not correspond.
class SurfaceCorrespondence {
 public:
  /// From the points of `from` to the surface of `to`. About 5 µs per point. Throws Cancelled.
  SurfaceCorrespondence(const DrawnBody& from, const DrawnBody& to, const Job& job = {});

  /// mm; 5 % of the diagonal of the box around `from`.
  double reach() const { return reach_; }
  /// Part of the area of `from` that has partners, 0 … 1.
  double share() const { return share_; }
  /// Largest distance between partners, mm.
  double farthest() const { return farthest_; }
  /// Values of `to` at the points of `from`; NaN without a partner.
  std::vector<double> carried(const std::vector<double>& ofTo) const;

 private:
  struct Partner {
    std::array<int, 3> points{-1, -1, -1};  ///< of `to`
    Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  };
  std::vector<Partner> partners_;
  double reach_ = 0, share_ = 0, farthest_ = 0;
};

}  // namespace palpa::app
