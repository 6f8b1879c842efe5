#include <algorithm>

#include "app/cli/commands.h"
#include "app/cli/errors.h"
#include "app/cli/geometry_report.h"
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
    const modeling::Job job{context.stop, [&](std::string_view phase, double fraction) {
                              context.progress.show(phase, fraction);
                            }};
    const modeling::SurfaceMesh mesh = modeling::mesh(project.body, project.mesh, regions, job);
    const modeling::MeshQuality quality = modeling::measureQuality(mesh);
    const auto findings = modeling::checkGeometry(mesh, project.body, job);
    const auto errors = std::count_if(findings.begin(), findings.end(),
                                      [](const auto& finding) { return finding.isError; });
    if (errors > 0) {
      Json report{{"valid", false}, {"name", project.name}};
      report.update(toJson(mesh, quality));
      report["geometry"] = toJson(findings);
      context.print(report, toText(mesh, quality) + toText(findings));
      throw ReportedFailure(input_.file() + format(": the geometry has %d fault%s",
                                                   static_cast<int>(errors),
                                                   errors > 1 ? "s" : ""));
    }
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
    report["geometry"] = toJson(findings);
    report["memory_MiB"] = memory / (1024.0 * 1024.0);
    context.print(report, input_.file() + ": valid\n" + toText(mesh, quality) + toText(findings) +
                              "memory     " + app::formatBytes(memory) + " to solve\n");
  }

 private:
  ProjectInput input_;
};

}  // namespace

std::unique_ptr<Command> makeCheckCommand() {
  return std::make_unique<CheckCommand>();
}

}  // namespace palpa::cli
