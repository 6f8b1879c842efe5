#include "modeling/shapes/round_patches.h"

#include <cmath>
#include <numbers>

#include "modeling/shapes/cube_face.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

/// Suffix "_xmin", …, "_ymax" for a horizontal unit vector along an axis.
std::string direction(const Vector3d& v) {
  const std::string axis = v.x() != 0.0 ? "_x" : "_y";
  return axis + (v.sum() > 0.0 ? "max" : "min");
}

void addQuadrants(ExactShape& shape, const std::string& name, const SplineBasis& arc, bool facesUp,
                  bool smoothRim, const std::function<Vector3d(const Vector3d&)>& point) {
  for (double x : {-1.0, 1.0})
    for (double y : {-1.0, 1.0}) {
      // Parameters grow from the centre along x and y, in the order that orients the normal
      // outwards.
      const bool xFirst = (x * y > 0.0) == facesUp;
      const auto surface = [=](double s, double t) {
        const double a = std::numbers::pi / 4 * (xFirst ? s : t);
        const double b = std::numbers::pi / 4 * (xFirst ? t : s);
        return point({x * std::sin(a) * std::cos(b), y * std::cos(a) * std::sin(b), 0.0});
      };
      shape.patches.push_back({name + direction({x, 0, 0}) + direction({0, y, 0}),
                               {arc, arc},
                               surface,
                               {true, smoothRim, smoothRim, true}});
    }
}

}  // namespace

void addBand(ExactShape& shape, const std::string& name, const RoundNet& net,
             const SplineBasis& along,
             const std::function<Vector3d(const Vector3d& radial, double t)>& point,
             bool smoothStart, bool smoothEnd) {
  const auto add = [&](const CubeFace& face, const std::string& suffix, const SplineBasis& arc,
                       double from, double to) {
    const auto surface = [=, n = face.normal, u = face.u](double s, double t) {
      const double angle = quarterAngle(from + s * (to - from));
      return point(std::cos(angle) * n + std::sin(angle) * u, t);
    };
    shape.patches.push_back(
        {name + suffix, {arc, along}, surface, {smoothStart, true, smoothEnd, true}});
  };
  for (const CubeFace& face : cubeFaces()) {
    if (!face.isSide()) continue;
    const std::string suffix = direction(face.normal);
    if (net.eighths) {
      add(face, suffix + direction(-face.u), reversed(net.arc), 0.0, 0.5);
      add(face, suffix + direction(face.u), net.arc, 0.5, 1.0);
    } else {
      add(face, suffix, net.arc, 0.0, 1.0);
    }
  }
}

void addDisc(ExactShape& shape, const std::string& name, const RoundNet& net, bool facesUp,
             bool smoothRim, const std::function<Vector3d(const Vector3d& flat)>& point) {
  if (net.eighths) return addQuadrants(shape, name, net.arc, facesUp, smoothRim, point);
  const CubeFace& face = cubeFaces()[facesUp ? 5 : 4];
  const auto surface = [=, u = face.u, v = face.v](double s, double t) {
    const double a = quarterAngle(s);
    const double b = quarterAngle(t);
    return point(std::sin(a) * std::cos(b) * u + std::cos(a) * std::sin(b) * v);
  };
  shape.patches.push_back(
      {name, {net.arc, net.arc}, surface, {smoothRim, smoothRim, smoothRim, smoothRim}});
}

void addFlatDisc(ExactShape& shape, const std::string& name, const RoundNet& net, bool facesUp,
                 bool smoothRim, const Eigen::Vector2d& rim) {
  addDisc(shape, name, net, facesUp, smoothRim, [rim](const Vector3d& flat) {
    return Vector3d(std::numbers::sqrt2 * rim.x() * flat + rim.y() * Vector3d::UnitZ());
  });
}

}  // namespace palpa::modeling
