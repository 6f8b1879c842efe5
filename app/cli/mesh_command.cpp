#include "app/cli/body_file.h"
#include "app/cli/commands.h"
#include "app/cli/mesh_report.h"
#include "app/cli/output_option.h"
#include "app/cli/project_input.h"
#include "app/cli/text.h"
#include "modeling/exchange/file_format.h"
#include "modeling/exchange/mesh_writer.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/mesh_foci.h"

namespace palpa::cli {
namespace {

class MeshCommand : public Command {
 public:
  std::string name() const override { return "mesh"; }
  std::string summary() const override { return "Mesh the surface of a project's solid"; }
  std::string example() const override {
    return "palpa-cli mesh ball.json --edge-length 3 -o ball.stl";
  }

  void declare(CLI::App& options) override {
    input_.declare(options);
    output_.declare(options,
                    "Mesh file to write: " + modeling::endingsText(modeling::isWritableMesh) +
                        " (.vtp names patches and supports)");
  }

  void run(const Context& context) override {
    // Check the file name before the work.
    if (output_.isGiven()) modeling::requireFormat(output_.path(), modeling::isWritableMesh);
    const modeling::Project project = input_.read(context);
    const auto regions = modeling::meshRegions(project);
    const modeling::SurfaceMesh mesh = modeling::mesh(project.body, project.mesh, regions,
                                                      context.job(), modeling::meshFoci(project));
    const modeling::MeshQuality quality = modeling::measureQuality(mesh);
    Json report = toJson(mesh, quality);
    std::string text = toText(mesh, quality);
    if (output_.isGiven()) {
      modeling::writeMesh(meshFile(project, mesh), output_.path());
      output_.addTo(report, text);
    }
    context.print(report, text);
  }

 private:
  static modeling::MeshFile meshFile(const modeling::Project& project,
                                     const modeling::SurfaceMesh& mesh) {
    modeling::MeshFile file{mesh.positions, mesh.triangles, {}, {}};
    file.triangleData.push_back(
        {"patch", 1, {mesh.patchOfTriangle.begin(), mesh.patchOfTriangle.end()}});
    file.triangleData.push_back(
        {"smoothing_group",
         1,
         {mesh.smoothingGroupOfTriangle.begin(), mesh.smoothingGroupOfTriangle.end()}});
    // meshRegions() lists the supports first.
    modeling::MeshData support{"support", 1, std::vector<double>(mesh.triangles.size(), -1)};
    for (std::size_t i = 0; i < project.supports.size(); ++i) {
      for (const int triangle : mesh.trianglesOfRegion[i]) {
        support.values[static_cast<std::size_t>(triangle)] = static_cast<double>(i);
      }
    }
    file.triangleData.push_back(std::move(support));
    return file;
  }

  ProjectInput input_;
  OutputOption output_;
};

}  // namespace

std::unique_ptr<Command> makeMeshCommand() {
  return std::make_unique<MeshCommand>();
}

}  // namespace palpa::cli
