#include "app/gui/simulate/simulation_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "app/core/model/contact_kind.h"
#include "app/report/state_picture.h"

namespace palpa::gui {
namespace {

using Status = app::TouchSnapshot::Status;
using app::SurfaceQuantity;

constexpr int kRingPieces = 40;
constexpr int kLabelDigits = 3;
constexpr double kUnseen = 1e-5;   // of the body's size, the range of colours or the force
constexpr double kMinSine = 0.15;  // of the angle between force and surface that decides its side

view::ContactRing::State stateOf(Status status, bool isConverged) {
  return isConverged ? report::ringStateOf(status) : view::ContactRing::State::kFailed;
}

}  // namespace

SimulationView::SimulationView(const Editor& editor, Simulation& simulation,
                               const Settings& settings, SceneController& scene,
                               ViewportWidget& widget)
    : QObject(&widget),
      simulation_(simulation),
      settings_(settings),
      scene_(scene),
      widget_(widget),
      loads_(editor, settings, simulation) {
  connect(&simulation, &Simulation::activeChanged, this, &SimulationView::enterOrLeave);
  connect(&simulation, &Simulation::bodyChanged, this, &SimulationView::showBody);
  connect(&simulation, &Simulation::framed, this, &SimulationView::showFrame);
  connect(&settings, &Settings::changed, this, [this] {  // units
    isStale_ = true;
    if (hasBody_) loads_.find();
  });
  connect(&simulation, &Simulation::picturesChanged, this, [this] {
    if (hasBody_) showField();
  });
}

void SimulationView::enterOrLeave(bool active) {
  if (active) {
    // The undeformed body stays visible until the first model is ready.
    scene_.show(SceneController::Extent::kBody);
    return;
  }
  view::Viewport& viewport = widget_.viewport();
  viewport.setField(std::nullopt);
  viewport.setGhost(std::nullopt);
  viewport.setLiveArrows({});
  viewport.setContactRings({});
  viewport.setBalls({});
  hasBody_ = false;
  fullForce_ = 0;
  scene_.show(SceneController::Extent::kAll);
  widget_.update();
}

view::ScalarField SimulationView::fieldLooks() const {
  const app::SurfaceQuantityInfo& info = app::infoOf(simulation_.quantity());
  view::ScalarField field;
  QString name = tr(info.label);
  if (info.quantity == SurfaceQuantity::kStiffness) {
    const double ready = simulation_.stiffnessReady();
    if (ready < 1) name = tr("%1, %2 %").arg(name).arg(std::floor(100 * ready));
    field.isCapped = simulation_.stiffnessColours().isCapped;
  }
  if (info.quantity == SurfaceQuantity::kStiffnessGradient) {
    name = simulation_.gradientName();
    field.isCapped = simulation_.isGradientCapped();
  }
  field.name = name.toStdString();
  field.unit = fieldUnit().symbol.toStdString();
  if (info.isSigned) field.colours = view::ScalarField::Colours::kDiverging;
  if (replacement_ && !replacement_->name.isEmpty()) field.name = replacement_->name.toStdString();
  if (replacement_ && replacement_->isDiverging)
    field.colours = view::ScalarField::Colours::kDiverging;
  field.isLogarithmic = info.isLogarithmic;
  return field;
}

Unit SimulationView::fieldUnit() const {
  return shownUnit(app::infoOf(simulation_.quantity()).unit, settings_.units());
}

void SimulationView::showBody() {
  scene_.show(SceneController::Extent::kNothing);
  const app::DrawnBody& body = *simulation_.drawn();
  const modeling::DisplayMesh& mesh = body.mesh();
  view::Viewport& viewport = widget_.viewport();
  viewport.setBody({simulation_.shape().positions, simulation_.shape().normals, mesh.triangles,
                    mesh.patchOfTriangle, view::linesBetween(body.borders()),
                    view::linesBetween(mesh.edgeLines)});
  viewport.setRegions(
      view::regionOfTriangles(mesh.triangles, body.isSupported(), mesh.positions.size()), {});
  hasBody_ = true;
  size_ = 0;
  for (const Eigen::Vector3d& position : mesh.positions)
    size_ = std::max(size_, (position - mesh.positions.front()).norm());
  loads_.find();
  showField();
  showGhost();
  showFrame();
}

void SimulationView::showField() {
  isStale_ = true;
  view::Viewport& viewport = widget_.viewport();
  if (simulation_.quantity() == SurfaceQuantity::kNone) {
    viewport.setField(std::nullopt);
  } else {
    view::ScalarField field = fieldLooks();
    // The next frame sets the values.
    field.values.assign(simulation_.drawn()->mesh().positions.size(),
                        std::numeric_limits<double>::quiet_NaN());
    field.range = std::array<double, 2>{1, 2};
    viewport.setField(field);
  }
}

void SimulationView::setReplacement(std::optional<Replacement> replacement) {
  if (!replacement && !replacement_) return;
  const auto isDiverging = [](const auto& each) { return each && each->isDiverging; };
  const auto name = [](const auto& each) { return each ? each->name : QString(); };
  const bool changesLooks = isDiverging(replacement) != isDiverging(replacement_) ||
                            name(replacement) != name(replacement_);
  replacement_ = std::move(replacement);
  isStale_ = true;
  if (!hasBody_) return;
  if (changesLooks) showField();
  // After a change of the quantity the next frame has its values and range.
  if (simulation_.range()[0] < simulation_.range()[1]) showFrame();
}

const std::vector<double>& SimulationView::values() const {
  const std::size_t count = simulation_.shape().positions.size();
  const bool isReplaced = replacement_ && replacement_->values.size() == count;
  return isReplaced ? replacement_->values : simulation_.values();
}

std::array<double, 2> SimulationView::range() const {
  return replacement_ && replacement_->range ? *replacement_->range : simulation_.range();
}

void SimulationView::setGhostShown(bool shown) {
  isGhostShown_ = shown;
  if (hasBody_) showGhost();
  widget_.update();
}

void SimulationView::showGhost() {
  if (!isGhostShown_) {
    widget_.viewport().setGhost(std::nullopt);
    return;
  }
  const app::DrawnBody& body = *simulation_.drawn();
  // Lines only: shading the surface again would halve the frame rate.
  widget_.viewport().setGhost(view::ViewportBody{
      body.mesh().positions, body.mesh().normals, {}, {}, view::linesBetween(body.borders()), {}});
}

bool SimulationView::hasChanged() {
  const app::TouchSnapshot& snapshot = simulation_.snapshot();
  const auto contacts = snapshot.touched();
  const auto& positions = simulation_.shape().positions;
  const std::array<double, 2> range = simulation_.range();
  const auto isSame = [](double a, double b, double size) {
    return std::abs(a - b) <= kUnseen * size || (std::isnan(a) && std::isnan(b));
  };
  const auto isSamePlace = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return isSame((a - b).norm(), 0, size_);
  };
  const auto isSameContact = [&](const auto& a, const auto& b) {
    return a.id == b.id && a.status == b.status &&
           isSame((a.force - b.force).norm(), 0, b.force.norm()) && isSamePlace(a.value, b.value);
  };
  const double span = range[1] - range[0];
  const bool isEqual = !isStale_ && range == drawn_.range &&
                       snapshot.isConverged == drawn_.isConverged &&
                       std::ranges::equal(positions, drawn_.positions, isSamePlace) &&
                       std::ranges::equal(simulation_.values(), drawn_.values,
                                          [&](double a, double b) { return isSame(a, b, span); }) &&
                       std::ranges::equal(contacts, drawn_.contacts, isSameContact);
  isStale_ = false;
  if (isEqual) return false;
  drawn_.positions = positions;
  drawn_.values = simulation_.values();
  drawn_.range = range;
  drawn_.contacts.assign(contacts.begin(), contacts.end());
  drawn_.isConverged = snapshot.isConverged;
  return true;
}

