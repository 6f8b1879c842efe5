#include "app/view/scene.h"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

namespace palpa::view {
namespace {

void require(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument("scene: " + message);
}

void requireFinite(const std::vector<Eigen::Vector3d>& points, const std::string& name) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    require(points[i].allFinite(), name + "[" + std::to_string(i) + "] is not finite");
  }
}

}  // namespace

void SurfaceScene::validate() const {
  const int pointCount = static_cast<int>(positions.size());
  require(pointCount > 0 && !triangles.empty(), "there is no surface");
  requireFinite(positions, "positions");
  for (const Triangle& triangle : triangles) {
    for (const int corner : triangle) {
      require(corner >= 0 && corner < pointCount, "a triangle names a point that does not exist");
    }
  }
  require(displacements.empty() || displacements.size() == positions.size(),
          "displacements need one entry per point");
  requireFinite(displacements, "displacements");
  require(normals.empty() || normals.size() == positions.size(),
          "normals need one entry per point");
  requireFinite(normals, "normals");
  for (const auto& line : meshLines) {
    for (const int end : line) {
      require(end >= 0 && end < pointCount, "meshLines name a point that does not exist");
    }
  }
  require(std::isfinite(displacementScale), "displacementScale is not finite");
  if (field) {
    require(field->values.size() == positions.size(), "field.values need one entry per point");
    for (const double value : field->values) {
      require(std::isfinite(value), "field.values are not all finite");
      require(value > 0 || !field->isLogarithmic, "field.values of a logarithmic field are > 0");
    }
    if (field->range) {
      require((*field->range)[0] <= (*field->range)[1], "field.range is not ascending");
      require((*field->range)[0] > 0 || !field->isLogarithmic,
              "field.range of a logarithmic field is > 0");
    }
  }
  for (const int triangle : supports) {
    require(triangle >= 0 && triangle < static_cast<int>(triangles.size()),
            "supports name a triangle that does not exist");
  }
  for (const ForceArrow& arrow : arrows) {
    require(arrow.at.allFinite() && arrow.force.allFinite(), "an arrow is not finite");
  }
  require(fullForce >= 0 && std::isfinite(fullForce), "fullForce is not a number from 0 on");
  requireFinite(room, "room");
  for (const ProbeBall& ball : balls) {
    require(ball.center.allFinite() && ball.radius > 0 && std::isfinite(ball.radius),
            "a ball needs a place and a radius > 0");
  }
  for (const ContactPatch& patch : contactPatches) {
    require(patch.center.allFinite() && patch.radius > 0, "a contact patch needs a radius > 0");
  }
  require(camera.direction.norm() > 0 && camera.direction.cross(camera.up).norm() > 0,
          "camera.direction and camera.up must span a plane");
  require(camera.zoom > 0 && std::isfinite(camera.zoom), "camera.zoom must be > 0");
}

std::vector<Eigen::Vector3d> SurfaceScene::deformedPositions() const {
  std::vector<Eigen::Vector3d> deformed = positions;
  for (std::size_t i = 0; i < displacements.size(); ++i) {
    deformed[i] += displacementScale * displacements[i];
  }
  return deformed;
}

}  // namespace palpa::view
