#include "app/core/results/deformed_solid.h"

#include "bem/spline/spline_discretisation.h"
#include "bem/spline/spline_gluing.h"
#include "modeling/error.h"

namespace palpa::app {

modeling::Solid deformedSolid(const TouchModel& model, const bem::BoundaryField& field) {
  const BoundarySetup& setup = model.setup();
  if (!setup.splines)
    throw modeling::ModelingError(
        "the deformed solid needs the spline engine; this model is one of triangles: export its "
        "triangles, or choose the engine \"splines\"");
  const modeling::Solid& refined = *setup.refinedSolid;
  const Eigen::VectorXd u = bem::gluedCoefficients(setup.splines->surface(), field.u.col(0));
  std::vector<Eigen::Vector3d> points = refined.controlPoints();
  for (std::size_t k = 0; k < points.size(); ++k)
    points[k] += u.segment<3>(3 * static_cast<Eigen::Index>(k));
  return refined.withControlPoints(std::move(points));
}

modeling::Project deformedProject(const modeling::Project& project, const TouchModel& model,
                                  const bem::BoundaryField& field) {
  modeling::Project deformed;
  deformed.name = project.name + " (deformed)";
  deformed.material = project.material;
  deformed.body = deformedSolid(model, field);
  deformed.mesh = project.mesh;
  return deformed;
}

}  // namespace palpa::app
