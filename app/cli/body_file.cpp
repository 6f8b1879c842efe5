#include "app/cli/body_file.h"

#include "app/cli/errors.h"
#include "app/cli/text.h"
#include "app/core/session/import_project.h"
#include "base/count_text.h"
#include "modeling/exchange/cad_export.h"
#include "modeling/exchange/file_format.h"
#include "modeling/exchange/mesh_writer.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/mesh_foci.h"
#include "modeling/project/project_file.h"

namespace palpa::cli {
namespace {

void writeMeshOf(const modeling::Project& project, const std::string& path, bool remesh,
                 const Job& job) {
  const auto* body = std::get_if<modeling::MeshBody>(&project.body);
  if (body && !remesh) {
    modeling::writeMesh({body->positions(), body->triangles(), {}, {}}, path);
    return;
  }
  const auto regions = modeling::meshRegions(project);
  const modeling::SurfaceMesh mesh =
      modeling::mesh(project.body, project.mesh, regions, job, modeling::meshFoci(project));
  modeling::writeMesh({mesh.positions, mesh.triangles, {}, {}}, path);
}

}  // namespace

ReadBody readBody(const std::string& path, const modeling::ImportOptions& options, const Job& job) {
  if (modeling::fileFormatOf(path) == modeling::FileFormat::kProject)
    return {modeling::readProject(path), 0.0, {}, {}};
  app::ImportedProject imported = app::importProject(path, options, job);
  return {std::move(imported.project), imported.deviation, std::move(imported.notes),
          std::move(imported.held)};
}

void writeBody(const modeling::Project& project, const std::string& path, bool remesh,
               const Job& job) {
  switch (infoOf(modeling::requireFormat(path, modeling::isWritable)).kind) {
    case modeling::FileKind::kProject:
      return modeling::writeProject(project, path);
    case modeling::FileKind::kCad:
      return modeling::exportCad(project.body, path, project.name, job);
    case modeling::FileKind::kMesh:
      return writeMeshOf(project, path, remesh, job);
    case modeling::FileKind::kPage:  // not accepted above
      return;
  }
}

Json toJson(const ReadBody& read) {
  const modeling::Body& body = read.project.body;
  Json report;
  if (const auto* solid = std::get_if<modeling::Solid>(&body)) {
    report = {{"kind", "solid"}, {"control_points", solid->controlPoints().size()}};
  } else {
    const auto& mesh = std::get<modeling::MeshBody>(body);
    report = {{"kind", "mesh body"},
              {"vertices", mesh.positions().size()},
              {"triangles", mesh.triangles().size()}};
  }
  report["patches"] = modeling::patchNames(body);
  report["volume_mm3"] = modeling::volume(body);
  report["deviation_mm"] = read.deviation;
  report["notes"] = read.notes;
  return report;
}

Json toJson(const modeling::ProposedSupport& proposed) {
  return {{"name", proposed.support.name},
          {"where", proposed.description()},
          {"faces", proposed.flatFace}};
}

std::string toText(const ReadBody& read) {
  const modeling::Body& body = read.project.body;
  std::string text;
  if (const auto* solid = std::get_if<modeling::Solid>(&body)) {
    text = format("solid      %zu patches over %s control points\n", solid->patches().size(),
                  countText(solid->controlPoints().size()).c_str());
  } else {
    const auto& mesh = std::get<modeling::MeshBody>(body);
    text = format("mesh body  %zu %s, %s vertices, %s triangles\n", mesh.faceNames().size(),
                  mesh.faceNames().size() == 1 ? "face" : "faces",
                  countText(mesh.positions().size()).c_str(),
                  countText(mesh.triangles().size()).c_str());
  }
  text += "patches    " + modeling::quotedPatchNames(body) + "\n";
  text += format("volume     %.6g mm³\n", modeling::volume(body));
  if (read.deviation > 0) text += format("deviation  %.2g mm\n", read.deviation);
  for (const std::string& note : read.notes) text += "note       " + note + "\n";
  return text;
}

}  // namespace palpa::cli
