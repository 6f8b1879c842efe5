#include "app/gui/document/body_places.h"

#include "app/gui/base/overloaded.h"

namespace palpa::gui {
namespace {

using Places = std::vector<Eigen::Vector3d>;

const Places& allPlaces(const modeling::Body& body) {
  return std::visit(
      Overloaded{
          [](const modeling::Solid& solid) -> const Places& { return solid.controlPoints(); },
          [](const modeling::MeshBody& mesh) -> const Places& { return mesh.positions(); }},
      body);
}

void addPatch(const modeling::Body& body, int patch, Places& places) {
  if (const auto* solid = std::get_if<modeling::Solid>(&body)) {
    for (int point : pointsOfPatches(body, {patch}))
      places.push_back(solid->controlPoints()[point]);
    return;
  }
  const auto& mesh = std::get<modeling::MeshBody>(body);
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t)
    if (mesh.faceOfTriangle()[t] == patch)
      for (int vertex : mesh.triangles()[t]) places.push_back(mesh.positions()[vertex]);
}

void addBall(const Eigen::Vector3d& centre, double radius, Places& places) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(radius);
  places.insert(places.end(), {centre - half, centre + half});
}

void addRegion(const modeling::Body& body, const modeling::Region& region, Places& places) {
  for (const modeling::RegionPart& part : region.parts)
    std::visit(Overloaded{[&](const modeling::PatchSet& set) {
                            for (const std::string& name : set.patches)
                              if (const auto patch = modeling::findPatch(body, name))
                                addPatch(body, *patch, places);
                          },
                          [&](const modeling::HalfSpace& half) {
                            for (const Eigen::Vector3d& place : allPlaces(body))
                              if (half.value(place) < 0.0) places.push_back(place);
                          },
                          // Other parts have no extent known here: the rest of the region decides.
                          [](const auto&) {}},
               part);
}

void addNamed(const modeling::Project& project, const Selection::Named& named, Places& places) {
  if (named.kind == Selection::Kind::kSupport)
    for (const modeling::Support& each : project.supports)
      if (each.name == named.name) addRegion(project.body, each.where, places);
  if (named.kind == Selection::Kind::kLoad)
    for (const modeling::Load& each : project.loads)
      if (each.name == named.name) {
        if (const modeling::Region* region = modeling::regionOf(each))
          addRegion(project.body, *region, places);
        else if (const auto* bump = std::get_if<modeling::Bump>(&each.what))
          addBall(bump->center, bump->radius, places);
      }
  if (named.kind == Selection::Kind::kTouch)
    for (const modeling::Touch& each : project.touches)
      if (each.name == named.name) {
        const auto corners = modeling::boundingBox(project.body);
        addBall(each.at, each.radius.value_or(0.1 * (corners[1] - corners[0]).norm()), places);
      }
}

}  // namespace

std::set<int> pointsOfPatches(const modeling::Body& body, const std::set<int>& patches) {
  std::set<int> points;
  if (const auto* solid = std::get_if<modeling::Solid>(&body))
    for (int patch : patches)
      for (const std::vector<int>& row : solid->patches()[patch].net)
        points.insert(row.begin(), row.end());
  return points;
}

Places placesOf(const modeling::Project& project, const Selection& selection) {
  Places places;
  if (const auto* solid = std::get_if<modeling::Solid>(&project.body)) {
    for (int point : selection.points) places.push_back(solid->controlPoints()[point]);
    for (int edge : selection.edges)
      for (const modeling::PatchEdge& use : solid->edges()[edge].uses)
        for (int vertex : solid->verticesOf(use.patch, use.side))
          places.push_back(solid->controlPoints()[vertex]);
  }
  for (int patch : selection.patches) addPatch(project.body, patch, places);
  if (selection.named) addNamed(project, *selection.named, places);
  return places.empty() ? allPlaces(project.body) : places;
}

}  // namespace palpa::gui
