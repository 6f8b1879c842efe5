#pragma once

#include <Eigen/Core>

// What a pointer's path means for a motion of points. Pixels have their origin at the top left.
namespace palpa::gui {

/// The angle in degrees, -180 … 180 and counter-clockwise as seen on the screen, that the pointer
/// went around `centre`. 0 where one of the pixels lies in the centre.
double degreesAround(const Eigen::Vector2d& centre, const Eigen::Vector2d& from,
                     const Eigen::Vector2d& to);

/// How many times as far from the centre the pointer is as at `from`, measured along the direction
/// in which it began; never below 0. Begun within `least` pixels of the centre, where that ratio
/// would jump, 100 pixels to the right add 1.
double factorFrom(const Eigen::Vector2d& centre, const Eigen::Vector2d& from,
                  const Eigen::Vector2d& to, double least = 20);

/// The multiple of `step` nearest to the value. `step` > 0.
double snapped(double value, double step);

/// The unit vector along a coordinate axis, with its sign, nearest to the direction; not along
/// `except` (0, 1, 2), when one is given. The first axis wins ties.
Eigen::Vector3d nearestAxis(const Eigen::Vector3d& direction, int except = -1);

/// A round length, 1, 2 or 5 times a power of ten, not above `length` > 0.
double roundLengthBelow(double length);

}  // namespace palpa::gui
