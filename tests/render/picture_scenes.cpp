#include "tests/render/picture_scenes.h"

#include <cmath>

#include "modeling/mesh/plane_section.h"
#include "modeling/shapes/primitives.h"
#include "tests/render/pressed_body.h"
#include "tests/render/viewport_scenes.h"

namespace palpa::render_tests {
namespace {

using Eigen::Vector3d;
using view::Picture;
using Anchor = view::ForceArrow::Anchor;
using Role = view::ForceArrow::Role;

constexpr double kRadius = 25;  // mm

Picture pictureOf(const Pressed& body) {
  Picture picture;
  picture.body = body.rest;
  picture.positions = body.moved.positions;
  picture.normals = body.moved.normals;
  picture.supports = body.base();
  return picture;
}

/// A pressed sphere with its reaction, as `palpa-cli render --reactions` shows it.
PictureCase push() {
  const Vector3d at = kRadius * Vector3d(0.05, -0.7, 0.7).normalized();
  const Pressed sphere(modeling::makeSphere(kRadius), {{at, -5.0 / kRadius * at, 10}});
  Picture picture = pictureOf(sphere);
  picture.field = sphere.displacement(5);
  picture.field->range.reset();
  picture.hasGhost = true;
  picture.arrows = {{{sphere.at(at), -1.34 / kRadius * at, Anchor::kTip, Role::kApplied, "1.34 N"},
                     {{0, 0, -25}, 1.34 / kRadius * at, Anchor::kTip, Role::kReaction, "1.34 N"}},
                    1.34,
                    0.25};
  picture.rings = {{sphere.ring(at, 5), view::ContactRing::State::kSticking}};
  picture.caption = {"Sphere, pressed from above",
                     "fixed: base",
                     {},
                     {"silicone, E = 0.25 MPa, nu = 0.48, 1538 nodes"}};
  return {picture};
}

PictureCase pull() {
  const Vector3d at = kRadius * Vector3d(0.8, -0.55, 0.1).normalized();
  const Pressed sphere(modeling::makeSphere(kRadius), {{at, {9, -5, 2}, 11}});
  Picture picture = pictureOf(sphere);
  picture.field = sphere.displacement(11);
  picture.hasGhost = true;
  picture.arrows = {{{sphere.at(at), {0.9, -0.5, 0.2}, Anchor::kTail, Role::kApplied, "1.05 N"}},
                    1.05};
  picture.rings = {{sphere.ring(at, 4), view::ContactRing::State::kGrabbed}};
  picture.caption = {"Sphere, pulled at its side", "fixed: base", {}, {}};
  return {picture};
}

PictureCase dark() {
  PictureCase result = push();
  result.picture.theme = view::ViewportTheme::dark();
  return result;
}

/// The title is too long for the picture.
PictureCase small() {
  PictureCase result = pull();
  result.picture.caption.title = "Sphere, pulled at its side with a title that is wide";
  result.size = {320, 240};
  return result;
}

/// A ball from below, seen from there; no field.
PictureCase ball() {
  const Vector3d at = kRadius * Vector3d(0.4, -0.6, -0.5).normalized();
  const Pressed sphere(modeling::makeSphere(kRadius), {{at, -3 / kRadius * at, 9}});
  Picture picture = pictureOf(sphere);
  const double radius = 9;
  picture.balls = {{sphere.at(at) * (1 + radius / sphere.at(at).norm()), radius}};
  picture.rings = {{sphere.ring(at, 4.5), view::ContactRing::State::kSlipping}};
  picture.arrows = {{{sphere.at(at), -2.4 / kRadius * at, Anchor::kTip, Role::kApplied, "2.40 N"}},
                    2.4};
  picture.camera.direction = {-0.72, 0.58, 0.5};
  picture.caption.supports = "fixed: base";
  return {picture, {640, 480}};
}

/// Two lines of caption, a ghost beside the body, and no perspective.
PictureCase front() {
  const Pressed box(modeling::makeBox({40, 30, 20}), {{{0, 0, 20}, {8, 0, -4}, 22}});
  Picture picture = pictureOf(box);
  picture.field = box.displacement(10);
  picture.hasGhost = true;
  picture.camera = {{0, 1, 0}, {0, 0, 1}, true, 1};
  picture.caption = {"Sheared box", "", {}, {"front view, parallel projection", "second line"}};
  return {picture};
}

/// Labels side by side; small forces keep their arrows.
PictureCase manyArrows() {
  const Pressed cylinder(modeling::makeCylinder(20, 60), {});
  Picture picture = pictureOf(cylinder);
  picture.supports.clear();
  picture.arrows = {{}, 1, 0.25};
  const std::array<double, 6> angles{-2.2, -1.6, -1.4, -1.2, 0.2, 1.0};
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const Vector3d outward(std::cos(angles[i]), std::sin(angles[i]), 0);
    const double force = i == 0 ? 0.02 : 0.2 * static_cast<double>(i);
    picture.arrows.arrows.push_back({20 * outward + Vector3d(0, 0, 12 + 8.0 * (i % 3)),
                                     force * outward, Anchor::kTail, Role::kApplied,
                                     std::to_string(force).substr(0, 4) + " N"});
  }
  picture.caption.title = "Six pins";
  return {picture};
}

/// A picture of a film: arrows are relative to a larger force, and there is room for other
/// pictures.
PictureCase film() {
  PictureCase result = pull();
  result.picture.arrows.fullForce = 3;
  result.picture.field->range = {0, 20};
  result.picture.room = {{60, -30, 20}, {0, 0, 45}};
  result.picture.caption.lines = {"0.280 s"};
  return result;
}

/// A pressed sphere, cut in the middle: the face has the colours of the field inside and moves with
/// it. Marks of the extremes, two samples.
PictureCase section() {
  const Vector3d at = kRadius * Vector3d(0, -0.35, 0.94).normalized();
  const Pressed sphere(modeling::makeSphere(kRadius), {{at, -6.0 / kRadius * at, 12}});
  Picture picture = pictureOf(sphere);
  picture.field = sphere.displacement(6);
  const modeling::Plane plane{Vector3d::UnitX(), 1.5};
  const modeling::PlaneSection cut =
      modeling::planeSection(sphere.rest.positions, sphere.rest.triangles, plane, 1.5);
  view::SectionDrawing drawing;
  for (const Vector3d& x : sphere.rest.positions) drawing.distances.push_back(plane.distance(x));
  for (const Vector3d& x : cut.positions) {
    drawing.face.positions.push_back(sphere.at(x));
    picture.sectionValues.push_back((sphere.at(x) - x).norm());
  }
  drawing.face.normals.assign(cut.positions.size(), plane.normal);
  drawing.face.triangles = cut.triangles;
  drawing.face.patchOfTriangle.assign(cut.triangles.size(), 0);
  drawing.face.borders = view::linesBetween(cut.edges);
  picture.section = drawing;
  using Kind = view::SampleLabel::Kind;
  picture.samples = {
      {sphere.at(at), "max 6.00 mm", Kind::kMaximum},
      {{1.5, 10, -18}, "min 0 mm", Kind::kMinimum},
      {sphere.at({1.5, -4, 12}), "1:  |u| 2.31 mm,  von Mises 0.0123 MPa", Kind::kPinned},
      {sphere.at({1.5, -2, 12}), "|u|  2.27 mm\nvon Mises stress  0.0119 MPa", Kind::kPointer}};
  picture.camera.direction = {-1, 0.45, -0.35};
  picture.caption = {"Sphere, pressed and cut", "fixed: base", {}, {}};
  return {picture};
}

PictureCase darkSection() {
  PictureCase result = section();
  result.picture.theme = view::ViewportTheme::dark();
  return result;
}

/// Dimensions of every kind on a box, also short, end on, of a single point, and selected.
PictureCase dimensions() {
  const Pressed box(modeling::makeBox({40, 30, 20}), {});
  Picture picture = pictureOf(box);
  picture.hasGhost = false;
  using Kind = view::Dimension::Kind;
  using State = view::Dimension::State;
  const Vector3d near(20, -15, 20), left(-20, -15, 20), low(20, -15, 0), back(20, 15, 20);
  picture.dimensions = {
      {Kind::kLinear, {near, left}, "40 mm"},
      {Kind::kLinear, {near, low}, "20 mm", State::kSelected},
      {Kind::kLinear, {{-20, 15, 20}, {-20, 13, 20}}, "2 mm"},
      {Kind::kAngle, {near, back, low}, "90°"},
      {Kind::kRadius, {{0, 0, 20}, {0, 0, 5}}, "R 15 mm"},
      {Kind::kCurve, {back, {20, 15, 10}, {20, 15, 0}}, "20 mm", State::kPreview},
      {Kind::kRadius, {{-5, -15, 8}}, "flat"},
  };
  picture.caption.title = "Box";
  return {picture};
}

PictureCase darkDimensions() {
  PictureCase result = dimensions();
  result.picture.theme = view::ViewportTheme::dark();
  // Closer: lines leave the picture, numbers stay in it.
  result.picture.camera.zoom = 1.7;
  return result;
}

}  // namespace

std::map<std::string, PictureCase> pictureCases() {
  return {{"picture_push", push()},
          {"picture_dark_push", dark()},
          {"picture_pull", pull()},
          {"picture_small", small()},
          {"picture_ball", ball()},
          {"picture_front", front()},
          {"picture_many_arrows", manyArrows()},
          {"picture_film", film()},
          {"picture_section", section()},
          {"picture_dark_section", darkSection()},
          {"picture_dimensions", dimensions()},
          {"picture_dark_dimensions", darkDimensions()}};
}

}  // namespace palpa::render_tests
