#include "study_block.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/core/setup/to_spline_surface.h"
#include "modeling/shapes/make_primitive.h"
#include "modeling/solid/knot_operations.h"

namespace palpa::bem::test {

using Eigen::Vector3d;

namespace {

constexpr double kOnFace = 1e-6;  ///< mm

bool isFixed(const Vector3d& x) {
  return x.z() < kOnFace;
}

/// Inner knots from 0 to 1, denser at 0 and, with `atBothEnds`, also at 1.
std::vector<double> gradedFractions(int spans, double grading, bool atBothEnds) {
  std::vector<double> fractions;
  for (int i = 1; i < spans; ++i) {
    const double s = static_cast<double>(i) / spans;
    if (!atBothEnds)
      fractions.push_back(std::pow(s, grading));
    else if (s <= 0.5)
      fractions.push_back(std::pow(2 * s, grading) / 2);
    else
      fractions.push_back(1 - std::pow(2 - 2 * s, grading) / 2);
  }
  return fractions;
}

/// Inserts knots along an axis of a box, at fractions of its edge in increasing coordinates.
modeling::Solid withKnotsAlong(modeling::Solid solid, int axis,
                               const std::vector<double>& fractions) {
  for (int p = 0; p < static_cast<int>(solid.patches().size()); ++p)
    for (int d = 0; d < 2; ++d) {
      const modeling::Patch& patch = solid.patches()[p];
      const auto& points = solid.controlPoints();
      const int first = patch.net.front().front();
      const int last = d == 0 ? patch.net.back().front() : patch.net.front().back();
      const Vector3d edge = points[last] - points[first];
      if (std::abs(edge[axis]) < 0.5 * edge.norm()) continue;
      const auto [lower, upper] = patch.range(d);
      for (const double fraction : fractions)
        solid = modeling::insertKnot(
            solid, {p, d}, lower + (edge[axis] > 0 ? fraction : 1 - fraction) * (upper - lower));
      return solid;
    }
  throw std::invalid_argument("the block has no edge along an axis");
}

/// Face of a solved block: its patch as an affine map.
struct Face {
  int patch;
  Vector3d corner, along[2];
  std::array<double, 2> lower, upper;
};

int spanOf(const BsplineBasis& basis, double t) {
  const auto& spans = basis.spans();
  int k = 0;
  while (k + 1 < static_cast<int>(spans.size()) && t >= spans[k].upper) ++k;
  return k;
}

}  // namespace

ExactField ClampedBlock::given() const {
  const auto traction = [*this](const Vector3d& x) {
    const double a = 2 * x.x() / size.x(), b = 2 * x.y() / size.y();
    const double bump = (1 - a * a) * (1 - a * a) * (1 - b * b) * (1 - b * b);
    return Vector3d((x.z() > size.z() - kOnFace ? bump : 0.0) * peak);
  };
  return {[](const Vector3d&) { return Vector3d::Zero().eval(); },
          [traction](const Vector3d& x) {
            return Eigen::Matrix3d(traction(x) * Vector3d::UnitZ().transpose());
          }};
}

Vector3d ClampedBlock::load() const {
  const double mean = 8.0 / 15;  // of (1 - t^2)^2 from -1 to 1
  return mean * mean * size.x() * size.y() * peak;
}

modeling::Solid ClampedBlock::solid(int degree, int spans, double grading) const {
  modeling::Solid block = modeling::makePrimitive({modeling::BoxShape{size}, degree, degree + 1});
  for (int axis = 0; axis < 3; ++axis)
    block = withKnotsAlong(std::move(block), axis, gradedFractions(spans, grading, axis < 2));
  return block;
}

SplineSurface ClampedBlock::splines(int degree, int spans, double grading) const {
  return fixedWhere(app::splineSurfaceOf(solid(degree, spans, grading)), isFixed);
}

std::unique_ptr<SplineBody> ClampedBlock::solve(int degree, int spans, double grading) const {
  return solveSplines(splines(degree, spans, grading), material, given());
}

std::unique_ptr<SolvedBody> ClampedBlock::solve(double edgeLength, bool isRefined) const {
  return solveTriangles(
      triangleMesh(solid(3, 1, 1), edgeLength, {{"fixed", modeling::Region::ofPatches({"bottom"})}},
                   isRefined),
      isFixed, material, given());
}

ExactField fieldOf(std::shared_ptr<const SplineBody> block) {
  const SplineSurface& surface = block->surface;
  std::vector<Face> faces;
  for (int p = 0; p < static_cast<int>(surface.patches().size()); ++p) {
    const SplinePatch& patch = surface.patches()[p];
    const int columns = patch.basis[0].count(), rows = patch.basis[1].count();
    const auto point = [&](int i, int j) {
      return surface.controlPoints()[patch.net[i + j * columns]];
    };
    Face face{p, point(0, 0), {point(columns - 1, 0), point(0, rows - 1)}, {}, {}};
    for (int d = 0; d < 2; ++d) {
      face.along[d] -= face.corner;
      face.lower[d] = patch.basis[d].spans().front().lower;
      face.upper[d] = patch.basis[d].spans().back().upper;
    }
    faces.push_back(face);
  }
  const auto displacement = [block, faces](const Vector3d& x) -> Vector3d {
    for (const Face& face : faces) {
      const Vector3d from = x - face.corner;
      if (std::abs(from.dot(face.along[0].cross(face.along[1]).normalized())) > kOnFace) continue;
      std::array<double, 2> at;
      std::array<int, 2> span;
      for (int d = 0; d < 2; ++d) {
        const double share =
            std::clamp(from.dot(face.along[d]) / face.along[d].squaredNorm(), 0.0, 1.0);
        at[d] = face.lower[d] + share * (face.upper[d] - face.lower[d]);
        span[d] = spanOf(block->surface.patches()[face.patch].basis[d], at[d]);
      }
      const int element = block->surface.elementsAt(face.patch, span[0], span[1]).front();
      return block->displacement({element, at[0], at[1]});
    }
    throw std::invalid_argument("the place is not on the block");
  };
  return {displacement, [](const Vector3d&) { return Eigen::Matrix3d::Zero().eval(); }};
}

}  // namespace palpa::bem::test
