#include "tests/render/pressed_body.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/render/viewport_scenes.h"

namespace palpa::render_tests {

using Eigen::Vector3d;
using view::ScalarField;
using view::Viewport;

Vector3d Dent::operator()(const Vector3d& place) const {
  return std::exp(-(place - at).squaredNorm() / (radius * radius)) * peak;
}

Pressed::Pressed(const modeling::Solid& solid, std::vector<Dent> dents, int piecesPerSpan)
    : rest(viewportBody(solid, piecesPerSpan)), moved(rest), dents_(std::move(dents)) {
  for (Vector3d& position : moved.positions) position = at(position);
  for (std::size_t i = 0; i < rest.normals.size(); ++i) {
    // The area vector of two moved tangents.
    const Vector3d first = rest.normals[i].unitOrthogonal();
    const Vector3d second = rest.normals[i].cross(first);
    const Vector3d& place = rest.positions[i];
    constexpr double kStep = 1e-4;
    const Vector3d a = at(place + kStep * first) - at(place - kStep * first);
    const Vector3d b = at(place + kStep * second) - at(place - kStep * second);
    moved.normals[i] = a.cross(b).normalized();
  }
}

Vector3d Pressed::at(const Vector3d& place) const {
  Vector3d result = place;
  for (const Dent& dent : dents_) result += dent(place);
  return result;
}

ScalarField Pressed::displacement(double full) const {
  ScalarField field{"Displacement |u|", "mm", {}, ScalarField::Colours::kSequential, {{0, full}}};
  for (const Vector3d& place : rest.positions) field.values.push_back((at(place) - place).norm());
  return field;
}

ScalarField Pressed::traction() const {
  ScalarField field{
      "Normal traction", "MPa", {}, ScalarField::Colours::kDiverging, {{-0.05, 0.05}}};
  for (std::size_t i = 0; i < rest.positions.size(); ++i) {
    const Vector3d moving = at(rest.positions[i]) - rest.positions[i];
    field.values.push_back(0.01 * moving.dot(rest.normals[i]));
  }
  return field;
}

std::vector<Vector3d> Pressed::ring(const Vector3d& around, double radius) const {
  const Vector3d first = around.unitOrthogonal();
  const Vector3d second = around.normalized().cross(first);
  std::vector<Vector3d> points;
  for (int i = 0; i < 48; ++i) {
    const double angle = 2 * std::numbers::pi * i / 48;
    const Vector3d beside = around + radius * (std::cos(angle) * first + std::sin(angle) * second);
    points.push_back(at(around.norm() * beside.normalized()));
  }
  return points;
}

std::vector<double> Pressed::base() const {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (const Vector3d& place : rest.positions) {
    lowest = std::min(lowest, place.z());
    highest = std::max(highest, place.z());
  }
  std::vector<double> base;
  for (const Vector3d& place : rest.positions)
    base.push_back(place.z() - lowest - 0.15 * (highest - lowest));
  return base;
}

void Pressed::show(Viewport& viewport) const {
  viewport.setBody(rest);
  viewport.setControlNet({});
  viewport.fit();
  viewport.moveBody(moved.positions, moved.normals);
  viewport.setRegions(base(), {});
}

}  // namespace palpa::render_tests
