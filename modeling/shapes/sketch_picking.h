#pragma once

#include <optional>

#include "modeling/shapes/profile_sketch.h"

// Picking and snapping in the plane of a sketch. Distances in mm.
namespace palpa::modeling {

/// Point of the sketch nearest to a location within `reach`; -1 if there is none. Of points at the
/// same distance the one on the curve.
int nearestSketchPoint(const ProfileSketch& sketch, const Eigen::Vector2d& at, double reach);

/// Place of a polyline of ProfileSketch::samples() nearest to a location, if within `reach`.
std::optional<SketchPlace> nearestSketchPlace(const std::vector<SketchPlace>& samples,
                                              const Eigen::Vector2d& at, double reach);

/// Targets of snapping, and its distance.
struct SnapRules {
  double reach = 0.0;                   ///< mm
  double gridStep = 0.0;                ///< mm; 0: no grid
  bool toAxes = true;                   ///< the lines x = 0 and y = 0
  std::vector<Eigen::Vector2d> points;  ///< of the sketch, mm
};

/// Location after snapping, and its targets.
struct Snapped {
  Eigen::Vector2d at;  ///< mm
  bool toPoint = false;
  std::array<bool, 2> toLine{};  ///< coordinate by coordinate: an axis, or the x or y of a point
  std::array<bool, 2> toGrid{};
};

/// Nearest point within reach; otherwise each coordinate by itself: an axis, else the coordinate of
/// a point, else the grid.
Snapped snapped(const Eigen::Vector2d& at, const SnapRules& rules);

/// Smallest step that is not below `least` (mm, > 0): 1, 2 or 5 times a power of ten of `unit` (the
/// shown unit of length in mm).
double gridStep(double least, double unit);

}  // namespace palpa::modeling
