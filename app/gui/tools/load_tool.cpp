#include "app/gui/tools/load_tool.h"

#include <algorithm>

#include "app/gui/tools/brush.h"
#include "app/gui/tools/load_options.h"

namespace palpa::gui {
namespace {

using Kind = Selection::Kind;
using Style = view::ToolDrawing::Style;

constexpr double kStrengthShare = 0.02;  // of Young's modulus: strains of a few per cent
constexpr double kBumpShare = 0.1;       // of the body's size

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
  return load && load->what.index() == static_cast<std::size_t>(kind_) ? load : nullptr;
}

double LoadTool::defaultStrength() const {
  return kStrengthShare * editor_.project().material.youngsModulus;
}

double LoadTool::strength() const {
  if (const modeling::Load* load = target()) {
    if (const auto* pressure = std::get_if<modeling::Pressure>(&load->what))
      return pressure->pressure;
    if (const auto* bump = std::get_if<modeling::Bump>(&load->what)) return bump->peak;
  }
  return strength_.value_or(defaultStrength());
}

Eigen::Vector3d LoadTool::traction() const {
  if (const modeling::Load* load = target())
    if (const auto* traction = std::get_if<modeling::UniformTraction>(&load->what))
      return traction->traction;
  return traction_.value_or(-defaultStrength() * Eigen::Vector3d::UnitZ());
}

double LoadTool::radius() const {
  if (const modeling::Load* load = target())
    if (const auto* bump = std::get_if<modeling::Bump>(&load->what)) return bump->radius;
  return radius_.value_or(kBumpShare * bodySize());
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

void LoadTool::setTraction(const Eigen::Vector3d& traction) {
  traction_ = traction;
  if (const modeling::Load* present = target()) {
    modeling::Load load = *present;
    if (auto* uniform = std::get_if<modeling::UniformTraction>(&load.what))
      uniform->traction = traction;
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
  if (kind_ != LoadKind::kBump) {
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
  const auto& loads = editor_.project().loads;
  modeling::Load load;
  if (kind_ == LoadKind::kPressure) {
    load.name = freeName(tr("pressure").toStdString(), loads);
    load.what = modeling::Pressure{modeling::Region::ofPatches({name}), strength()};
  } else {
    load.name = freeName(tr("traction").toStdString(), loads);
    load.what = modeling::UniformTraction{modeling::Region::ofPatches({name}), traction()};
  }
  if (editor_.perform(modeling::AddLoad{load}))
    editor_.select(Selection::of(Kind::kLoad, load.name));
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
  modeling::Load load;
  load.name = freeName(tr("bump").toStdString(), editor_.project().loads);
  modeling::Bump bump;
  bump.center = centre_->position;
  bump.radius = dragged_ > 0 ? dragged_ : radius();
  bump.peak = strength();
  bump.direction = -centre_->normal;
  load.what = bump;
  centre_.reset();
  draw({});
  if (editor_.perform(modeling::AddLoad{load}))
    editor_.select(Selection::of(Kind::kLoad, load.name));
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
  } else {
    scene_.setHoveredPatch(place ? std::optional(place->patch) : std::nullopt);
    if (place) {
      // Arrow along the traction at this place.
      const Eigen::Vector3d force =
          kind_ == LoadKind::kPressure ? Eigen::Vector3d(-strength() * place->normal) : traction();
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
  switch (kind_) {
    case LoadKind::kPressure:
      return tr(
          "Click patches to press on them, a loaded patch to remove its load; the options have the "
          "strength");
    case LoadKind::kTraction:
      return tr(
          "Click patches to pull at them, a loaded patch to remove its load; the options have the "
          "vector");
    default:
      return tr("Press at the centre of the bump and drag its radius; a click sets %1")
          .arg(shownLength(radius()));
  }
}

QWidget* LoadTool::makeOptions(QWidget* parent) {
  return new LoadOptions(*this, editor_, settings_, parent);
}

}  // namespace palpa::gui
