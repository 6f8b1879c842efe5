#include "app/cli/commands.h"
#include "app/cli/mesh_report.h"
#include "app/cli/project_input.h"
#include "app/cli/text.h"
#include "app/core/boundary_setup.h"
#include "app/core/memory.h"
#include "app/core/probe.h"
#include "bem/reference_problem.h"

namespace palpa::cli {
namespace {

class CheckCommand : public Command {
 public:
  std::string name() const override { return "check"; }
  std::string summary() const override { return "Validate a project without solving it"; }
  std::string example() const override { return "palpa-cli check ball.json"; }

  void declare(CLI::App& options) override { input_.declare(options); }

  void run(const Context& context) override {
    const modeling::Project project = input_.read();
    const auto regions = modeling::meshRegions(project);
    const modeling::SurfaceMesh mesh = modeling::mesh(project.body, project.mesh, regions);
    const modeling::MeshQuality quality = modeling::measureQuality(mesh);
    const app::BoundarySetup setup = app::makeBoundarySetup(project, mesh);
    const auto& conditions = setup.conditions.ofSlot;
    const bem::DegreesOfFreedom dofs(setup.mesh, setup.slots, conditions, setup.material);
    bem::checkSolvable(setup.mesh, setup.slots, conditions, dofs, setup.material);
    for (const modeling::Touch& touch : project.touches) {
      app::checkNearSurface(setup.mesh, touch.at, "the touch \"" + touch.name + "\"");
    }
    const double memory =
        bem::estimateBytes(setup.mesh.nodeCount(), setup.slots.count(), bem::Precision::kAutomatic);

    Json report{{"valid", true}, {"name", project.name}};
    report.update(toJson(mesh, quality));
    report["memory_MiB"] = memory / (1024.0 * 1024.0);
    context.print(report, input_.file() + ": valid\n" + toText(mesh, quality) + "memory     " +
                              app::formatBytes(memory) + " to solve\n");
  }

 private:
  ProjectInput input_;
};

}  // namespace

std::unique_ptr<Command> makeCheckCommand() {
  return std::make_unique<CheckCommand>();
}

}  // namespace palpa::cli
