#include <Eigen/Geometry>

#include "app/gui/document/point_groups.h"
#include "app/gui/view/scene_controller.h"
#include "modeling/solid/isoparametric_line.h"

// Picking: the const functions of SceneController.
namespace palpa::gui {

ShownSurface SceneController::surface() const {
  if (tessellation_)
    return {shape_.positions, tessellation_->triangles(), tessellation_->patchOfTriangle()};
  const auto& body = std::get<modeling::MeshBody>(editor_.project().body);
  return {body.positions(), body.triangles(), body.faceOfTriangle()};
}

std::optional<SurfacePlace> SceneController::placeAt(const Eigen::Vector2d& pixel) const {
  const auto hit = widget_.viewport().surfaceAt(pixel);
  if (!hit) return std::nullopt;
  const ShownSurface shown = surface();
  const auto& [a, b, c] = shown.triangles[hit->triangle];
  const Eigen::Vector3d& from = shown.positions[a];
  const Eigen::Vector3d p = shown.positions[b] - from;
  const Eigen::Vector3d q = shown.positions[c] - from;
  const Eigen::Vector3d area = p.cross(q);
  SurfacePlace place{shown.patchOfTriangle[hit->triangle], std::nullopt, hit->position,
                     area.normalized()};
  if (!tessellation_) return place;
  const Eigen::Vector3d r = hit->position - from;
  const double s = r.cross(q).dot(area) / area.squaredNorm();
  const double t = p.cross(r).dot(area) / area.squaredNorm();
  const auto& parameters = tessellation_->parameters();
  const Eigen::Vector2d uv = (1.0 - s - t) * parameters[a] + s * parameters[b] + t * parameters[c];
  const Eigen::Vector3d normal =
      (1.0 - s - t) * shape_.normals[a] + s * shape_.normals[b] + t * shape_.normals[c];
  if (normal.norm() > 0.0) place.normal = normal.normalized();
  place.parameters = uv;
  // On the exact surface; the triangles are an approximation.
  place.position = modeling::surfacePoint(*editor_.solid(), place.patch, uv.x(), uv.y());
  return place;
}

std::optional<int> SceneController::patchAt(const Eigen::Vector2d& pixel) const {
  const auto hit = widget_.viewport().surfaceAt(pixel);
  if (!hit) return std::nullopt;
  return patchOfTriangle_[hit->triangle];
}

std::optional<int> SceneController::edgeAt(const Eigen::Vector2d& pixel) const {
  const auto border = widget_.viewport().borderAt(pixel);
  if (!border || !editor_.solid()) return std::nullopt;
  // Tessellation::borders() lists the four sides of each patch in the order of kSides.
  return editor_.solid()->edgeOf(*border / 4, modeling::kSides[*border % 4]);
}

std::vector<Eigen::Vector3d> SceneController::edgeLine(int edge) const {
  std::vector<Eigen::Vector3d> line;
  const modeling::Solid* solid = editor_.solid();
  if (!solid || solid->controlPoints().size() != netSize_ ||
      edge >= static_cast<int>(solid->edges().size()))
    return line;
  const modeling::PatchEdge& use = solid->edges()[edge].uses[0];
  const int border = 4 * use.patch + static_cast<int>(use.side);
  for (int vertex : tessellation_->borders()[border]) line.push_back(shape_.positions[vertex]);
  return line;
}

std::optional<Eigen::Vector3d> SceneController::selectionCentre() const {
  if (!editor_.solid()) return std::nullopt;
  const std::set<int> points = pointsOf(editor_.selection(), *editor_.solid());
  if (points.empty()) return std::nullopt;
  return meanOf(points, *editor_.solid());
}

std::vector<Eigen::Vector3d> SceneController::selectedPlaces() const {
  std::vector<Eigen::Vector3d> places;
  const Selection& selection = editor_.selection();
  if (const modeling::Solid* solid = editor_.solid()) {
    for (const int point : selection.points) places.push_back(solid->controlPoints()[point]);
    for (const int edge : selection.edges)
      for (const int end : solid->edges()[edge].vertices)
        places.push_back(solid->controlPoints()[end]);
  }
  for (std::size_t i = 0; i < patchOfPosition_.size(); ++i)
    if (selection.patches.contains(patchOfPosition_[i])) places.push_back(shape_.positions[i]);
  return places;
}

}  // namespace palpa::gui
