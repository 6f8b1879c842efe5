#include "app/cli/drawn_surface.h"

#include <algorithm>

#include "app/core/results/drawn_body.h"
#include "app/core/results/stiffness_colours.h"

namespace palpa::cli {
namespace {

using view::ScalarField;

ScalarField describe(app::SurfaceQuantity kind, std::vector<double> values) {
  ScalarField field;
  field.unit = kind == app::SurfaceQuantity::kDisplacement ? "mm" : "MPa";
  field.name = kind == app::SurfaceQuantity::kDisplacement     ? "Displacement |u|"
               : kind == app::SurfaceQuantity::kNormalTraction ? "Normal traction"
                                                               : "von Mises stress";
  if (kind == app::SurfaceQuantity::kNormalTraction)
    field.colours = ScalarField::Colours::kDiverging;
  // Zero is where the body is held: colours start there.
  const double largest = *std::max_element(values.begin(), values.end());
  if (kind == app::SurfaceQuantity::kDisplacement && largest > 0) field.range = {0.0, largest};
  field.values = std::move(values);
  return field;
}

ScalarField describeStiffness(const app::TouchModel& model, const app::DrawnBody& drawn,
                              const std::vector<double>& compliances) {
  const app::BoundarySetup& setup = model.setup();
  const auto colours = app::StiffnessColours::of(setup.mesh(), setup.meshSlots(), compliances);
  ScalarField field;
  field.name = "Stiffness";
  field.unit = "N/mm";
  field.values = drawn.stiffnesses(compliances);
  colours.cap(field.values);
  field.range = colours.range;
  field.isLogarithmic = true;
  field.isCapped = colours.isCapped;
  return field;
}

}  // namespace

void addSurface(const std::shared_ptr<const app::TouchModel>& model, const app::TouchState& state,
                const SceneOptions& options, view::SurfaceScene& scene) {
  const app::DrawnBody drawn(model);
  const Eigen::VectorXd& u = state.field.u.col(0);
  app::DrawnBody::Shape shape;
  drawn.deform(u, options.displacementScale, shape);
  scene.positions = drawn.mesh().positions;
  scene.triangles = drawn.mesh().triangles;
  scene.meshLines = drawn.mesh().edgeLines;
  scene.displacements = drawn.displacements(u);
  scene.displacementScale = options.displacementScale;
  scene.normals = std::move(shape.normals);
  if (options.field == app::SurfaceQuantity::kStiffness)
    scene.field = describeStiffness(*model, drawn, options.compliances);
  else if (options.field != app::SurfaceQuantity::kNone)
    scene.field = describe(options.field, drawn.values(options.field, state.field));
  for (std::size_t t = 0; t < drawn.isHeld().size(); ++t)
    if (drawn.isHeld()[t]) scene.supports.push_back(static_cast<int>(t));
}

}  // namespace palpa::cli
