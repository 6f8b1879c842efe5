#include "app/cli/drawn_surface.h"

#include <algorithm>

#include "app/core/results/drawn_body.h"
#include "app/core/results/stiffness_colours.h"

namespace palpa::cli {
namespace {

using view::ScalarField;

ScalarField describe(app::SurfaceQuantity quantity) {
  const app::SurfaceQuantityInfo& info = app::infoOf(quantity);
  ScalarField field;
  field.name = info.label;
  field.unit = info.unit;
  if (info.isSigned) field.colours = ScalarField::Colours::kDiverging;
  field.isLogarithmic = info.isLogarithmic;
  return field;
}

ScalarField fieldOf(app::SurfaceQuantity quantity, std::vector<double> values) {
  ScalarField field = describe(quantity);
  const double largest = *std::max_element(values.begin(), values.end());
  if (app::infoOf(quantity).startsAtZero && largest > 0) field.range = {0.0, largest};
  field.values = std::move(values);
  return field;
}

ScalarField stiffnessField(const app::TouchModel& model, const app::DrawnBody& drawn,
                           const std::vector<double>& compliances) {
  const app::BoundarySetup& setup = model.setup();
  const auto colours = app::StiffnessColours::of(setup.mesh(), setup.meshSlots(), compliances);
  ScalarField field = describe(app::SurfaceQuantity::kStiffness);
  field.values = drawn.stiffnesses(compliances);
  colours.cap(field.values);
  field.range = colours.range;
  field.isCapped = colours.isCapped;
  return field;
}

}  // namespace

void addSurface(const std::shared_ptr<const app::TouchModel>& model, const app::TouchState& state,
                const PictureOptions& options, view::Picture& picture) {
  const app::DrawnBody drawn(model);
  const modeling::DisplayMesh& mesh = drawn.mesh();
  picture.body = {mesh.positions,
                  mesh.normals,
                  mesh.triangles,
                  mesh.patchOfTriangle,
                  view::linesBetween(drawn.borders()),
                  {}};
  if (options.showMeshEdges) picture.body.knotLines = view::linesBetween(mesh.edgeLines);
  app::DrawnBody::Shape shape;
  drawn.deform(state.field.u.col(0), options.displacementScale, shape);
  picture.positions = std::move(shape.positions);
  picture.normals = std::move(shape.normals);
  picture.supports =
      view::regionOfTriangles(mesh.triangles, drawn.isSupported(), mesh.positions.size());
  if (options.field == app::SurfaceQuantity::kStiffness)
    picture.field = stiffnessField(*model, drawn, options.compliances);
  else if (options.field != app::SurfaceQuantity::kNone)
    picture.field = fieldOf(options.field, drawn.values(options.field, state.field));
}

}  // namespace palpa::cli
