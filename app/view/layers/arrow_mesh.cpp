#include "app/view/layers/arrow_mesh.h"

#include <vtkNew.h>
#include <vtkPointData.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/view/layers/vtk_arrays.h"

namespace palpa::view {
namespace {

constexpr int kSides = 24;
/// The arrow's outline turned about its axis: rings of points, two per smooth strip. Tail, shaft,
/// back of the head, head.
constexpr int kRings = 8;

/// A ring of the outline: place along the axis, radius, and the direction of the surface there.
struct Ring {
  double along, radius, normalAlong, normalAcross;
};

std::array<Ring, kRings> outline(const SolidArrow& arrow, double length) {
  const double neck = length - arrow.headLength;
  const double slant = std::hypot(arrow.headLength, arrow.headRadius);
  const double up = arrow.headRadius / slant;
  const double out = arrow.headLength / slant;
  return {Ring{0, 0, -1, 0},
          {0, arrow.shaftRadius, -1, 0},
          {0, arrow.shaftRadius, 0, 1},
          {neck, arrow.shaftRadius, 0, 1},
          {neck, arrow.shaftRadius, -1, 0},
          {neck, arrow.headRadius, -1, 0},
          {neck, arrow.headRadius, up, out},
          {length, 0, up, out}};
}

vtkSmartPointer<vtkCellArray> triangles(std::size_t arrows) {
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (std::size_t arrow = 0; arrow < arrows; ++arrow) {
    const auto first = static_cast<vtkIdType>(arrow) * kRings * kSides;
    for (int strip = 0; strip < kRings; strip += 2) {
      for (int side = 0; side < kSides; ++side) {
        const int next = (side + 1) % kSides;
        const vtkIdType a = first + strip * kSides + side;
        const vtkIdType b = first + strip * kSides + next;
        const vtkIdType c = a + kSides;
        const vtkIdType d = b + kSides;
        // The first ring and the last are a point each.
        if (strip != 0) cells->InsertNextCell({a, b, d});
        if (strip != kRings - 2) cells->InsertNextCell({a, d, c});
      }
    }
  }
  return cells;
}

}  // namespace

SolidArrow SolidArrow::of(const Eigen::Vector3d& tail, const Eigen::Vector3d& tip, double diagonal,
                          const Colour& colour) {
  const double head = kArrowHeadLength * diagonal;
  const double scale = std::min(1.0, 0.6 * (tip - tail).norm() / head) * diagonal;
  return {tail,  tip, scale * kArrowShaftRadius, scale * kArrowHeadRadius, scale * kArrowHeadLength,
          colour};
}

ArrowMesh::ArrowMesh()
    : points_(makeFloatPoints()),
      normals_(vtkSmartPointer<vtkFloatArray>::New()),
      colours_(vtkSmartPointer<vtkUnsignedCharArray>::New()),
      surface_(vtkSmartPointer<vtkPolyData>::New()) {
  normals_->SetNumberOfComponents(3);
  colours_->SetNumberOfComponents(3);
  surface_->SetPoints(points_);
  surface_->GetPointData()->SetNormals(normals_);
  surface_->GetPointData()->SetScalars(colours_);
}

void ArrowMesh::set(const std::vector<SolidArrow>& arrows) {
  std::vector<Eigen::Vector3d> places, normals;
  places.reserve(arrows.size() * kRings * kSides);
  normals.reserve(places.capacity());
  colours_->SetNumberOfTuples(static_cast<vtkIdType>(places.capacity()));
  vtkIdType point = 0;
  for (const SolidArrow& arrow : arrows) {
    const Eigen::Vector3d vector = arrow.tip - arrow.tail;
    const Eigen::Vector3d axis = vector.normalized();
    const Eigen::Vector3d first = axis.unitOrthogonal();
    const Eigen::Vector3d second = axis.cross(first);
    std::array<unsigned char, 3> colour{};
    for (std::size_t k = 0; k < 3; ++k)
      colour[k] = static_cast<unsigned char>(std::lround(255 * arrow.colour[k]));
    for (const Ring& ring : outline(arrow, vector.norm())) {
      for (int side = 0; side < kSides; ++side) {
        const double angle = 2 * std::numbers::pi * side / kSides;
        const Eigen::Vector3d across = std::cos(angle) * first + std::sin(angle) * second;
        places.push_back(arrow.tail + ring.along * axis + ring.radius * across);
        normals.push_back(ring.normalAlong * axis + ring.normalAcross * across);
        colours_->SetTypedTuple(point++, colour.data());
      }
    }
  }
  assign(places, points_);
  assign(normals, normals_);
  colours_->Modified();
  if (arrows.size() != count_) surface_->SetPolys(triangles(arrows.size()));
  count_ = arrows.size();
  surface_->Modified();
}

}  // namespace palpa::view
