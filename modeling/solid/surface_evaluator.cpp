#include "modeling/solid/surface_evaluator.h"

#include <Eigen/Geometry>
#include <Standard_Failure.hxx>
#include <algorithm>

#include "modeling/error.h"
#include "modeling/solid/opencascade_surface.h"

namespace palpa::modeling {
namespace {

Eigen::Vector3d toEigen(const gp_XYZ& v) {
  return {v.X(), v.Y(), v.Z()};
}

}  // namespace

struct SurfaceEvaluator::Surfaces {
  struct Entry {
    Handle(Geom_BSplineSurface) surface;
    std::array<std::vector<double>, 2> spans;
    std::array<int, 2> degree;
  };
  std::vector<Entry> entries;
};

SurfaceEvaluator::SurfaceEvaluator(const Solid& solid)
    : SurfaceEvaluator(solid.controlPoints(), solid.patches()) {}

SurfaceEvaluator::SurfaceEvaluator(const std::vector<Eigen::Vector3d>& points,
                                   const std::vector<Patch>& patches) {
  auto surfaces = std::make_shared<Surfaces>();
  for (const Patch& patch : patches) {
    try {
      surfaces->entries.push_back({makeSurface(points, patch),
                                   {distinct(patch.knots[0]), distinct(patch.knots[1])},
                                   patch.degree});
    } catch (const Standard_Failure& failure) {
      throw ModelingError("patch \"" + patch.name +
                          "\": OpenCASCADE refuses it as a surface: " + failure.GetMessageString());
    }
  }
  surfaces_ = std::move(surfaces);
}

int SurfaceEvaluator::patchCount() const {
  return static_cast<int>(surfaces_->entries.size());
}

std::array<double, 2> SurfaceEvaluator::range(int patch, int direction) const {
  const auto& spans = surfaces_->entries[patch].spans[direction];
  return {spans.front(), spans.back()};
}

const std::vector<double>& SurfaceEvaluator::spans(int patch, int direction) const {
  return surfaces_->entries[patch].spans[direction];
}

int SurfaceEvaluator::degree(int patch, int direction) const {
  return surfaces_->entries[patch].degree[direction];
}

Eigen::Vector3d SurfaceEvaluator::position(int patch, double u, double v) const {
  const auto& entry = surfaces_->entries[patch];
  gp_Pnt point;
  entry.surface->D0(std::clamp(u, entry.spans[0].front(), entry.spans[0].back()),
                    std::clamp(v, entry.spans[1].front(), entry.spans[1].back()), point);
  return toEigen(point.XYZ());
}

SurfacePoint SurfaceEvaluator::evaluate(int patch, double u, double v) const {
  const auto& entry = surfaces_->entries[patch];
  gp_Pnt point;
  gp_Vec du, dv;
  entry.surface->D1(std::clamp(u, entry.spans[0].front(), entry.spans[0].back()),
                    std::clamp(v, entry.spans[1].front(), entry.spans[1].back()), point, du, dv);
  return {toEigen(point.XYZ()), toEigen(du.XYZ()), toEigen(dv.XYZ())};
}

Eigen::Vector3d SurfaceEvaluator::normal(int patch, double u, double v) const {
  constexpr double kParallel = 1e-2;  // sine of the angle below which du × dv is unreliable
  constexpr double kInside = 0.02;    // fraction of the way to the patch's centre
  const auto [uMin, uMax] = range(patch, 0);
  const auto [vMin, vMax] = range(patch, 1);
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  for (double inside : {0.0, kInside}) {
    const SurfacePoint p = evaluate(patch, u + inside * (0.5 * (uMin + uMax) - u),
                                    v + inside * (0.5 * (vMin + vMax) - v));
    const Eigen::Vector3d cross = p.du.cross(p.dv);
    const double length = cross.norm();
    if (length > 0.0) best = cross / length;
    if (length > kParallel * p.du.norm() * p.dv.norm()) break;
  }
  return best;
}

}  // namespace palpa::modeling
