#include "app/report/drawn_surface.h"

#include <algorithm>
#include <cmath>

#include "app/core/design/surface_gradient.h"
#include "app/core/results/body_section.h"
#include "app/core/results/stiffness_colours.h"
#include "app/view/scene/colour_map.h"
#include "app/view/scene/ticks.h"

namespace palpa::report {
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

ScalarField gradientField(const app::TouchModel& model, const app::DrawnBody& drawn,
                          const app::StiffnessGradient& gradient) {
  ScalarField field = describe(app::SurfaceQuantity::kStiffnessGradient);
  field.name += ": " + gradient.name;
  const app::SurfaceGradient onSurface(app::makeDesignSurface(model), drawn);
  field.values = onSurface.values(gradient.gradient);
  const double end = app::surfaceGradientEnd(field.values);
  const auto [low, high] = std::minmax_element(field.values.begin(), field.values.end());
  field.extremes = {*low, *high};
  field.isCapped = *high > end || *low < -end;
  for (double& value : field.values) value = std::clamp(value, -end, end);
  field.range = {-end, end};
  return field;
}

/// Marks the smallest and the largest value that is drawn, on the surface or on the section.
void addExtremes(view::Picture& picture) {
  struct Place {
    double value;
    Eigen::Vector3d at;
  };
  std::vector<Place> drawn;
  for (std::size_t k = 0; k < picture.positions.size(); ++k)
    if (!picture.section || picture.section->distances[k] <= 0)
      drawn.push_back({picture.field->values[k], picture.positions[k]});
  for (std::size_t k = 0; k < picture.sectionValues.size(); ++k)
    drawn.push_back({picture.sectionValues[k], picture.section->face.positions[k]});
  std::erase_if(drawn, [](const Place& place) { return !std::isfinite(place.value); });
  if (drawn.empty()) return;
  const auto [low, high] = std::minmax_element(
      drawn.begin(), drawn.end(), [](const Place& a, const Place& b) { return a.value < b.value; });
  const auto add = [&](const Place& place, const char* label, view::SampleLabel::Kind kind) {
    picture.samples.push_back(
        {place.at, label + view::threeDigits(place.value) + " " + picture.field->unit, kind});
  };
  add(*low, "min ", view::SampleLabel::Kind::kMinimum);
  add(*high, "max ", view::SampleLabel::Kind::kMaximum);
}

/// Cuts the body, fills the section with the field inside, and widens the range of the colours to
/// its values.
void addSection(const std::shared_ptr<const app::DrawnBody>& drawn, const app::TouchState& state,
                const PictureOptions& options, view::Picture& picture) {
  const auto section = std::make_shared<const app::BodySection>(drawn, *options.section);
  const app::SectionField field(section);
  const std::vector<bem::InteriorState> states = field.states(state.field, {});
  std::vector<Eigen::Vector3d> moved;
  for (const bem::InteriorState& one : states) moved.push_back(one.displacement);
  app::BodySection::Shape shape = section->deformed(moved, options.displacementScale);
  view::SectionDrawing drawing;
  drawing.distances = section->distances();
  drawing.face.positions = std::move(shape.positions);
  drawing.face.normals = std::move(shape.normals);
  drawing.face.triangles = section->mesh().triangles;
  drawing.face.patchOfTriangle.assign(drawing.face.triangles.size(), 0);
  drawing.face.borders = view::linesBetween(section->mesh().edges);
  picture.section = std::move(drawing);
  if (!picture.field || !app::hasSectionValues(options.field)) return;
  for (const bem::InteriorState& one : states)
    picture.sectionValues.push_back(app::sectionValue(options.field, one, *options.section));
  if (picture.sectionValues.empty()) return;
  const auto [low, high] =
      std::minmax_element(picture.sectionValues.begin(), picture.sectionValues.end());
  const auto [least, most] =
      std::minmax_element(picture.field->values.begin(), picture.field->values.end());
  picture.field->extremes = {std::min(*low, *least), std::max(*high, *most)};
  std::array<double, 2> range = view::colourRange(*picture.field);
  range = {std::min(range[0], *low), std::max(range[1], *high)};
  if (app::infoOf(options.field).isSigned) {
    const double largest = std::max(-range[0], range[1]);
    range = {-largest, largest};
  }
  picture.field->range = range;
}

}  // namespace

void addSurface(const std::shared_ptr<const app::TouchModel>& model, const app::TouchState& state,
                const PictureOptions& options, view::Picture& picture) {
  const auto shared = std::make_shared<const app::DrawnBody>(model);
  const app::DrawnBody& drawn = *shared;
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
  else if (options.field == app::SurfaceQuantity::kStiffnessGradient)
    picture.field = gradientField(*model, drawn, *options.gradient);
  else if (options.field != app::SurfaceQuantity::kNone)
    picture.field = fieldOf(options.field, drawn.values(options.field, state.field));
  if (options.section) addSection(shared, state, options, picture);
  if (options.showExtremes && picture.field) addExtremes(picture);
  if (options.range && picture.field) picture.field->range = options.range;
}

}  // namespace palpa::report