void SimulationView::showFrame() {
  // A touch that stays is computed without end, but without motion the picture stays the same.
  if (!hasBody_ || !hasChanged()) return;
  view::Viewport& viewport = widget_.viewport();
  viewport.moveBody(simulation_.shape().positions, simulation_.shape().normals);
  if (simulation_.quantity() != SurfaceQuantity::kNone) {
    const double factor = fieldUnit().factor;
    std::vector<double> values = this->values();
    for (double& value : values) value /= factor;
    viewport.setFieldValues(values, {range()[0] / factor, range()[1] / factor});
  }
  viewport.setLoadArrows(loads_.arrows());
  showContacts();
  widget_.updateQuickly();
}

std::vector<Eigen::Vector3d> SimulationView::ring(const app::TouchSnapshot::Contact& contact,
                                                  double radius) const {
  std::vector<Eigen::Vector3d> points;
  const auto body = simulation_.body();
  const Eigen::Vector3d normal = body->model().setup().mesh().normal(contact.point.triangle);
  const Eigen::Vector3d x = normal.unitOrthogonal(), y = normal.cross(x);
  for (int i = 0; i < kRingPieces; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRingPieces;
    const bem::SurfacePoint place = body->surface().tree().nearest(
        contact.point.position + radius * (std::cos(angle) * x + std::sin(angle) * y));
    points.push_back(place.position + simulation_.scale() * simulation_.displacementAt(place));
  }
  return points;
}

