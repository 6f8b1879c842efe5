#pragma once

#include <memory>
#include <optional>

#include "bem/contact/contact_simulation.h"
#include "bem/spline/spline_contact_surface.h"
#include "bem/triangle/triangle_contact_surface.h"
#include "modeling/solid/solid.h"

namespace palpa::bem::test {

/// A body without loads that can be touched, by either discretisation.
class TouchedBody {
 public:
  virtual ~TouchedBody() = default;

  const ContactSurface& surface() const { return *surface_; }
  const std::shared_ptr<const ReferenceProblem>& problem() const { return problem_; }
  GreensColumns& columns() { return *columns_; }
  const BoundaryField& base() const { return base_; }

  ContactSimulation simulation() const { return {*surface_, *columns_, base_, material_}; }
  /// Computes the columns that are missing and lets tools slide into their places.
  void settle(ContactSimulation& simulation);
  void computeAll();

 protected:
  void finish(std::shared_ptr<const ReferenceProblem> problem,
              std::unique_ptr<ContactSurface> surface, const Material& material);

 private:
  std::shared_ptr<const ReferenceProblem> problem_;
  std::unique_ptr<ContactSurface> surface_;
  std::unique_ptr<GreensColumns> columns_;
  BoundaryField base_;
  Material material_;
};

/// Height z in mm below which a body is fixed; empty: its lowest patch is fixed.
using FixedBelow = std::optional<double>;

struct SplineTouched : TouchedBody {
  SplineSurface splines;
  SplineTractions tractions;
  BoundaryMesh mesh;
  TractionSlots meshSlots;
  std::unique_ptr<SplineMesh> onMesh;
  const SplineContactSurface* contacts;

  /// `edgeLength`: of the mesh that names places, mm.
  SplineTouched(const modeling::Solid& solid, FixedBelow fixedBelow, const Material& material,
                double edgeLength, Precision precision = Precision::kDouble);
};

/// Fixed where triangles have tag 1.
struct TriangleTouched : TouchedBody {
  BoundaryMesh mesh;
  TractionSlots slots;

  TriangleTouched(BoundaryMesh made, const Material& material,
                  Precision precision = Precision::kAutomatic);
};

/// Mesh of the solid, fitted to the fixed part, which has the tag 1, and refined `levels` times at
/// its border and at sharp edges.
BoundaryMesh fittedMesh(const modeling::Solid& solid, FixedBelow fixedBelow, double edgeLength,
                        int levels);

}  // namespace palpa::bem::test
