#include "modeling/exchange/chord_gaps.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>

namespace palpa::modeling {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kParallel = 1e-6;  // sine of the angle between planes that count as one
constexpr double kFlat = 1e-9;      // of a triangle's extent: a smaller gap is rounding
// Square of the sine of the smallest angle at which a surface may slide along a plane or along
// another surface to close its gap: 30°. At smaller angles, as where a fillet ends in a plane, the
// vertex would have to go much farther than the gap.
constexpr double kSlide = 0.25;

/// The triangles of one face at one vertex.
struct FaceFan {
  int face = 0;
  Vector3d normal = Vector3d::Zero();  // sum of the triangles' normals times areas
  double area = 0.0;
  double gap = 0.0;  // sum over the triangles, times areas
  bool isFlat = true;
};

/// Removes the directions out of a plane from `free`, the projection on the directions in which
/// the vertex may move.
void keepInPlane(const Vector3d& normal, Matrix3d& free) {
  const Vector3d out = free * normal;
  if (out.norm() > kParallel) free -= out * out.transpose() / out.squaredNorm();
}

/// The shortest displacement that closes the mean gaps of all curved faces, as far as the flat ones
/// allow it.
Vector3d displacement(const std::vector<FaceFan>& fans) {
  Matrix3d free = Matrix3d::Identity();
  for (const FaceFan& fan : fans)
    if (fan.isFlat) keepInPlane(fan.normal.normalized(), free);
  Matrix3d squares = Matrix3d::Zero();
  Vector3d wished = Vector3d::Zero();
  double largest = 0.0;
  for (const FaceFan& fan : fans) {
    if (fan.isFlat) continue;
    const Vector3d direction = free * fan.normal.normalized();
    const double gap = fan.gap / fan.area;
    squares += direction * direction.transpose();
    wished += gap * direction;
    largest = std::max(largest, std::abs(gap));
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(squares);
  Vector3d moved = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vector3d axis = solver.eigenvectors().col(k);
    if (solver.eigenvalues()[k] > kSlide)
      moved += axis * (axis.dot(wished) / solver.eigenvalues()[k]);
  }
  const double limit = 2.0 * largest;
  return moved.norm() > limit ? Vector3d(moved * (limit / moved.norm())) : moved;
}

/// The fans of all vertices.
std::vector<std::vector<FaceFan>> fansOf(const MeshBody::Data& data,
                                         const std::vector<double>& gaps) {
  std::vector<std::vector<FaceFan>> fans(data.positions.size());
  for (std::size_t t = 0; t < data.triangles.size(); ++t) {
    const auto& corners = data.triangles[t];
    const Vector3d& p = data.positions[corners[0]];
    const Vector3d normal =
        0.5 * (data.positions[corners[1]] - p).cross(data.positions[corners[2]] - p);
    const double area = normal.norm();
    if (area <= 0.0) continue;
    for (const int vertex : corners) {
      std::vector<FaceFan>& here = fans[vertex];
      auto fan = std::ranges::find(here, data.faceOfTriangle[t], &FaceFan::face);
      if (fan == here.end()) fan = here.insert(fan, FaceFan{data.faceOfTriangle[t]});
      fan->normal += normal;
      fan->area += area;
      fan->gap += area * gaps[t];
      fan->isFlat &= std::abs(gaps[t]) <= kFlat * std::sqrt(area);
    }
  }
  return fans;
}

}  // namespace

void balanceGaps(MeshBody::Data& data, const std::vector<double>& gaps) {
  const std::vector<std::vector<FaceFan>> fans = fansOf(data, gaps);
  for (std::size_t v = 0; v < fans.size(); ++v)
    if (!std::ranges::all_of(fans[v], &FaceFan::isFlat)) data.positions[v] += displacement(fans[v]);
}

}  // namespace palpa::modeling
