#pragma once

#include <memory>
#include <vector>

#include "app/core/results/drawn_body.h"
#include "bem/problem/interior_evaluator.h"
#include "modeling/mesh/plane_section.h"

namespace palpa::app {

/// Section of a body at rest by a plane, as a mesh whose outline lies on the drawn surface. The
/// part on the side to which the plane's normal points is taken away. Independent of the solution:
/// fields are given as one state per interior point and one value per point of the drawn surface.
/// Immutable.
class BodySection {
 public:
  /// Largest edges are `coarseness` times kEdge times the diagonal of the body.
  static constexpr double kEdge = 1 / 40.0;

  /// `coarseness` >= 1. Throws Cancelled.
  BodySection(std::shared_ptr<const DrawnBody> body, const modeling::Plane& plane,
              const Job& job = {}, double coarseness = 1);

  const DrawnBody& body() const { return *body_; }
  const modeling::Plane& plane() const { return plane_; }
  const modeling::PlaneSection& mesh() const { return mesh_; }
  bool isEmpty() const { return mesh_.triangles.empty(); }
  /// Signed distances of the points of the drawn surface from the plane, mm.
  const std::vector<double>& distances() const { return distances_; }
  /// The section in a deformed body, one entry per point of mesh().
  struct Shape {
    std::vector<Eigen::Vector3d> positions;  ///< mm
    std::vector<Eigen::Vector3d> normals;    ///< unit
  };
  /// The section displaced by `scale` times one displacement per point, mm.
  Shape deformed(const std::vector<Eigen::Vector3d>& displacements, double scale) const;
  /// The points that are not on the outline: the last ones of the mesh.
  std::vector<Eigen::Vector3d> interiorPoints() const;

  /// Values at the outline, from one value per point of the drawn surface.
  template <class Value>
  std::vector<Value> onOutline(const std::vector<Value>& ofSurface) const {
    std::vector<Value> values;
    values.reserve(mesh_.outline.size());
    for (const auto& point : mesh_.outline) {
      Value sum = point.weights[0] * ofSurface[static_cast<std::size_t>(point.vertices[0])];
      for (std::size_t k = 1; k < 4; ++k)
        sum += point.weights[k] * ofSurface[static_cast<std::size_t>(point.vertices[k])];
      values.push_back(sum);
    }
    return values;
  }

 private:
  std::shared_ptr<const DrawnBody> body_;
  modeling::Plane plane_;
  modeling::PlaneSection mesh_;
  std::vector<double> distances_;
};

/// The surface solution on a section: surface states at the outline, Somigliana's identities
/// inside. Immutable; const use from several threads is safe.
class SectionField {
 public:
  /// Throws Cancelled.
  explicit SectionField(std::shared_ptr<const BodySection> section, const Job& job = {});

  const BodySection& section() const { return *section_; }
  const std::shared_ptr<const BodySection>& sharedSection() const { return section_; }
  /// One state per point of the section's mesh, of a field of the model. Takes about 50 to 300 µs
  /// per interior point and core. Throws Cancelled.
  std::vector<bem::InteriorState> states(const bem::BoundaryField& field, const Job& job) const;

 private:
  std::shared_ptr<const BodySection> section_;
  std::unique_ptr<bem::InteriorEvaluator> inside_;
};

/// The number that colours show at a point of a section, mm or MPa. kNormalTraction: the normal
/// stress across the plane. Only for quantities of a field: the others have no values inside the
/// body.
double sectionValue(SurfaceQuantity quantity, const bem::InteriorState& state,
                    const modeling::Plane& plane);
/// True if sectionValue() is defined.
constexpr bool hasSectionValues(SurfaceQuantity quantity) {
  return isOfField(quantity);
}

}  // namespace palpa::app
