#include "modeling/shapes/primitives.h"

#include <BSplCLib.hxx>
#include <BSplSLib.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <cmath>
#include <functional>
#include <numbers>

#include "modeling/error.h"
#include "modeling/text.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using Net = std::vector<std::vector<Vector3d>>;

constexpr double kQuarter = std::numbers::pi / 4;
constexpr int kDegree = 3;

void checkLength(const std::string& shape, const std::string& name, double value) {
  if (std::isfinite(value) && value >= kSmallestLength && value <= kLargestLength) return;
  throw ModelingError(shape + ": " + name + " is " + numberText(value) + " mm; expected " +
                      numberText(kSmallestLength) + " … " + numberText(kLargestLength) + " mm");
}

/// Clamped uniform knots over [0, 1] for `count` control points of degree 3.
std::vector<double> uniformKnots(int count) {
  std::vector<double> knots(count + kDegree + 1);
  const int spans = count - kDegree;
  for (int i = 0; i < static_cast<int>(knots.size()); ++i)
    knots[i] = std::clamp(static_cast<double>(i - kDegree) / spans, 0.0, 1.0);
  return knots;
}

/// Control points of the bicubic patch that agrees with point(s, t), s and t in [0, 1], at the
/// Greville abscissae (the knot averages, where spline interpolation is well conditioned). A row of
/// the net on the border depends only on points on that border, so neighbours agree.
Net interpolate(int uCount, int vCount, const std::function<Vector3d(double, double)>& point) {
  const auto flat = [](int count) {
    const std::vector<double> knots = uniformKnots(count);
    TColStd_Array1OfReal array(1, static_cast<int>(knots.size()));
    for (std::size_t i = 0; i < knots.size(); ++i)
      array.SetValue(static_cast<int>(i) + 1, knots[i]);
    return array;
  };
  const TColStd_Array1OfReal uKnots = flat(uCount);
  const TColStd_Array1OfReal vKnots = flat(vCount);
  TColStd_Array1OfReal uSites(1, uCount), vSites(1, vCount);
  BSplCLib::BuildSchoenbergPoints(kDegree, uKnots, uSites);
  BSplCLib::BuildSchoenbergPoints(kDegree, vKnots, vSites);

  TColgp_Array2OfPnt poles(1, uCount, 1, vCount);
  for (int i = 1; i <= uCount; ++i)
    for (int j = 1; j <= vCount; ++j) {
      const Vector3d p = point(uSites(i), vSites(j));
      poles.SetValue(i, j, gp_Pnt(p.x(), p.y(), p.z()));
    }
  int problem = 0;
  try {
    BSplSLib::Interpolate(kDegree, kDegree, uKnots, vKnots, uSites, vSites, poles, problem);
  } catch (const Standard_Failure& failure) {
    throw ModelingError(std::string("spline interpolation failed: ") + failure.GetMessageString());
  }
  if (problem != 0) throw ModelingError("spline interpolation failed: singular matrix");

  Net net(uCount, std::vector<Vector3d>(vCount));
  for (int i = 0; i < uCount; ++i)
    for (int j = 0; j < vCount; ++j) {
      const gp_Pnt& p = poles.Value(i + 1, j + 1);
      net[i][j] = {p.X(), p.Y(), p.Z()};
    }
  return net;
}

/// Collects patches given by positions and joins control points that coincide.
class Builder {
 public:
  explicit Builder(double scale) : tolerance_(1e-9 * scale) {}

  void add(const std::string& name, const Net& net) {
    const int rows = static_cast<int>(net.size());
    const int columns = static_cast<int>(net.front().size());
    Patch patch{name, {kDegree, kDegree}, {uniformKnots(rows), uniformKnots(columns)}, {}};
    patch.net.assign(rows, std::vector<int>(columns));
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) patch.net[i][j] = indexOf(net[i][j]);
    patches_.push_back(std::move(patch));
  }

  Solid build() { return Solid(std::move(points_), std::move(patches_)); }

 private:
  int indexOf(Vector3d p) {
    // Rounding leaves ±1e-15 where a zero is meant; clean files and exact planes want the zero.
    for (double& value : p)
      if (std::abs(value) < tolerance_) value = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if ((points_[i] - p).norm() <= tolerance_) return static_cast<int>(i);
    points_.push_back(p);
    return static_cast<int>(points_.size()) - 1;
  }

  double tolerance_;
  std::vector<Vector3d> points_;
  std::vector<Patch> patches_;
};

