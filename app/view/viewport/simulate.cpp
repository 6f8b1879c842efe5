#include <algorithm>
#include <cmath>
#include <limits>

#include "app/view/scene/colour_map.h"
#include "app/view/viewport/checks.h"
#include "app/view/viewport/parts.h"

// Setters for simulation and pictures.
namespace palpa::view {
namespace {

void requireRange(const std::array<double, 2>& range) {
  require(std::isfinite(range[0]) && std::isfinite(range[1]) && range[0] <= range[1],
          "the range of a field is finite, the smallest value first");
}

/// The field on a surface with so many points, where its values are not known yet.
ScalarField withoutValues(ScalarField field, std::size_t points) {
  field.values.assign(points, std::numeric_limits<double>::quiet_NaN());
  return field;
}

}  // namespace

void Viewport::setField(const std::optional<ScalarField>& field) {
  if (field) {
    require(field->values.size() == parts_->body.positions.size(),
            "a field needs one number per point");
    require(field->range.has_value(), "a field needs a range");
    requireRange(*field->range);
    require((*field->range)[0] > 0 || !field->isLogarithmic,
            "the range of a logarithmic field is above zero");
  }
  parts_->surface.setField(field);
  if (field) {
    parts_->sectionFace.setField(
        withoutValues(*field, parts_->section ? parts_->section->face.positions.size() : 0));
    parts_->standInSurface.setField(
        withoutValues(*field, parts_->standIn ? parts_->standIn->positions.size() : 0));
  } else {
    parts_->sectionFace.setField(std::nullopt);
    parts_->standInSurface.setField(std::nullopt);
  }
  parts_->field = field;
  if (field) parts_->field->values.clear();
  parts_->applyField();
}

void Viewport::setFieldValues(const std::vector<double>& values,
                              const std::array<double, 2>& range) {
  require(parts_->field.has_value(), "there is no field whose values could change");
  require(values.size() == parts_->body.positions.size(), "a field needs one number per point");
  requireRange(range);
  require(range[0] > 0 || !parts_->field->isLogarithmic,
          "the range of a logarithmic field is above zero");
  const bool sameRange = parts_->field->range == range;
  parts_->field->range = range;
  parts_->surface.setFieldValues(values, colourRange(*parts_->field));
  if (!sameRange) parts_->applyField();
}

void Viewport::setSection(const std::optional<SectionDrawing>& section) {
  if (section) {
    requireValidBody(section->face);
    require(section->distances.size() == parts_->body.positions.size(),
            "a section needs one distance per point");
  }
  parts_->section = section;
  parts_->surface.setCut(section ? section->distances : std::vector<double>{});
  const ViewportBody none;
  const ViewportBody& face = section ? section->face : none;
  parts_->faceBoxes.set(face.positions, face.triangles);
  parts_->sectionFace.setBody(face);
  if (parts_->field)
    parts_->sectionFace.setField(withoutValues(*parts_->field, face.positions.size()));
}

void Viewport::moveSection(const std::vector<Eigen::Vector3d>& positions,
                           const std::vector<Eigen::Vector3d>& normals) {
  require(parts_->section && positions.size() == parts_->section->face.positions.size() &&
              normals.size() == positions.size(),
          "a moved section has as many points and normals as before");
  parts_->section->face.positions = positions;
  parts_->section->face.normals = normals;
  parts_->faceBoxes.move();
  parts_->sectionFace.move(positions, normals);
}

void Viewport::setSectionValues(const std::vector<double>& values) {
  require(parts_->section && values.size() == parts_->section->face.positions.size(),
          "a section needs one number per point");
  require(parts_->field.has_value(), "there is no field whose values could change");
  parts_->sectionFace.setFieldValues(values, colourRange(*parts_->field));
}

void Viewport::setSampleLabels(const std::vector<SampleLabel>& labels) {
  parts_->samples = labels;
  parts_->remakeSamples();
}

void Viewport::setGhost(const std::optional<ViewportBody>& body) {
  const ViewportBody ghost = body.value_or(ViewportBody{});
  requireValidBody(ghost);
  parts_->ghostSide.set(ghost);
  parts_->ghostLines.set(ghost);
}

void Viewport::setCompared(const std::optional<ViewportBody>& body) {
  const ViewportBody compared = body.value_or(ViewportBody{});
  requireValidBody(compared);
  parts_->compared.set(compared);
}

void Viewport::moveCompared(const std::vector<Eigen::Vector3d>& positions,
                            const std::vector<Eigen::Vector3d>& normals) {
  require(positions.size() == parts_->compared.size() && normals.size() == positions.size(),
          "a moved body has as many points and normals as before");
  parts_->compared.move(positions, normals);
}

void Viewport::setStandIn(const std::optional<ViewportBody>& body) {
  const ViewportBody standIn = body.value_or(ViewportBody{});
  requireValidBody(standIn);
  parts_->standIn = body;
  parts_->surface.setVisible(!body);
  parts_->sectionFace.setVisible(!body);
  parts_->standInSurface.setVisible(body.has_value());
  parts_->standInSurface.setBody(standIn);
  if (parts_->field)
    parts_->standInSurface.setField(withoutValues(*parts_->field, standIn.positions.size()));
}

void Viewport::moveStandIn(const std::vector<Eigen::Vector3d>& positions,
                           const std::vector<Eigen::Vector3d>& normals,
                           const std::vector<double>& values) {
  require(parts_->standIn && positions.size() == parts_->standIn->positions.size() &&
              normals.size() == positions.size(),
          "a moved body has as many points and normals as before");
  parts_->standIn->positions = positions;
  parts_->standIn->normals = normals;
  parts_->standInSurface.move(positions, normals);
  if (!parts_->field) return;
  require(values.size() == positions.size(), "a field needs one number per point");
  parts_->standInSurface.setFieldValues(values, colourRange(*parts_->field));
}

void Viewport::setCaption(const Caption& caption) {
  parts_->caption = caption;
  parts_->remakeCaption();
}

void Viewport::setLiveArrows(const LiveArrows& arrows) {
  require(arrows.fullForce > 0 && std::isfinite(arrows.fullForce), "the full force is positive");
  parts_->liveForces = arrows;
  parts_->remakeLiveArrows();
}

void Viewport::setGradient(const GradientDrawing& gradient) {
  require(gradient.arrows.fullForce > 0 && std::isfinite(gradient.arrows.fullForce),
          "the largest gradient is positive");
  const bool isSameLegend = gradient.legend == parts_->gradient.legend;
  parts_->gradient = gradient;
  parts_->remakeGradientArrows();
  if (!isSameLegend) parts_->remakeCaption();
}

void Viewport::setContactRings(const std::vector<ContactRing>& rings) {
  parts_->rings.set(rings);
}

void Viewport::setBalls(const std::vector<Ball>& balls) {
  for (const Ball& ball : balls) {
    require(ball.radius > 0 && std::isfinite(ball.radius) && ball.center.allFinite(),
            "a ball needs a place and a positive radius");
  }
  parts_->balls.set(balls);
}

}  // namespace palpa::view
