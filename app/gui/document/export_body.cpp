#include "app/gui/document/export_body.h"

#include <QCoreApplication>
#include <array>
#include <map>
#include <string>

#include "app/core/page/touch_page_file.h"
#include "base/atomic_file.h"
#include "modeling/exchange/cad_export.h"
#include "modeling/exchange/file_format.h"
#include "modeling/exchange/mesh_writer.h"
#include "modeling/mesh/display_mesh.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/mesh_foci.h"
#include "modeling/project/project_file.h"

namespace palpa::gui {
namespace {

/// Merges the duplicate vertices that drawn surfaces have at sharp edges, so that the file is
/// closed.
modeling::MeshFile welded(const modeling::DisplayMesh& drawn) {
  modeling::MeshFile file;
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
                ExportedSurface surface, const Job& job, const app::TouchPageSettings& page) {
  constexpr auto kAll = [](const modeling::FileFormatInfo& info) { return info.canWrite; };
  switch (infoOf(modeling::requireFormat(path, kAll)).kind) {
    case modeling::FileKind::kProject:
      return modeling::writeProject(project, path);
    case modeling::FileKind::kCad:
      return modeling::exportCad(project.body, path, project.name, job);
    case modeling::FileKind::kPage: {
      const std::string version = QCoreApplication::applicationVersion().toStdString();
      const std::string text = app::touchPageText(app::makeTouchPage(project, version, page, job));
      job.throwIfCancelled();
      return replaceFile(text, path);
    }
    case modeling::FileKind::kMesh:
      break;
  }
  const auto* own = std::get_if<modeling::MeshBody>(&project.body);
  if (own && surface == ExportedSurface::kOwnTriangles) {
    modeling::writeMesh({own->positions(), own->triangles(), {}, {}}, path);
    return;
  }
  const modeling::SurfaceMesh mesh = modeling::mesh(
      project.body, project.mesh, modeling::meshRegions(project), job, modeling::meshFoci(project));
  if (surface == ExportedSurface::kDrawnSurface) {
    const modeling::MeshFile file = welded(modeling::displayMesh(mesh, project.body, {}, job));
    job.throwIfCancelled();
    modeling::writeMesh(file, path);
  } else {
    job.throwIfCancelled();
    modeling::writeMesh({mesh.positions, mesh.triangles, {}, {}}, path);
  }
}

}  // namespace palpa::gui
