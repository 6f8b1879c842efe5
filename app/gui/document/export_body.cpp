#include "app/gui/document/export_body.h"

#include <array>
#include <map>

#include "app/view/mesh_file.h"
#include "modeling/exchange/cad_export.h"
#include "modeling/exchange/cad_format.h"
#include "modeling/mesh/display_mesh.h"
#include "modeling/project/project_file.h"

namespace palpa::gui {
namespace {

/// Drawn surfaces have two vertices at sharp edges; files get one, so that they are closed.
view::MeshFile welded(const modeling::DisplayMesh& drawn) {
  view::MeshFile file;
  std::map<std::array<double, 3>, int> known;
  std::vector<int> numbers;
  for (const Eigen::Vector3d& p : drawn.positions) {
    const auto [found, isNew] =
        known.try_emplace({p.x(), p.y(), p.z()}, static_cast<int>(file.positions.size()));
    if (isNew) file.positions.push_back(p);
    numbers.push_back(found->second);
  }
  for (const auto& [a, b, c] : drawn.triangles)
    file.triangles.push_back({numbers[a], numbers[b], numbers[c]});
  return file;
}

}  // namespace

void exportBody(const modeling::Project& project, const std::filesystem::path& path,
                ExportedSurface surface, const Job& job) {
  if (path.extension() == ".json") {
    modeling::writeProject(project, path);
    return;
  }
  if (modeling::cadFormatOf(path)) {
    modeling::exportCad(project.body, path, project.name, job);
    return;
  }
  view::requireMeshFileName(path);
  const auto* own = std::get_if<modeling::MeshBody>(&project.body);
  if (own && surface == ExportedSurface::kOwnTriangles) {
    view::writeMesh({own->positions(), own->triangles(), {}, {}}, path);
    return;
  }
  const modeling::SurfaceMesh mesh =
      modeling::mesh(project.body, project.mesh, modeling::meshRegions(project), job);
  if (surface == ExportedSurface::kDrawnSurface) {
    const view::MeshFile file = welded(modeling::displayMesh(mesh, project.body, {}, job));
    job.throwIfCancelled();
    view::writeMesh(file, path);
  } else {
    job.throwIfCancelled();
    view::writeMesh({mesh.positions, mesh.triangles, {}, {}}, path);
  }
}

}  // namespace palpa::gui