/// A face of the cube [-1, 1]³ with the axes of its parameters; u × v points outwards.
struct CubeFace {
  const char* name;
  Vector3d normal, u, v;
};

const std::array<CubeFace, 6>& cubeFaces() {
  static const std::array<CubeFace, 6> faces{{
      {"side_xmin", {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
      {"side_xmax", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
      {"side_ymin", {0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
      {"side_ymax", {0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
      {"bottom", {0, 0, -1}, {0, 1, 0}, {1, 0, 0}},
      {"top", {0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
  }};
  return faces;
}

/// Angle from -π/4 to π/4 for a parameter from 0 to 1, odd about the middle to the last bit.
double angle(double t) {
  return (t - 0.5) * 2.0 * kQuarter;
}

}  // namespace

Solid makeSphere(double radius, int controlPoints) {
  checkLength("sphere", "the radius", radius);
  if (controlPoints < 4 || controlPoints > 64)
    throw ModelingError("sphere: " + std::to_string(controlPoints) +
                        " control points per direction; expected 4 … 64");
  Builder builder(radius);
  for (const CubeFace& face : cubeFaces())
    builder.add(face.name, interpolate(controlPoints, controlPoints, [&](double s, double t) {
                  const Vector3d direction =
                      face.normal + std::tan(angle(s)) * face.u + std::tan(angle(t)) * face.v;
                  return Vector3d(radius * direction.normalized());
                }));
  return builder.build();
}

Solid makeCylinder(double radius, double height) {
  checkLength("cylinder", "the radius", radius);
  checkLength("cylinder", "the height", height);
  constexpr int kAround = 7;  // control points per quarter: 4 spans, radial error 7.5e-5 R
  constexpr int kAlong = 5;
  Builder builder(std::min(radius, height));
  for (const CubeFace& face : cubeFaces()) {
    if (face.normal.z() == 0.0) {
      builder.add(face.name, interpolate(kAround, kAlong, [&](double s, double t) {
                    const Vector3d radial =
                        std::cos(angle(s)) * face.normal + std::sin(angle(s)) * face.u;
                    return Vector3d(radius * radial + t * height * Vector3d::UnitZ());
                  }));
      continue;
    }
    const double z = face.normal.z() > 0.0 ? height : 0.0;
    builder.add(face.name, interpolate(kAround, kAround, [&](double s, double t) {
                  const double a = angle(s);
                  const double b = angle(t);
                  const Vector3d flat =
                      std::sin(a) * std::cos(b) * face.u + std::cos(a) * std::sin(b) * face.v;
                  return Vector3d(std::numbers::sqrt2 * radius * flat + z * Vector3d::UnitZ());
                }));
  }
  return builder.build();
}

Solid makeBox(const Vector3d& size) {
  constexpr const char* kAxes[] = {"the size in x", "the size in y", "the size in z"};
  for (int axis = 0; axis < 3; ++axis) checkLength("box", kAxes[axis], size[axis]);
  constexpr int kControlPoints = 4;
  Builder builder(size.minCoeff());
  for (const CubeFace& face : cubeFaces())
    builder.add(face.name, interpolate(kControlPoints, kControlPoints, [&](double s, double t) {
                  const Vector3d unit =
                      face.normal + (2.0 * s - 1.0) * face.u + (2.0 * t - 1.0) * face.v;
                  return Vector3d(0.5 * size.x() * unit.x(), 0.5 * size.y() * unit.y(),
                                  0.5 * size.z() * (unit.z() + 1.0));
                }));
  return builder.build();
}

}  // namespace palpa::modeling
