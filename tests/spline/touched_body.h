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

  ContactSimulation simulation() const { return {*surface_, *columns_, base_}; }
  /// Computes the columns that are missing and lets tools slide into their places.
  void settle(ContactSimulation& simulation);
  void computeAll();

 protected:
  void finish(std::shared_ptr<const ReferenceProblem> problem,
              std::unique_ptr<ContactSurface> surface);

 private:
  std::shared_ptr<const ReferenceProblem> problem_;
  std::unique_ptr<ContactSurface> surface_;
  std::unique_ptr<GreensColumns> columns_;
  BoundaryField base_;
};

/// Where a body is fixed: below z = *held; empty: on its lowest patch.
using Held = std::optional<double>;

struct SplineTouched : TouchedBody {
  SplineSurface splines;
  SplineTractions tractions;
  BoundaryMesh mesh;
  TractionSlots meshSlots;
  std::unique_ptr<SplineMesh> onMesh;
  const SplineContactSurface* contacts;

  /// `edgeLength`: of the mesh that names places, mm.
  SplineTouched(const modeling::Solid& solid, Held held, const Material& material,
                double edgeLength, Precision precision = Precision::kDouble);
};

/// Fixed where triangles have tag 1.
struct TriangleTouched : TouchedBody {
  BoundaryMesh mesh;
  TractionSlots slots;

  TriangleTouched(BoundaryMesh made, const Material& material,
                  Precision precision = Precision::kAutomatic);
};

/// A mesh of the solid that is fitted to where it is fixed, with tag 1 there; at that border, and
/// at sharp edges, refined `levels` times.
BoundaryMesh fittedMesh(const modeling::Solid& solid, Held held, double edgeLength, int levels);

}  // namespace palpa::bem::test
