#include "app/core/page/page_project.h"

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "app/core/page/touch_places.h"
#include "app/core/setup/project_geometry.h"
#include "modeling/mesh/display_mesh.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/mesh_foci.h"

namespace palpa::app {
namespace {

/// The elements of splines get as small as a touch here and there needs: a touch for every area of
/// the radius squared. The refinement around a touch reaches half a radius.
constexpr int kMaxTouches = 2000;

std::vector<OrientedPoint> surfacePoints(const modeling::Project& project, const Job& job) {
  modeling::DisplaySettings settings;
  settings.leastPieces = settings.mostPieces = 1;
  const modeling::SurfaceMesh mesh =
      modeling::mesh(project.body, project.mesh, modeling::meshRegions(project), job);
  const modeling::DisplayMesh drawn = modeling::displayMesh(mesh, project.body, settings, job);
  std::vector<OrientedPoint> points;
  for (std::size_t k = 0; k < drawn.positions.size(); ++k)
    points.push_back({drawn.positions[k], drawn.normals[k]});
  return points;
}

double sizeOf(const std::vector<OrientedPoint>& points) {
  Eigen::AlignedBox3d box;
  for (const OrientedPoint& point : points) box.extend(point.position);
  return box.diagonal().norm();
}

}  // namespace

PageProject pageProject(const modeling::Project& project, double radius, const Job& job) {
  PageProject page{project, radius};
  page.project.touches.clear();
  Job quiet = job;
  quiet.progress = nullptr;
  const std::vector<OrientedPoint> points = surfacePoints(page.project, quiet);
  const double share = modeling::edgeLengthPerTouchRadius(modeling::engineOf(project));
  double& edgeLength = page.project.mesh.edgeLength;
  if (share > 0) {
    if (!(radius > 0))
      page.radius = std::max(defaultTouchRadius(sizeOf(points)), edgeLength / share);
    edgeLength = std::min(edgeLength, share * page.radius);
    return page;
  }
  if (!(radius > 0)) page.radius = defaultTouchRadius(sizeOf(points));
  // The mesh of splines serves for drawing; here it must be as fine as the reach of the refinement.
  modeling::Project fine = page.project;
  fine.mesh.edgeLength = std::min(fine.mesh.edgeLength, page.radius / 2);
  const std::vector<OrientedPoint> touched = surfacePoints(fine, quiet);
  for (const int k : spreadPlaces(touched, kMaxTouches, 0)) {
    modeling::Touch touch;
    touch.at = touched[static_cast<std::size_t>(k)].position;
    touch.radius = page.radius;
    page.project.touches.push_back(touch);
  }
  return page;
}

}  // namespace palpa::app
