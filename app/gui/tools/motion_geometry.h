#pragma once

#include <Eigen/Core>

// Angles and factors from a path of the pointer. The origin of pixels is the top left corner.
namespace palpa::gui {

/// Angle of the path around `centre` in degrees, -180 … 180, counter-clockwise on the screen. 0 if
/// one of the pixels equals the centre.
double degreesAround(const Eigen::Vector2d& centre, const Eigen::Vector2d& from,
                     const Eigen::Vector2d& to);

/// Ratio of the distances of `to` and `from` from the centre, measured along the direction of
/// `from`; at least 0. If `from` is nearer to the centre than `least` pixels, where the ratio would
/// jump, 100 pixels to the right add 1.
double factorFrom(const Eigen::Vector2d& centre, const Eigen::Vector2d& from,
                  const Eigen::Vector2d& to, double least = 20);

/// Multiple of `step` > 0 nearest to the value.
double snapped(double value, double step);

/// Signed unit vector of the coordinate axis nearest to the direction; not axis `except` (0, 1, 2).
/// The first axis wins ties.
Eigen::Vector3d nearestAxis(const Eigen::Vector3d& direction, int except = -1);

/// Largest 1, 2 or 5 times a power of ten that does not exceed `length` > 0.
double roundLengthBelow(double length);

}  // namespace palpa::gui
