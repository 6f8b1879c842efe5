#include "bench/coverage/random_case.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "modeling/error.h"
#include "modeling/mesh/mesh.h"
#include "modeling/shapes/make_primitive.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::bench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using modeling::Region;
using modeling::Solid;

/// Random numbers that are the same with every standard library (Steele, Lea, Flood 2014:
/// SplitMix64).
class Random {
 public:
  /// The seed is mixed: neighbouring ones would give the same numbers, shifted by one.
  explicit Random(std::uint64_t seed) : state_(mixed(mixed(seed + kStep) + kStep)) {}

  double between(double low, double high) { return low + (high - low) * unit(); }
  int below(int count) { return std::min(static_cast<int>(unit() * count), count - 1); }
  Vector3d direction() {
    for (;;) {
      // One statement each: the order of evaluation of arguments is not defined.
      Vector3d v;
      for (int k = 0; k < 3; ++k) v[k] = between(-1, 1);
      if (v.norm() > 0.2 && v.norm() < 1) return v.normalized();
    }
  }

 private:
  static constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15ULL;
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }
  double unit() { return static_cast<double>(mixed(state_ += kStep) >> 11) * 0x1.0p-53; }
  std::uint64_t state_;
};

struct NamedShape {
  std::string name;
  Solid solid;
};

NamedShape randomShape(Random& random) {
  constexpr std::array kNames{"sphere", "ellipsoid", "box", "cylinder", "cone", "capsule", "torus"};
  const int kind = random.below(static_cast<int>(kNames.size()));
  modeling::Primitive primitive;
  const double size = random.between(12, 30);
  switch (kind) {
    case 0:
      primitive.shape = modeling::SphereShape{size};
      break;
    case 1:
      primitive.shape = modeling::EllipsoidShape{
          {size, size * random.between(0.6, 0.9), size * random.between(0.4, 0.8)}};
      break;
    case 2:
      primitive.shape = modeling::BoxShape{
          {2 * size, size * random.between(0.8, 2), size * random.between(0.6, 2)}};
      break;
    case 3:
      primitive.shape = modeling::CylinderShape{size, size * random.between(0.8, 3)};
      break;
    case 4:
      primitive.shape =
          modeling::ConeShape{size, size * random.between(0.4, 0.8), size * random.between(0.8, 2)};
      break;
    case 5:
      primitive.shape = modeling::CapsuleShape{size, size * random.between(0.5, 2)};
      break;
    default:
      primitive.shape = modeling::TorusShape{size, size * random.between(0.3, 0.5)};
  }
  return {kNames[kind], modeling::makePrimitive(primitive)};
}

/// x + A x + (b . x) C x around the middle of the box, of some 15 % over the size: stretches and
/// bends.
Solid bent(Random& random, const Solid& solid) {
  const auto [low, high] = modeling::boundingBox(modeling::Body(solid));
  const Vector3d middle = (low + high) / 2;
  const double size = (high - low).norm() / 2;
  Matrix3d stretch, bend;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      stretch(i, k) = random.between(-0.1, 0.1);
      bend(i, k) = random.between(-0.15, 0.15);
    }
  const Vector3d along = random.direction() / size;
  std::vector<Vector3d> points = solid.controlPoints();
  for (Vector3d& x : points) {
    const Vector3d from = x - middle;
    x += stretch * from + along.dot(from) * (bend * from);
  }
  return solid.withControlPoints(points);
}

/// Moves the points around a random one by up to 8 % of the size.
Solid dented(Random& random, const Solid& solid) {
  const auto [low, high] = modeling::boundingBox(modeling::Body(solid));
  const double size = (high - low).norm() / 2, reach = size * random.between(0.4, 0.7);
  std::vector<Vector3d> points = solid.controlPoints();
  const Vector3d center =
      points[static_cast<std::size_t>(random.below(static_cast<int>(points.size())))];
  const Vector3d by = size * random.between(-0.08, 0.08) * (center - (low + high) / 2).normalized();
  for (Vector3d& x : points) {
    const double t = (x - center).squaredNorm() / (reach * reach);
    if (t < 1) x += (1 - t) * (1 - t) * by;
  }
  return solid.withControlPoints(points);
}

/// Points of the surface with normals.
struct Samples {
  std::vector<Vector3d> points, normals;

  explicit Samples(const Solid& solid, double size) {
    modeling::MeshSettings settings;
    settings.engine = modeling::Engine::kTriangles;
    settings.edgeLength = size / 8;
    const modeling::SurfaceMesh mesh = modeling::mesh(modeling::Body(solid), settings);
    for (const auto& t : mesh.triangles) {
      const Vector3d &a = mesh.positions[t[0]], &b = mesh.positions[t[1]],
                     &c = mesh.positions[t[2]];
      points.push_back((a + b + c) / 3);
      normals.push_back((b - a).cross(c - a).normalized());
    }
  }
};

struct NamedRegion {
  std::string name;
  Region where;
  std::vector<bool> holds;  ///< per sample
};

