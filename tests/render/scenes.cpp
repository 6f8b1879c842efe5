#include "tests/render/scenes.h"

#include <cmath>

#include "tests/render/shapes.h"

namespace palpa::render_tests {
namespace {

using Eigen::Vector3d;
using view::ForceArrow;
using view::ScalarField;
using view::SurfaceScene;

SurfaceScene sceneOf(const Shape& shape) {
  SurfaceScene scene;
  scene.positions = shape.positions;
  scene.triangles = shape.triangles;
  return scene;
}

ScalarField magnitude(const std::vector<Vector3d>& displacements) {
  ScalarField field;
  field.name = "Displacement |u|";
  field.unit = "mm";
  field.values = norms(displacements);
  return field;
}

/// A sphere of radius 25, held below z = -18, displaced by `peak` around `at`.
SurfaceScene touchedSphere(const Vector3d& at, double radius, const Vector3d& peak) {
  const Shape shape = sphere(25, 20);
  SurfaceScene scene = sceneOf(shape);
  scene.displacements = bump(shape, at, radius, peak);
  scene.field = magnitude(scene.displacements);
  scene.supports = trianglesWhere(shape, [](const Vector3d& p) { return p.z() < -17; });
  scene.supportLabel = "held: base";
  return scene;
}

Case sphereDisplacement() {
  Case c{touchedSphere({0, 0, 25}, 30, {0, 0, -4})};
  c.scene.title = "Sphere, pressed from above";
  c.scene.captions = {"silicone, E = 0.25 MPa, nu = 0.48"};
  return c;
}

/// Ratios are spread evenly over the colours, and the bar says that there is more.
Case sphereStiffness() {
  Case c{touchedSphere({0, 0, 25}, 30, {0, 0, 0})};
  c.scene.displacements.clear();
  ScalarField field;
  field.name = "Stiffness";
  field.unit = "N/mm";
  for (const Vector3d& place : c.scene.positions) {
    const double height = (place.z() + 25) / 50;
    field.values.push_back(std::min(20.0, 0.45 / (height * height + 1e-6)));
  }
  field.range = {0.4, 20};
  field.isLogarithmic = true;
  field.isCapped = true;
  c.scene.field = field;
  c.scene.title = "Sphere, stiffness";
  return c;
}

Case sphereGhostPull() {
  Case c{touchedSphere({22, -12, 0}, 24, {9, -5, 2})};
  c.scene.showUndeformed = true;
  c.scene.arrows = {{{31, -17, 2},
                     {0.9, -0.5, 0.2},
                     ForceArrow::Anchor::kTail,
                     ForceArrow::Role::kApplied,
                     "1.05 N"}};
  c.scene.title = "Sphere, pulled at its side";
  return c;
}

Case sphereContactPush() {
  const Vector3d at(0, -12.5, 21.650635);
  Case c{touchedSphere(at, 20, {0, 2.5, -4.33})};
  c.scene.arrows = {{{0, -10, 17.32},
                     {0, 0.5, -0.866},
                     ForceArrow::Anchor::kTip,
                     ForceArrow::Role::kApplied,
                     "1.00 N"},
                    {{0, 0, -20},
                     {0, -0.5, 0.866},
                     ForceArrow::Anchor::kTip,
                     ForceArrow::Role::kReaction,
                     "1.00 N"}};
  c.scene.contactPatches = {{at, 5}};
  c.scene.showUndeformed = true;
  return c;
}

Case sphereHiddenArrow() {
  // The touched point is on the far side: the arrow shines through the body.
  Case c{touchedSphere({-20, 15, 0}, 20, {4, -3, 0})};
  c.scene.arrows = {{{-16, 12, 0},
                     {0.8, -0.6, 0},
                     ForceArrow::Anchor::kTail,
                     ForceArrow::Role::kApplied,
                     "0.134 N"}};
  return c;
}

Case boxPlainEdges() {
  Case c{sceneOf(box({40, 30, 20}, 8))};
  c.scene.title = "Box";
  return c;
}

Case boxSignedField() {
  const Shape shape = box({40, 30, 20}, 12);
  Case c{sceneOf(shape)};
  ScalarField field{"Normal traction", "MPa", {}, ScalarField::Colours::kDiverging, {}};
  for (const Vector3d& p : shape.positions) field.values.push_back(0.01 * p.x() + 0.004 * p.y());
  c.scene.field = field;
  c.scene.showMeshEdges = true;
  return c;
}

Case boxParallelFront() {
  const Shape shape = box({40, 30, 20}, 10);
  Case c{sceneOf(shape)};
  c.scene.displacements.reserve(shape.positions.size());
  for (const Vector3d& p : shape.positions) {
    c.scene.displacements.emplace_back(0.01 * p.z() * p.z(), 0, 0);
  }
  c.scene.displacementScale = 2;
  c.scene.field = magnitude(c.scene.displacements);
  c.scene.showUndeformed = true;
  c.scene.camera = {{0, 1, 0}, {0, 0, 1}, true, 1};
  c.scene.title = "Sheared box, twice enlarged";
  c.scene.captions = {"front view, parallel projection", "second line of the caption"};
  return c;
}

Case cylinderSupportsMesh() {
  const Shape shape = cylinder(20, 60, 48, 24);
  Case c{sceneOf(shape)};
  c.scene.displacements = bump(shape, {0, 0, 60}, 45, {6, 0, -2});
  c.scene.field = magnitude(c.scene.displacements);
  c.scene.showMeshEdges = true;
  c.scene.supports = trianglesWhere(shape, [](const Vector3d& p) { return p.z() < 1e-9; });
  c.scene.supportLabel = "held: bottom";
  // From below, to see the support.
  c.scene.camera.direction = {-0.72, 0.58, 0.5};
  return c;
}

Case cylinderManyArrows() {
  const Shape shape = cylinder(20, 60, 48, 24);
  Case c{sceneOf(shape)};
  const std::array<double, 5> angles{-2.2, -1.4, -0.6, 0.2, 1.0};
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const Vector3d outward(std::cos(angles[i]), std::sin(angles[i]), 0);
    const double force = 0.2 + 0.2 * static_cast<double>(i);
    c.scene.arrows.push_back({20 * outward + Vector3d(0, 0, 12 + 9.0 * static_cast<double>(i)),
                              force * outward, ForceArrow::Anchor::kTail,
                              ForceArrow::Role::kApplied, view::ForceArrow{}.label});
    c.scene.arrows.back().label = "0." + std::to_string(2 + 2 * i) + "00 N";
  }
  c.scene.arrows.back().label = "1.00 N";
  c.scene.title = "Five pins";
  return c;
}

Case thinPlate() {
  const Shape shape = box({60, 60, 3}, 16);
  Case c{sceneOf(shape)};
  for (const Vector3d& p : shape.positions) {
    const double bend = 1 - std::pow(p.x() / 30, 2);
    c.scene.displacements.emplace_back(0, 0, -5 * bend);
  }
  c.scene.field = magnitude(c.scene.displacements);
  c.scene.showUndeformed = true;
  return c;
}

Case tinyValues() {
  Case c{touchedSphere({0, 0, 25}, 30, {0, 0, -4})};
  c.scene.displacements.clear();
  for (double& value : c.scene.field->values) value *= 3.7e-7;
  c.scene.field->name = "von Mises stress";
  c.scene.field->unit = "MPa";
  return c;
}

Case smallPicture() {
  Case c = sphereGhostPull();
  c.options = {320, 240};
  return c;
}

}  // namespace

std::map<std::string, Case> allCases() {
  return {{"sphere_displacement", sphereDisplacement()},
          {"sphere_stiffness", sphereStiffness()},
          {"sphere_ghost_pull", sphereGhostPull()},
          {"sphere_contact_push", sphereContactPush()},
          {"sphere_hidden_arrow", sphereHiddenArrow()},
          {"box_plain_edges", boxPlainEdges()},
          {"box_signed_field", boxSignedField()},
          {"box_parallel_front", boxParallelFront()},
          {"cylinder_supports_mesh", cylinderSupportsMesh()},
          {"cylinder_many_arrows", cylinderManyArrows()},
          {"thin_plate", thinPlate()},
          {"tiny_values", tinyValues()},
          {"small_picture", smallPicture()}};
}

}  // namespace palpa::render_tests
