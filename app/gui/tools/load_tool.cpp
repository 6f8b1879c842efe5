#include "app/gui/tools/load_tool.h"

#include <algorithm>

#include "app/gui/tools/brush.h"
#include "app/gui/tools/load_options.h"

namespace palpa::gui {
namespace {

using Kind = Selection::Kind;
using Style = view::ToolDrawing::Style;

}  // namespace

void LoadTool::setKind(LoadKind kind) {
  if (kind == kind_) return;
  cancel();
  hideHover();
  kind_ = kind;
  Q_EMIT changed();
}

const modeling::Load* LoadTool::target() const {
  const auto name = selected(Kind::kLoad);
  const auto* load = name ? findNamed(editor_.project().loads, *name) : nullptr;
  return load && loadKindOf(*load) == kind_ ? load : nullptr;
}

void LoadTool::followSelection() {
  const auto name = selected(Kind::kLoad);
  if (const auto* load = name ? findNamed(editor_.project().loads, *name) : nullptr)
    setKind(loadKindOf(*load));
}

modeling::Load LoadTool::next() const {
  modeling::Load load = usualLoad(kind_, editor_.project());
  if (auto* pressure = std::get_if<modeling::Pressure>(&load.what))
    pressure->pressure = strength_.value_or(pressure->pressure);
  if (auto* bump = std::get_if<modeling::Bump>(&load.what)) {
    bump->peak = strength_.value_or(bump->peak);
    bump->radius = radius_.value_or(bump->radius);
  }
  if (Eigen::Vector3d* vector = vectorOf(load))
    *vector = vectors_[static_cast<std::size_t>(kind_)].value_or(*vector);
  return load;
}

double LoadTool::strength() const {
  const modeling::Load load = target() ? *target() : next();
  if (const auto* pressure = std::get_if<modeling::Pressure>(&load.what)) return pressure->pressure;
  if (const auto* bump = std::get_if<modeling::Bump>(&load.what)) return bump->peak;
  return 0;
}

Eigen::Vector3d LoadTool::vector() const {
  const modeling::Load load = target() ? *target() : next();
  const Eigen::Vector3d* vector = vectorOf(load);
  return vector ? *vector : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

double LoadTool::radius() const {
  const modeling::Load load = target() ? *target() : next();
  const auto* bump = std::get_if<modeling::Bump>(&load.what);
  return bump ? bump->radius : 0;
}

void LoadTool::change(const modeling::Load& load) {
  editor_.perform(modeling::SetLoad{load.name, load});
}

void LoadTool::setStrength(double strength) {
  strength_ = strength;
  if (const modeling::Load* present = target()) {
    modeling::Load load = *present;
    if (auto* pressure = std::get_if<modeling::Pressure>(&load.what)) pressure->pressure = strength;
    if (auto* bump = std::get_if<modeling::Bump>(&load.what)) bump->peak = strength;
    change(load);
  }
  Q_EMIT changed();
}

void LoadTool::setVector(const Eigen::Vector3d& vector) {
  vectors_[static_cast<std::size_t>(kind_)] = vector;
  if (const modeling::Load* present = target()) {
    modeling::Load load = *present;
    if (Eigen::Vector3d* of = vectorOf(load)) *of = vector;
    change(load);
  }
  Q_EMIT changed();
}

void LoadTool::setRadius(double radius) {
  radius_ = radius;
  if (const modeling::Load* present = target()) {
    modeling::Load load = *present;
    if (auto* bump = std::get_if<modeling::Bump>(&load.what)) bump->radius = radius;
    change(load);
  }
  Q_EMIT changed();
}

bool LoadTool::press(const PointerEvent& event) {
  if (event.button != Qt::LeftButton) return false;
  const auto place = scene_.placeAt(event.pixel);
  if (!place) return true;
  if (kind_ == LoadKind::kGravity) {
    placeGravity();
    return true;
  }
  if (actsOnPatches(kind_)) {
    clickPatch(place->patch);
    return true;
  }
  editor_.select({});  // the options then show the numbers of the new bump
  centre_ = place;
  dragged_ = 0;
  pressed_ = event.pixel;
  drawBump();
  return true;
}

void LoadTool::clickPatch(int patch) {
  const std::string name = patchName(patch);
  if (const modeling::Load* present = target()) {
    modeling::Load load = *present;
    modeling::Region& region = *regionOf(load);
    setPatch(region, name, !namesPatch(region, name));
    if (region.parts.empty())
      editor_.perform(modeling::RemoveLoad{load.name});
    else
      change(load);
    return;
  }
  modeling::Load load = next();
  *regionOf(load) = modeling::Region::ofPatches({name});
  addLoad(editor_, load);
}

void LoadTool::placeGravity() {
  addGravity(editor_, next());
}

bool LoadTool::move(const PointerEvent& event) {
  if (!centre_) {
    hover(event.pixel);
    return false;
  }
  if (dragged_ == 0 && (event.pixel - pressed_).norm() < kDragThreshold) return true;
  // Outside the body use the plane parallel to the screen through the centre.
  const auto place = scene_.placeAt(event.pixel);
  const Eigen::Vector3d to =
      place ? place->position : widget_.viewport().inViewPlane(event.pixel, centre_->position);
  const double distance = (to - centre_->position).norm();
  if (std::isfinite(distance)) dragged_ = std::max(distance, 1e-3 * bodySize());
  drawBump();
  return true;
}

bool LoadTool::release(const PointerEvent& event) {
  if (event.button != Qt::LeftButton || !centre_) return false;
  placeBump();
  return true;
}

void LoadTool::placeBump() {
  modeling::Load load = next();
  auto& bump = std::get<modeling::Bump>(load.what);
  bump.center = centre_->position;
  if (dragged_ > 0) bump.radius = dragged_;
  bump.direction = -centre_->normal;
  centre_.reset();
  draw({});
  addLoad(editor_, load);
}

bool LoadTool::cancel() {
  if (!centre_) return false;
  centre_.reset();
  hideHover();
  return true;
}

void LoadTool::drawBump() {
  const double radius = dragged_ > 0 ? dragged_ : this->radius();
  view::ToolDrawing drawing;
  for (auto& line : ringOnSurface(scene_.surface(), centre_->position, radius))
    drawing.lines.push_back({std::move(line), Style::kPreview, true});
  const Eigen::Vector3d tail = centre_->position + 0.25 * bodySize() * centre_->normal;
  drawing.lines.push_back({{tail, centre_->position}, Style::kPreview, true});
  drawing.dots.push_back({centre_->position, Style::kPreview});
  drawing.labels.push_back({tail, tr("radius %1, peak %2")
                                      .arg(shownLength(radius), shown(strength(), Quantity::kStress,
                                                                      settings_.units(), 3))
                                      .toStdString()});
  draw(drawing);
}

void LoadTool::hover(const Eigen::Vector2d& pixel) {
  const auto place = scene_.placeAt(pixel);
  view::ToolDrawing drawing;
  if (kind_ == LoadKind::kBump) {
    if (place) {
      for (auto& line : ringOnSurface(scene_.surface(), place->position, radius()))
        drawing.lines.push_back({std::move(line), Style::kGuide, true});
    }
  } else if (actsOnPatches(kind_)) {
    scene_.setHoveredPatch(place ? std::optional(place->patch) : std::nullopt);
    if (place) {
      // Arrow along the force, or axis of the moment, at this place.
      const Eigen::Vector3d force =
          kind_ == LoadKind::kPressure ? Eigen::Vector3d(-strength() * place->normal) : vector();
      if (force.norm() > 0) {
        const Eigen::Vector3d along = 0.2 * bodySize() * force.normalized();
        const bool presses = force.dot(place->normal) < 0;
        drawing.lines.push_back({{presses ? place->position - along : place->position,
                                  presses ? place->position : place->position + along},
                                 Style::kPreview,
                                 true});
      }
      drawing.dots.push_back({place->position, Style::kPreview});
      drawing.labels.push_back({place->position, patchName(place->patch)});
    }
  }
  draw(drawing);
}

QString LoadTool::hint() const {
  const QString patches = tr("; click a loaded patch to remove its load");
  switch (kind_) {
    case LoadKind::kPressure:
      return tr("Click patches to press on them") + patches;
    case LoadKind::kTraction:
      return tr("Click patches to pull at them") + patches;
    case LoadKind::kTotalForce:
      return tr("Click patches to spread the force over them") + patches;
    case LoadKind::kMoment:
      return tr("Click patches to turn them") + patches;
    case LoadKind::kGravity:
      return tr("Click the body to give it its weight; the options have the acceleration");
    case LoadKind::kBump:
      break;
  }
  return tr("Press at the centre of the bump and drag its radius; a click sets %1")
      .arg(shownLength(radius()));
}

QWidget* LoadTool::makeOptions(QWidget* parent) {
  return new LoadOptions(*this, editor_, settings_, parent);
}

}  // namespace palpa::gui
