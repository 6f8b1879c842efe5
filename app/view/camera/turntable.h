#pragma once

#include <Eigen/Core>
#include <vector>

#include "app/view/camera/bounds.h"
#include "app/view/camera/ray.h"
#include "app/view/camera/view_fit.h"

/// The camera of the view. Internal to app/view; pure arithmetic, no VTK.
namespace palpa::view {

/// Pixels at the edges of a picture that words and bars need.
struct Reserve {
  double right = 0, top = 0, bottom = 0;
};

/// A camera that turns about the vertical axis (azimuth) and tilts (elevation), looking at a focus
/// from a distance. The vertical stays upright in the picture: at ±90 degrees of elevation the tilt
/// ends instead of flipping over.
///
/// Pixels are counted from the top left corner. The parallel projection has the same scale as the
/// perspective projection in the plane through the focus.
class Turntable {
 public:
  Turntable();

  /// Size of the picture in pixels; anything below 1 counts as 1.
  void setSize(int width, int height);
  int width() const { return width_; }
  int height() const { return height_; }

  /// The box around everything drawn: limits how near and far the camera goes. May be empty.
  void setScene(const Bounds& bounds);

  void setDirection(const Eigen::Vector3d& direction, const Eigen::Vector3d& up);
  void setParallel(bool parallel) { parallel_ = parallel; }
  bool parallel() const { return parallel_; }

  /// Turns and tilts by angles in rad.
  void orbit(double azimuth, double elevation);
  /// The same, but a tilt goes on over the pole; the picture is upright there again.
  void turn(double azimuth, double elevation);
  /// Moves the picture so that `point` (of the scene) appears `pixels` away from where it did.
  void pan(const Eigen::Vector2d& pixels, const Eigen::Vector3d& point);
  /// Comes nearer by the factor, as far as the limits allow; `point` stays where it appears.
  void zoom(double factor, const Eigen::Vector3d& point);
  /// Shows all points, with `margin` pixels free on each side, and `reserve` in addition, of which
  /// at most a third of the width and a quarter of the height count. A single point comes to the
  /// middle at the same distance as before; without points nothing happens.
  void fit(const std::vector<Eigen::Vector3d>& points, double margin, const Reserve& reserve = {});
  /// The distance that fit() would choose.
  double fittingDistance(const std::vector<Eigen::Vector3d>& points, double margin) const;

  ViewAxes axes() const;
  const Eigen::Vector3d& focus() const { return focus_; }
  double distance() const { return distance_; }
  void setDistance(double distance);
  /// Far in front of the scene in the parallel projection.
  Eigen::Vector3d eye() const;
  /// Height, in mm, of what is visible in the plane through the focus.
  double visibleHeight() const;

  /// How far `point` lies in front of the eye, along the direction of view.
  double depth(const Eigen::Vector3d& point) const;
  /// Pixels per mm for lengths parallel to the screen at a depth > 0.
  double pixelsPerLength(double depth) const;
  /// NaN for a point that does not lie in front of the eye.
  Eigen::Vector2d toPixel(const Eigen::Vector3d& point) const;
  Ray ray(const Eigen::Vector2d& pixel) const;
  /// The point under `pixel` in the plane through `through` parallel to the screen.
  Eigen::Vector3d inViewPlane(const Eigen::Vector2d& pixel, const Eigen::Vector3d& through) const;

  /// Nearest and farthest depth that must be drawn to see all of `bounds`.
  std::array<double, 2> clippingRange(const Bounds& bounds) const;

 private:
  struct Fit {
    Eigen::Vector3d focus;
    double distance;
  };
  Fit fitting(const std::vector<Eigen::Vector3d>& points, double margin,
              const Reserve& reserve) const;

  double azimuth_ = 0;    ///< rad, of the direction of view about the vertical, from x to y
  double elevation_ = 0;  ///< rad, of the direction of view above the horizontal
  Eigen::Vector3d focus_ = Eigen::Vector3d::Zero();
  double distance_ = 100;
  bool parallel_ = false;
  int width_ = 1;
  int height_ = 1;
  Eigen::Vector3d sceneCenter_ = Eigen::Vector3d::Zero();
  double sceneRadius_ = 50;
};

}  // namespace palpa::view
