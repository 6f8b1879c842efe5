#include "app/cli/body_file.h"
#include "app/cli/commands.h"
#include "app/cli/errors.h"
#include "app/cli/geometry_report.h"
#include "app/cli/mesh_report.h"
#include "app/cli/project_input.h"
#include "app/cli/text.h"
#include "app/core/model/model_memory.h"
#include "app/core/results/field_sample.h"
#include "app/core/setup/boundary_setup.h"
#include "app/core/system/memory.h"
#include "bem/base/error.h"
#include "modeling/error.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/mesh_foci.h"

namespace palpa::cli {
namespace {

class CheckCommand : public Command {
 public:
  std::string name() const override { return "check"; }
  std::string summary() const override { return "Validate a project without solving it"; }
  std::string example() const override { return "palpa-cli check ball.json"; }

  void declare(CLI::App& options) override { input_.declare(options); }

  void run(const Context& context) override {
    const modeling::Project project = input_.read(context);
    const auto regions = modeling::meshRegions(project);
    const Job job = context.job();
    const modeling::SurfaceMesh mesh =
        modeling::mesh(project.body, project.mesh, regions, job, modeling::meshFoci(project));
    const modeling::MeshQuality quality = modeling::measureQuality(mesh);
    const auto findings = modeling::checkGeometry(mesh, project.body, job);
    std::vector<Failure> problems;
    for (const auto& finding : findings) {
      if (finding.isError) problems.push_back({kBadInput, "bad_input", finding.message});
    }
    // Supports and touches on a faulty surface have no meaning.
    double memory = 0;
    if (problems.empty()) memory = checkSolution(project, mesh, problems);

    Json report{{"valid", problems.empty()}, {"name", project.name}};
    report.update(toJson(mesh, quality));
    report["geometry"] = toJson(findings);
    report["problems"] = Json::array();
    for (const Failure& problem : problems) report["problems"].push_back(problem.message);
    std::string text = toText(mesh, quality);
    for (const auto& finding : findings) {
      if (!finding.isError) text += "warning    " + finding.message + "\n";
    }
    for (const Failure& problem : problems) text += "error      " + problem.message + "\n";
    if (problems.empty()) {
      report["memory_MiB"] = memory / (1024.0 * 1024.0);
      text = input_.file() + ": valid\n" + text + "memory     " + app::formatBytes(memory) +
             " to solve\n";
    }
    context.print(report, text);
    if (problems.size() == 1) throw ReportedFailure(problems[0].message, problems[0].code);
    if (problems.size() > 1) {
      throw ReportedFailure(input_.file() + format(": %zu problems", problems.size()));
    }
  }

 private:
  /// Adds the reasons why the project cannot be solved or touched; returns the memory it needs,
  /// bytes.
  static double checkSolution(const modeling::Project& project, const modeling::SurfaceMesh& mesh,
                              std::vector<Failure>& problems) {
    const auto collect = [&](const auto& part) {
      try {
        part();
      } catch (const bem::SolverError&) {
        problems.push_back(currentFailure());
      } catch (const modeling::ModelingError&) {
        problems.push_back(currentFailure());
      }
    };
    double bytes = 0;
    collect([&] {
      const app::BoundarySetup setup = app::makeBoundarySetup(app::ProjectGeometry(project), mesh);
      for (const modeling::Touch& touch : project.touches) {
        collect([&] {
          app::checkNearSurface(setup.mesh(), touch.at, "the touch \"" + touch.name + "\"");
        });
      }
      const auto& conditions = setup.conditions.ofSlot;
      const bem::Discretisation& on = *setup.discretisation;
      on.checkSolvable(conditions, setup.material);
      bytes = app::expectedBytes(bem::sizeOf(on), setup.engine, bem::Precision::kAutomatic);
    });
    return bytes;
  }

  ProjectInput input_;
};

}  // namespace

std::unique_ptr<Command> makeCheckCommand() {
  return std::make_unique<CheckCommand>();
}

}  // namespace palpa::cli
