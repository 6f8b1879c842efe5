#include "tests/render/simulate_scenes.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "app/view/scene/gradient_arrows.h"
#include "app/view/scene/ticks.h"
#include "modeling/shapes/primitives.h"
#include "tests/render/pressed_body.h"

namespace palpa::render_tests {
namespace {

using Eigen::Vector3d;
using view::ContactRing;
using view::ForceArrow;
using view::LiveArrows;
using view::ScalarField;
using view::Viewport;
using view::ViewportBody;
using Anchor = ForceArrow::Anchor;
using Role = ForceArrow::Role;
using State = ContactRing::State;

constexpr double kRadius = 25;  // mm

Vector3d onSphere(double x, double y, double z) {
  return kRadius * Vector3d(x, y, z).normalized();
}

/// A sphere pressed in from the upper front.
Pressed pushedSphere() {
  const Vector3d at = onSphere(0.25, -0.75, 0.65);
  return {modeling::makeSphere(kRadius), {{at, -5.5 / kRadius * at, 10}}};
}

/// A sphere pulled out at its left side.
Pressed pulledSphere() {
  const Vector3d at = onSphere(-0.85, -0.6, 0.25);
  return {modeling::makeSphere(kRadius), {{at, {-9, -4, 3}, 11}}};
}

void push(Viewport& viewport) {
  const Pressed sphere = pushedSphere();
  const Vector3d at = onSphere(0.25, -0.75, 0.65);
  sphere.show(viewport);
  viewport.setField(sphere.displacement(6));
  viewport.setLiveArrows(
      {{{sphere.at(at), -1.34 / kRadius * at, Anchor::kTip, Role::kApplied, "1.34 N"},
        {{0, 0, -25}, 1.34 / kRadius * at, Anchor::kTip, Role::kReaction, "1.34 N"}},
       2});
  viewport.setContactRings({{sphere.ring(at, 4), State::kSticking}});
}

void pull(Viewport& viewport) {
  const Pressed sphere = pulledSphere();
  const Vector3d at = onSphere(-0.85, -0.6, 0.25);
  sphere.show(viewport);
  viewport.setField(sphere.displacement(12));
  viewport.setGhost(sphere.rest);
  viewport.setLiveArrows(
      {{{sphere.at(at), {-0.9, -0.4, 0.3}, Anchor::kTail, Role::kApplied, "1.03 N"}}, 1});
  viewport.setContactRings({{sphere.ring(at, 3), State::kGrabbed}});
}

void traction(Viewport& viewport) {
  const Vector3d in = onSphere(0.5, -0.75, 0.4);
  const Vector3d out = onSphere(-0.6, -0.7, 0.35);
  const Pressed sphere(modeling::makeSphere(kRadius),
                       {{in, -5 / kRadius * in, 9}, {out, 5 / kRadius * out, 9}});
  sphere.show(viewport);
  viewport.setField(sphere.traction());
  viewport.setLiveArrows(
      {{{sphere.at(in), -0.8 / kRadius * in, Anchor::kTip, Role::kApplied, "0.800 N"},
        {sphere.at(out), 0.75 / kRadius * out, Anchor::kTail, Role::kApplied, "0.750 N"}},
       1});
  viewport.setContactRings(
      {{sphere.ring(in, 4), State::kSlipping}, {sphere.ring(out, 4), State::kGrabbed}});
}

/// A ball presses from the upper right on a plain body; the ring of the contact is seen through it.
void ball(Viewport& viewport) {
  const Vector3d at = onSphere(0.35, -0.6, 0.72);
  const Pressed sphere(modeling::makeSphere(kRadius), {{at, -4.5 / kRadius * at, 9}});
  sphere.show(viewport);
  const double radius = 9;
  viewport.setBalls({{sphere.at(at) * (1 + radius / sphere.at(at).norm()), radius}});
  viewport.setContactRings({{sphere.ring(at, 4.5), State::kSticking}});
  viewport.setLiveArrows(
      {{{sphere.at(at), -2.4 / kRadius * at, Anchor::kTip, Role::kApplied, "2.40 N"}}, 3});
}

/// From a vanishing force to more than the full one.
void growingArrows(Viewport& viewport) {
  const Pressed sphere(modeling::makeSphere(kRadius), {});
  sphere.show(viewport);
  viewport.setField(sphere.displacement(1));
  LiveArrows forces{{}, 2};
  int i = 0;
  for (const double force : {0.001, 0.02, 0.1, 0.3, 0.8, 2.0, 9.0}) {
    const double angle = -2.7 + 0.37 * i++;
    const Vector3d away(std::cos(angle), std::sin(angle), 0.15);
    forces.arrows.push_back({kRadius * away.normalized(), force * away.normalized(), Anchor::kTail,
                             Role::kApplied,
                             i < 4 ? "" : std::to_string(force).substr(0, 4) + " N"});
  }
  viewport.setLiveArrows(forces);
}

/// Labels that would cover each other, and some of arrows behind the body.
void manyContacts(Viewport& viewport) {
  const Pressed sphere = pushedSphere();
  sphere.show(viewport);
  viewport.setField(sphere.displacement(6));
  LiveArrows forces{{}, 1};
  std::vector<ContactRing> rings;
  for (int i = 0; i < 12; ++i) {
    const Vector3d at = i < 8 ? onSphere(0.25 + 0.17 * (i % 4) - 0.3, -0.75, 0.65 - 0.25 * (i / 4))
                              : onSphere(-0.7 + 0.5 * (i - 8), 0.8, 0.3);
    forces.arrows.push_back({sphere.at(at), -0.5 / kRadius * at, Anchor::kTip, Role::kApplied,
                             "0.5" + std::to_string(10 + i) + " N"});
    rings.push_back({sphere.ring(at, 1.5), State::kSticking});
  }
  viewport.setLiveArrows(forces);
  viewport.setContactRings(rings);
}

/// Every state, and one behind the body.
void rings(Viewport& viewport) {
  const Pressed sphere = pushedSphere();
  sphere.show(viewport);
  viewport.setField(sphere.displacement(6));
  viewport.setContactRings({{sphere.ring(onSphere(0.95, -0.15, 0.35), 4), State::kOpen},
                            {sphere.ring(onSphere(-0.25, -0.9, 0.1), 4), State::kGrabbed},
                            {sphere.ring(onSphere(0.25, -0.75, 0.65), 4), State::kSticking},
                            {sphere.ring(onSphere(0.35, -0.9, -0.1), 4), State::kSlipping},
                            {sphere.ring(onSphere(0.8, -0.5, 0.2), 4), State::kFailed},
                            {sphere.ring(onSphere(-0.3, 0.9, 0.2), 6), State::kSlipping}});
}

void plainRings(Viewport& viewport) {
  rings(viewport);
  viewport.setField({});
}

/// Marks, supports and loads over the colours.
void regions(Viewport& viewport) {
  push(viewport);
  const Pressed sphere = pushedSphere();
  std::vector<double> supports, loads;
  std::vector<view::Mark> marks;
  for (const Vector3d& place : sphere.rest.positions) {
    supports.push_back(place.z() + 12 + 0.3 * place.x());
    loads.push_back((place - onSphere(0.8, -0.6, 0.1)).norm() - 7);
  }
  const int hovered = viewport.surfaceAt({560, 150})->triangle;
  for (const int patch : sphere.rest.patchOfTriangle) {
    const bool isHovered = patch == sphere.rest.patchOfTriangle[static_cast<std::size_t>(hovered)];
    marks.push_back(isHovered ? view::Mark::kHovered : view::Mark::kNone);
  }
  viewport.setRegions(supports, loads);
  viewport.setMarks(marks);
}

/// Quick changes after the first picture, as in a simulation.
void updated(Viewport& viewport) {
  push(viewport);
  viewport.render(view::Quality::kQuick);
  const Pressed sphere = pulledSphere();
  const Vector3d at = onSphere(-0.85, -0.6, 0.25);
  viewport.moveBody(sphere.moved.positions, sphere.moved.normals);
  const ScalarField field = sphere.displacement(20);
  viewport.setFieldValues(field.values, *field.range);
  viewport.setLiveArrows({{{sphere.at(at), {-0.9, -0.4, 0.3}, Anchor::kTail, {}, "1.03 N"}}, 2});
  viewport.setContactRings({});
}

/// The inside of a patch without values, and numbers that need a power of ten.
void tinyNumbers(Viewport& viewport) {
  const Pressed box(modeling::makeBox({40, 30, 20}), {{{10, -8, 20}, {0, 0, -3}, 9}});
  box.show(viewport);
  ScalarField field = box.displacement(3);
  field.name = "von Mises stress";
  field.unit = "MPa";
  field.range = {0, 2e-5};
  for (double& value : field.values) value *= 0.6e-5;
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    if (box.rest.positions[i].x() > 12 && box.rest.positions[i].z() < 12) {
      field.values[i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  viewport.setField(field);
  viewport.setRegions({}, {});
}

/// Two balls, the nearer one given first: it is still drawn over the other.
void twoBalls(Viewport& viewport) {
  const Vector3d near = onSphere(0.65, -0.60, 0.45), far = onSphere(0.30, -0.25, 0.92);
  const Pressed sphere(modeling::makeSphere(kRadius),
                       {{near, -3 / kRadius * near, 9}, {far, -3 / kRadius * far, 9}});
  sphere.show(viewport);
  viewport.setField(sphere.displacement(5));
  const double ball = 12;
  const auto on = [&](const Vector3d& at) -> view::Ball {
    return {sphere.at(at) * (1 + ball / sphere.at(at).norm()), ball};
  };
  viewport.setBalls({on(near), on(far)});
  viewport.setContactRings(
      {{sphere.ring(near, 4.5), State::kSticking}, {sphere.ring(far, 4.5), State::kSticking}});
}

/// A logarithmic field, capped and partly unknown; fit() leaves room for its bar.
void stiffness(Viewport& viewport) {
  const Pressed sphere(modeling::makeSphere(kRadius), {});
  sphere.show(viewport);
  ScalarField field{"Stiffness, 63 %", "N/mm", {}, ScalarField::Colours::kSequential, {{0.4, 20}}};
  field.isLogarithmic = true;
  field.isCapped = true;
  for (const Vector3d& place : sphere.rest.positions) {
    const double height = (place.z() + kRadius) / (2 * kRadius);
    const bool isKnown = place.x() < 8 || place.z() < 0;
    field.values.push_back(isKnown ? std::min(20.0, 0.45 / (height * height + 1e-6))
                                   : std::numeric_limits<double>::quiet_NaN());
  }
  viewport.setField(field);
  viewport.fit();
}

/// Arrows at the control points of a pulled sphere, over diverging colours: towards the pull and
/// against it.
void gradient(Viewport& viewport) {
  const Pressed sphere = pulledSphere();
  const Vector3d at = onSphere(-0.85, -0.6, 0.25);
  sphere.show(viewport);
  ScalarField field = sphere.traction();
  field.name = "Stiffness gradient: Grab 1";
  field.unit = "N/mm per cm³";
  field.range = {{-0.05, 0.05}};
  field.isCapped = true;
  viewport.setField(field);
  const std::vector<Vector3d> points = modeling::makeSphere(kRadius).controlPoints();
  Eigen::Matrix3Xd values(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k)
    values.col(static_cast<Eigen::Index>(k)) =
        0.03 * std::exp(-(points[k] - at).norm() / 14) * points[k].normalized();
  viewport.setGradient(
      {view::gradientArrows(values, points, view::threeDigits),
       false,
       {"Stiffness gradient of Grab 1",
        "Pull a control point along its arrow: stiffer, by up to 0.03 N/mm per mm"}});
}

void outdatedGradient(Viewport& viewport) {
  gradient(viewport);
  const std::vector<Vector3d> points = modeling::makeSphere(kRadius).controlPoints();
  Eigen::Matrix3Xd values(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k)
    values.col(static_cast<Eigen::Index>(k)) = points[k] + Vector3d(0, 0, 15);
  viewport.setGradient({view::gradientArrows(values, points, [](double) { return ""; }),
                        true,
                        {"Stiffness gradient of Grab 1: of before, updating …"}});
}

std::function<void(Viewport&)> dark(std::function<void(Viewport&)> light) {
  return [light = std::move(light)](Viewport& viewport) {
    light(viewport);
    viewport.setTheme(view::ViewportTheme::dark());
  };
}

void wire(Viewport& viewport) {
  push(viewport);
  viewport.setShading(view::Shading::kWire);
}

}  // namespace

std::map<std::string, ViewportCase> simulateCases() {
  return {
      {"simulate_push", {push}},
      {"simulate_pull_ghost", {pull}},
      {"simulate_dark_pull_ghost", {dark(pull)}},
      {"simulate_traction", {traction}},
      {"simulate_dark_ball", {dark(ball)}},
      {"simulate_two_balls", {twoBalls}},
      {"simulate_growing_arrows", {growingArrows}},
      {"simulate_many_contacts", {manyContacts}},
      {"simulate_rings", {rings}},
      {"simulate_dark_rings", {dark(plainRings)}},
      {"simulate_regions", {regions}},
      {"simulate_wire", {wire}},
      {"simulate_updated", {updated}},
      {"simulate_tiny_numbers", {tinyNumbers}},
      {"simulate_gradient", {gradient}},
      {"simulate_dark_gradient_outdated", {dark(outdatedGradient)}},
      {"simulate_dark_stiffness", {dark(stiffness), 480, 400}},
  };
}

}  // namespace palpa::render_tests
