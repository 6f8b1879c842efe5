#include "app/core/results/surface_correspondence.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "base/box_tree.h"
#include "bem/model/surface_point.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

constexpr double kReachShare = 0.05;  // of the diagonal of the box
constexpr double kMinCosine = 0.5;    // between normals of partners
/// Points are moved by this part of their way to the middle of the triangles around them, so that
/// at a sharp edge they meet the face that they belong to.
constexpr double kInwards = 1e-3;
constexpr std::size_t kCheckEvery = 1000;

const Vector3d& corner(const modeling::DisplayMesh& mesh, std::size_t triangle, std::size_t k) {
  return mesh.positions[static_cast<std::size_t>(mesh.triangles[triangle][k])];
}

/// Mean of the triangles' middles around each point.
std::vector<Vector3d> middlesAround(const modeling::DisplayMesh& mesh) {
  std::vector<Vector3d> sums(mesh.positions.size(), Vector3d::Zero());
  std::vector<int> counts(sums.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3d middle = (corner(mesh, t, 0) + corner(mesh, t, 1) + corner(mesh, t, 2)) / 3;
    for (const int point : mesh.triangles[t]) {
      sums[static_cast<std::size_t>(point)] += middle;
      ++counts[static_cast<std::size_t>(point)];
    }
  }
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] /= std::max(counts[k], 1);
  return sums;
}

}  // namespace

SurfaceCorrespondence::SurfaceCorrespondence(const DrawnBody& from, const DrawnBody& to,
                                             const Job& job) {
  const modeling::DisplayMesh &here = from.mesh(), &there = to.mesh();
  std::vector<BoxTree::Box> boxes;
  std::vector<Vector3d> centres, normals;
  for (std::size_t t = 0; t < there.triangles.size(); ++t) {
    BoxTree::Box box;
    for (std::size_t k = 0; k < 3; ++k) box.extend(corner(there, t, k));
    boxes.push_back(box);
    centres.push_back(box.center());
    normals.push_back((corner(there, t, 1) - corner(there, t, 0))
                          .cross(corner(there, t, 2) - corner(there, t, 0))
                          .stableNormalized());
  }
  const BoxTree tree(boxes, centres);
  bem::BoundaryMesh surface;
  surface.nodes = there.positions;
  surface.triangles = there.triangles;
  BoxTree::Box whole;
  for (const Vector3d& position : here.positions) whole.extend(position);
  reach_ = kReachShare * whole.diagonal().norm();

  const std::vector<Vector3d> middles = middlesAround(here);
  partners_.resize(here.positions.size());
  for (std::size_t k = 0; k < partners_.size(); ++k) {
    if (k % kCheckEvery == 0) job.throwIfCancelled();
    const Vector3d x = here.positions[k] + kInwards * (middles[k] - here.positions[k]);
    double nearest = reach_;
    tree.visitNear(x, reach_, [&](int triangle, double within) {
      const auto t = static_cast<std::size_t>(triangle);
      if (normals[t].dot(here.normals[k]) < kMinCosine) return within;
      const bem::SurfacePoint found = bem::nearestOnTriangle(surface, triangle, x);
      if (found.distance >= within) return within;
      partners_[k] = {there.triangles[t], found.weights};
      nearest = found.distance;
      return nearest;
    });
    if (partners_[k].points[0] >= 0) farthest_ = std::max(farthest_, nearest);
  }

  double paired = 0, all = 0;
  for (std::size_t t = 0; t < here.triangles.size(); ++t) {
    const double area = (corner(here, t, 1) - corner(here, t, 0))
                            .cross(corner(here, t, 2) - corner(here, t, 0))
                            .norm();
    all += area;
    const auto& points = here.triangles[t];
    if (std::all_of(points.begin(), points.end(), [this](int point) {
          return partners_[static_cast<std::size_t>(point)].points[0] >= 0;
        }))
      paired += area;
  }
  share_ = all > 0 ? paired / all : 0;
}

std::vector<double> SurfaceCorrespondence::carried(const std::vector<double>& ofTo) const {
  std::vector<double> values;
  values.reserve(partners_.size());
  for (const Partner& partner : partners_) {
    double value = partner.points[0] < 0 ? std::numeric_limits<double>::quiet_NaN() : 0;
    for (std::size_t k = 0; k < 3 && partner.points[0] >= 0; ++k)
      value += partner.weights[static_cast<Eigen::Index>(k)] *
               ofTo[static_cast<std::size_t>(partner.points[k])];
    values.push_back(value);
  }
  return values;
}

}  // namespace palpa::app
