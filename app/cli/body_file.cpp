#include "app/cli/body_file.h"

#include <algorithm>
#include <filesystem>

#include "app/cli/errors.h"
#include "app/cli/text.h"
#include "app/core/session/new_project.h"
#include "app/view/mesh_file.h"
#include "modeling/exchange/cad_export.h"
#include "modeling/exchange/cad_format.h"
#include "modeling/exchange/mesh_reader.h"
#include "modeling/project/project_file.h"

namespace palpa::cli {
namespace {

std::string endingOf(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

void writeMeshOf(const modeling::Project& project, const std::string& path, bool remesh,
                 const Job& job) {
  const auto* body = std::get_if<modeling::MeshBody>(&project.body);
  if (body && !remesh) {
    view::writeMesh({body->positions(), body->triangles(), {}, {}}, path);
    return;
  }
  const auto regions = modeling::meshRegions(project);
  const modeling::SurfaceMesh mesh = modeling::mesh(project.body, project.mesh, regions, job);
  view::writeMesh({mesh.positions, mesh.triangles, {}, {}}, path);
}

}  // namespace

Job modelingJob(const Context& context) {
  ProgressLine& line = context.progress;
  return {context.stop,
          [&line](std::string_view phase, double fraction) { line.show(phase, fraction); }};
}

ReadBody readBody(const std::string& path, const modeling::ImportOptions& options, const Job& job) {
  if (endingOf(path) == ".json") return {modeling::readProject(path), 0.0, {}};
  modeling::ImportedBody imported = modeling::importBody(path, options, job);
  const std::string name = std::filesystem::path(path).stem().string();
  return {app::makeProject(std::move(imported.body), name), imported.deviation,
          std::move(imported.notes)};
}

void requireWritable(const std::string& path) {
  if (endingOf(path) == ".json" || modeling::isMeshFile(path) || modeling::cadFormatOf(path))
    return;
  throw OutputError("cannot write " + path + ": the name must end in " + kWritableEndings);
}

void writeBody(const modeling::Project& project, const std::string& path, bool remesh,
               const Job& job) {
  if (endingOf(path) == ".json")
    modeling::writeProject(project, path);
  else if (modeling::isMeshFile(path))
    writeMeshOf(project, path, remesh, job);
  else
    modeling::exportCad(project.body, path, project.name, job);
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

std::string toText(const ReadBody& read) {
  const modeling::Body& body = read.project.body;
  std::string text;
  if (const auto* solid = std::get_if<modeling::Solid>(&body)) {
    text = format("solid      %zu patches over %zu control points\n", solid->patches().size(),
                  solid->controlPoints().size());
  } else {
    const auto& mesh = std::get<modeling::MeshBody>(body);
    text = format("mesh body  %zu %s, %zu vertices, %zu triangles\n", mesh.faceNames().size(),
                  mesh.faceNames().size() == 1 ? "face" : "faces", mesh.positions().size(),
                  mesh.triangles().size());
  }
  text += "patches    " + modeling::quotedPatchNames(body) + "\n";
  text += format("volume     %.6g mm³\n", modeling::volume(body));
  if (read.deviation > 0) text += format("deviation  %.2g mm\n", read.deviation);
  for (const std::string& note : read.notes) text += "note       " + note + "\n";
  return text;
}

}  // namespace palpa::cli