NamedRegion randomSupport(Random& random, const Solid& solid, const Samples& samples, double size) {
  const int kind = random.below(4);
  NamedRegion support;
  if (kind == 0) {
    // A patch: the sharp edges of boxes, cylinders and cones are borders, too.
    const auto patch =
        static_cast<std::size_t>(random.below(static_cast<int>(solid.patches().size())));
    support = {"patch", Region::ofPatches({solid.patches()[patch].name}), {}};
    const modeling::SurfaceEvaluator surface(solid);
    const auto [uLow, uHigh] = surface.range(static_cast<int>(patch), 0);
    const auto [vLow, vHigh] = surface.range(static_cast<int>(patch), 1);
    std::vector<Vector3d> onPatch;
    for (int i = 0; i <= 6; ++i)
      for (int k = 0; k <= 6; ++k)
        onPatch.push_back(surface.position(static_cast<int>(patch), uLow + (uHigh - uLow) * i / 6,
                                           vLow + (vHigh - vLow) * k / 6));
    for (const Vector3d& x : samples.points) {
      double nearest = size;
      for (const Vector3d& y : onPatch) nearest = std::min(nearest, (x - y).norm());
      support.holds.push_back(nearest < size / 8);
    }
    return support;
  }
  if (kind == 1) {
    const auto at = static_cast<std::size_t>(random.below(static_cast<int>(samples.points.size())));
    const double radius = size * random.between(0.3, 0.6);
    support = {"painted", {{modeling::Stroke{{samples.points[at]}, radius}}}, {}};
    for (const Vector3d& x : samples.points)
      support.holds.push_back((x - samples.points[at]).norm() < radius);
    return support;
  }
  const Vector3d normal = random.direction();
  std::vector<double> heights;
  for (const Vector3d& x : samples.points) heights.push_back(normal.dot(x));
  const auto [least, most] = std::minmax_element(heights.begin(), heights.end());
  const double below = *least + random.between(0.12, 0.4) * (*most - *least);
  support = {"half space", Region::below(normal, below), {}};
  for (const double height : heights) support.holds.push_back(height < below);
  return support;
}

}  // namespace

RandomCase randomCase(std::uint64_t number) {
  Random random(number);
  NamedShape shape = randomShape(random);
  if (random.below(3) > 0) shape.solid = bent(random, shape.solid);
  if (random.below(3) == 0) shape.solid = dented(random, shape.solid);
  const auto [low, high] = modeling::boundingBox(modeling::Body(shape.solid));
  const double size = (high - low).norm() / 2;
  const Samples samples(shape.solid, size);
  const NamedRegion support = randomSupport(random, shape.solid, samples, size);

  RandomCase result;
  result.shape = shape.name;
  result.support = support.name;
  modeling::Project& project = result.project;
  project.name = "case " + std::to_string(number);
  project.material.youngsModulus = 0.1;
  project.material.poissonRatio = random.between(0.15, 0.495);
  project.body = shape.solid;
  project.supports.push_back({"base", modeling::Support::Kind::kFixed, support.where, {0, 0, 0}});

  // A place away from the support, where there is one.
  std::vector<std::size_t> places;
  for (double distance = 0.5; places.empty() && distance > 0.1; distance *= 0.8)
    for (std::size_t s = 0; s < samples.points.size(); ++s) {
      double nearest = 2 * size;
      for (std::size_t h = 0; h < samples.points.size(); ++h)
        if (support.holds[h])
          nearest = std::min(nearest, (samples.points[h] - samples.points[s]).norm());
      if (!support.holds[s] && nearest > distance * size) places.push_back(s);
    }
  if (places.empty()) throw modeling::ModelingError(project.name + ": the support is everywhere");
  const std::size_t place =
      places[static_cast<std::size_t>(random.below(static_cast<int>(places.size())))];
  const Vector3d at = samples.points[place];
  const Vector3d inward = -samples.normals[place];
  const Vector3d aside = inward.cross(random.direction());
  const double radius = size * random.between(0.15, 0.35);
  const int kind = random.below(5);
  using modeling::TouchKind;
  const auto touch = [&](const char* name, TouchKind of, const Vector3d& vector, double width) {
    result.action = name;
    project.touches.push_back({name, at, of, vector, width});
  };
  const double depth = size * random.between(0.02, 0.05);
  if (kind <= 1)
    touch("grab", TouchKind::kGrab, depth * inward + depth * random.between(0, 0.7) * aside,
          radius);
  else if (kind == 2)
    touch("force", TouchKind::kForce, 0.02 * radius * radius * (inward + 0.5 * aside), radius);
  else if (kind == 3)
    touch("ball", TouchKind::kBall, depth * inward, size * random.between(0.4, 0.8));
  else {
    result.action = "bump";
    project.loads.push_back({"bump", modeling::Bump{at, radius, 0.002, inward}});
  }
  return result;
}

}  // namespace palpa::bench
