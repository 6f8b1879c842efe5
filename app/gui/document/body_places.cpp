#include "app/gui/document/body_places.h"

#include "app/gui/base/overloaded.h"
#include "app/gui/document/named_items.h"
#include "app/gui/document/point_groups.h"
#include "modeling/error.h"
#include "modeling/measure/measured_body.h"

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
    for (int point : pointsOfPatch(*solid, patch)) places.push_back(solid->controlPoints()[point]);
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
                          // The extent of other parts is unknown here; the rest of the region is
                          // enough.
                          [](const auto&) {}},
               part);
}

/// Nothing if the place is gone.
void addMeasured(const modeling::Body& body, const modeling::Measurement& measurement,
                 Places& places) {
  try {
    const auto value = modeling::MeasuredBody(body).measure(measurement);
    places.insert(places.end(), value.points.begin(), value.points.end());
  } catch (const modeling::ModelingError&) {
  }
}

void addNamed(const modeling::Project& project, const Selection::Named& named, Places& places) {
  if (named.kind == Selection::Kind::kSupport) {
    if (const auto* support = findNamed(project.supports, named.name))
      addRegion(project.body, support->where, places);
  } else if (named.kind == Selection::Kind::kLoad) {
    const auto* load = findNamed(project.loads, named.name);
    if (!load) return;
    if (const modeling::Region* region = modeling::regionOf(*load))
      addRegion(project.body, *region, places);
    else if (const auto* bump = std::get_if<modeling::Bump>(&load->what))
      addBall(bump->center, bump->radius, places);
  } else if (named.kind == Selection::Kind::kMeasurement) {
    if (const auto* measurement = findNamed(project.measurements, named.name))
      addMeasured(project.body, *measurement, places);
  } else if (const auto* touch = findNamed(project.touches, named.name)) {
    const auto corners = modeling::boundingBox(project.body);
    addBall(touch->at, touch->radius.value_or(0.1 * (corners[1] - corners[0]).norm()), places);
  }
}

}  // namespace

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
