#include "app/view/layers/arrow_mesh.h"

#include <vtkNew.h>
#include <vtkPointData.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/view/layers/vtk_arrays.h"

namespace palpa::view {
namespace {

constexpr int kSides = 24;
constexpr int kTurnPieces = 24;
constexpr double kTurnAngle = 1.5 * std::numbers::pi;  // of the curved arrow with its head

/// A circle of the surface: its plane, its radius, and the direction of the surface there.
struct Ring {
  Eigen::Vector3d centre, axis, first, second;  ///< the last three right-handed, unit
  double radius, normalAlong, normalAcross;
};

/// Smooth part of the surface between two rings; a ring of radius 0 is a point.
using Strip = std::array<Ring, 2>;

/// Which triangles a strip needs.
char kindOf(const Strip& strip) {
  return static_cast<char>((strip[0].radius == 0 ? 1 : 0) + (strip[1].radius == 0 ? 2 : 0));
}

/// Cylinder with a cone as head, or without head if its length is 0.
void addStraight(const SolidArrow& arrow, std::vector<Strip>& strips) {
  const Eigen::Vector3d vector = arrow.tip - arrow.tail;
  const Eigen::Vector3d axis = vector.normalized();
  const Eigen::Vector3d first = axis.unitOrthogonal();
  const Eigen::Vector3d second = axis.cross(first);
  const auto ring = [&](double along, double radius, double normalAlong, double normalAcross) {
    return Ring{arrow.tail + along * axis, axis, first, second, radius, normalAlong, normalAcross};
  };
  const bool hasHead = arrow.turnRadius == 0;
  const double length = vector.norm();
  const double neck = hasHead ? length - arrow.headLength : length;
  strips.push_back({ring(0, 0, -1, 0), ring(0, arrow.shaftRadius, -1, 0)});
  strips.push_back({ring(0, arrow.shaftRadius, 0, 1), ring(neck, arrow.shaftRadius, 0, 1)});
  if (!hasHead) {
    strips.push_back({ring(neck, arrow.shaftRadius, 1, 0), ring(neck, 0, 1, 0)});
    return;
  }
  const double slant = std::hypot(arrow.headLength, arrow.headRadius);
  const double up = arrow.headRadius / slant, out = arrow.headLength / slant;
  strips.push_back({ring(neck, arrow.shaftRadius, -1, 0), ring(neck, arrow.headRadius, -1, 0)});
  strips.push_back({ring(neck, arrow.headRadius, up, out), ring(length, 0, up, out)});
}

/// Part of a torus about the axis with a cone as head, right-handed.
void addCurved(const SolidArrow& arrow, std::vector<Strip>& strips) {
  const Eigen::Vector3d axis = (arrow.tip - arrow.tail).normalized();
  const Eigen::Vector3d first = axis.unitOrthogonal();
  const Eigen::Vector3d second = axis.cross(first);
  const Eigen::Vector3d centre = arrow.tail + arrow.turnAt * (arrow.tip - arrow.tail);
  const auto ring = [&](double angle, double radius, double normalAlong, double normalAcross) {
    const Eigen::Vector3d out = std::cos(angle) * first + std::sin(angle) * second;
    const Eigen::Vector3d along = axis.cross(out);
    return Ring{centre + arrow.turnRadius * out,
                along,
                out,
                along.cross(out),
                radius,
                normalAlong,
                normalAcross};
  };
  const double neck = kTurnAngle - arrow.headLength / arrow.turnRadius;
  strips.push_back({ring(0, 0, -1, 0), ring(0, arrow.shaftRadius, -1, 0)});
  for (int i = 0; i < kTurnPieces; ++i)
    strips.push_back({ring(neck * i / kTurnPieces, arrow.shaftRadius, 0, 1),
                      ring(neck * (i + 1) / kTurnPieces, arrow.shaftRadius, 0, 1)});
  strips.push_back({ring(neck, arrow.shaftRadius, -1, 0), ring(neck, arrow.headRadius, -1, 0)});
  // The cone leaves the circle along its tangent.
  const Ring base = ring(neck, arrow.headRadius, 0, 0);
  Ring tip = base;
  tip.centre += arrow.headLength * base.axis;
  tip.radius = 0;
  const double slant = std::hypot(arrow.headLength, arrow.headRadius);
  Strip cone{base, tip};
  for (Ring& end : cone) {
    end.normalAlong = arrow.headRadius / slant;
    end.normalAcross = arrow.headLength / slant;
  }
  strips.push_back(cone);
}

vtkSmartPointer<vtkCellArray> triangles(const std::vector<char>& strips) {
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (std::size_t strip = 0; strip < strips.size(); ++strip) {
    const auto first = static_cast<vtkIdType>(2 * strip) * kSides;
    for (int side = 0; side < kSides; ++side) {
      const vtkIdType a = first + side;
      const vtkIdType b = first + (side + 1) % kSides;
      const vtkIdType c = a + kSides;
      const vtkIdType d = b + kSides;
      if ((strips[strip] & 1) == 0) cells->InsertNextCell({a, b, d});
      if ((strips[strip] & 2) == 0) cells->InsertNextCell({a, d, c});
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

SolidArrow SolidArrow::turning(const Eigen::Vector3d& tail, const Eigen::Vector3d& tip,
                               double turnAt, double diagonal, const Colour& colour) {
  SolidArrow arrow = of(tail, tip, diagonal, colour);
  arrow.turnRadius = std::min(kTurnRadius * diagonal, kMaxTurnShare * (tip - tail).norm());
  arrow.turnAt = turnAt;
  return arrow;
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
  std::vector<std::array<unsigned char, 3>> colours;
  std::vector<Strip> strips;
  std::vector<char> kinds;
  for (const SolidArrow& arrow : arrows) {
    strips.clear();
    addStraight(arrow, strips);
    if (arrow.turnRadius > 0) addCurved(arrow, strips);
    std::array<unsigned char, 3> colour{};
    for (std::size_t k = 0; k < 3; ++k)
      colour[k] = static_cast<unsigned char>(std::lround(255 * arrow.colour[k]));
    for (const Strip& strip : strips) {
      kinds.push_back(kindOf(strip));
      for (const Ring& ring : strip) {
        for (int side = 0; side < kSides; ++side) {
          const double angle = 2 * std::numbers::pi * side / kSides;
          const Eigen::Vector3d across =
              std::cos(angle) * ring.first + std::sin(angle) * ring.second;
          places.push_back(ring.centre + ring.radius * across);
          normals.push_back(ring.normalAlong * ring.axis + ring.normalAcross * across);
        }
      }
    }
    colours.resize(places.size(), colour);
  }
  colours_->SetNumberOfTuples(static_cast<vtkIdType>(colours.size()));
  for (std::size_t i = 0; i < colours.size(); ++i)
    colours_->SetTypedTuple(static_cast<vtkIdType>(i), colours[i].data());
  assign(places, points_);
  assign(normals, normals_);
  colours_->Modified();
  if (kinds != strips_) surface_->SetPolys(triangles(kinds));
  strips_ = std::move(kinds);
  surface_->Modified();
}

}  // namespace palpa::view