void SimulationView::showReplacedContacts() {
  view::LiveArrows arrows;
  double largest = 0;
  for (const app::TouchState::Contact& contact : *replacement_->contacts) {
    const double force = contact.force.norm();
    if (force == 0) continue;
    largest = std::max(largest, force);
    arrows.arrows.push_back(
        {contact.at + simulation_.scale() * contact.displacement, contact.force,
         contact.normalForce() > 0 ? view::ForceArrow::Anchor::kTip
                                   : view::ForceArrow::Anchor::kTail,
         view::ForceArrow::Role::kApplied,
         shown(force, Quantity::kForce, settings_.units(), kLabelDigits).toStdString()});
  }
  if (largest > fullForce_ || largest < 0.1 * fullForce_) fullForce_ = 2 * largest;
  arrows.fullForce = fullForce_ > 0 ? fullForce_ : 1;
  view::Viewport& viewport = widget_.viewport();
  viewport.setLiveArrows(arrows);
  viewport.setContactRings({});
  viewport.setBalls({});
}

void SimulationView::showContacts() {
  if (replacement_ && replacement_->contacts) {
    showReplacedContacts();
    return;
  }
  const app::TouchSnapshot& snapshot = simulation_.snapshot();
  view::LiveArrows arrows;
  std::vector<view::ContactRing> rings;
  std::vector<view::Ball> balls;
  double largest = 0;
  std::erase_if(isPressing_, [&](const auto& known) { return !snapshot.find(known.first); });
  for (const auto& contact : snapshot.touched()) {
    const Eigen::Vector3d moved = simulation_.displacementAt(contact.point);
    const Eigen::Vector3d drawn = contact.point.position + simulation_.scale() * moved;
    const double force = contact.force.norm();
    largest = std::max(largest, force);
    if (force > 0) {
      const Eigen::Vector3d normal =
          simulation_.drawn()->model().setup().mesh().normal(contact.point.triangle);
      // A force along the surface changes its side often: keep the arrow as it was.
      const double outwards = contact.force.dot(normal) / force;
      bool& isPressing = isPressing_.try_emplace(contact.id, outwards < 0).first->second;
      if (std::abs(outwards) > kMinSine) isPressing = outwards < 0;
      arrows.arrows.push_back(
          {drawn, contact.force,
           isPressing ? view::ForceArrow::Anchor::kTip : view::ForceArrow::Anchor::kTail,
           view::ForceArrow::Role::kApplied,
           shown(force, Quantity::kForce, settings_.units(), kLabelDigits).toStdString()});
    }
    double radius = contact.tool.radius;
    if (app::infoOf(contact.tool.kind).isBall) {
      balls.push_back({contact.value + (simulation_.scale() - 1) * moved, contact.tool.radius});
      radius = 0;
      for (const auto& patch : snapshot.pressed(contact))
        radius = std::max(
            radius, (patch.point.position - contact.point.position).norm() + 0.5 * patch.radius);
    }
    if (radius > 0)
      rings.push_back({ring(contact, radius), stateOf(contact.status, snapshot.isConverged)});
  }
  // Change the scale rarely, as for the colours.
  if (largest > fullForce_ || largest < 0.1 * fullForce_) fullForce_ = 2 * largest;
  arrows.fullForce = fullForce_ > 0 ? fullForce_ : 1;
  view::Viewport& viewport = widget_.viewport();
  viewport.setLiveArrows(arrows);
  viewport.setContactRings(rings);
  viewport.setBalls(balls);
}

}  // namespace palpa::gui
