#include "app/cli/commands.h"
#include "app/cli/errors.h"
#include "app/cli/output_option.h"
#include "app/cli/text.h"
#include "base/job.h"
#include "modeling/editing/change.h"
#include "modeling/editing/command_file.h"
#include "modeling/error.h"
#include "modeling/project/project_file.h"
#include "modeling/solid/tangent_continuity.h"

namespace palpa::cli {
namespace {

/// The parts that a command changed, except points: "supports, loads".
std::vector<std::string> changedParts(const modeling::Change& change) {
  std::vector<std::string> parts;
  const auto add = [&](bool changed, const char* name) {
    if (changed) parts.push_back(name);
  };
  add(change.topology, "topology");
  add(change.edges, "edges");
  add(change.patchNames, "patch names");
  add(change.primitive, "primitive");
  add(change.name, "name");
  add(change.material, "material");
  add(change.supports, "supports");
  add(change.loads, "loads");
  add(change.touches, "touches");
  add(change.measurements, "measurements");
  add(change.design, "design");
  add(change.mesh, "mesh");
  return parts;
}

class EditCommand : public Command {
 public:
  std::string name() const override { return "edit"; }
  std::string summary() const override { return "Apply editing commands to a project"; }
  std::string example() const override {
    return "palpa-cli edit block.json --commands bulge.json -o bulged.json\n"
           "  palpa-cli edit block.json --commands bulge.json --in-place";
  }

  void declare(CLI::App& options) override {
    options.add_option("file", file_, "Project file (JSON)")->required()->type_name("");
    options.add_option("--commands", commands_, "Commands to apply (JSON; docs/editing.md)")
        ->required()
        ->type_name("FILE");
    output_.declare(options, "Project file to write");
    options.add_flag("--in-place", inPlace_, "Write the result over the project file");
  }

  void run(const Context& context) override {
    if (inPlace_ == output_.isGiven())
      throw UsageError("give either -o FILE or --in-place, so that nothing is overwritten unasked");
    modeling::Project project = modeling::readProject(file_);
    const std::vector<modeling::Command> commands = modeling::readCommands(commands_);
    const std::string target = inPlace_ ? file_ : output_.path();
    Json steps = Json::array();
    std::string text;
    for (std::size_t i = 0; i < commands.size(); ++i) {
      if (context.stop.stop_requested()) throw Cancelled{};
      const modeling::Edited edited = applied(commands[i], project, i);
      const modeling::Change change = modeling::compare(project, edited.project);
      project = edited.project;
      steps.push_back(report(commands[i], change, edited));
      text += line(i, commands[i], change, edited);
    }
    modeling::writeProject(project, target);
    Json report{{"file", target}, {"commands", steps}};
    if (const auto* solid = std::get_if<modeling::Solid>(&project.body)) {
      const double angle = modeling::largestTangentAngle(*solid);
      report["largest_angle_across_smooth_edges_rad"] = angle;
      text += format("largest angle across smooth edges: %.3g rad\n", angle);
    }
    context.print(report, text + target + ": written\n");
  }

 private:
  /// Errors name the command by its position in the file.
  modeling::Edited applied(const modeling::Command& command, const modeling::Project& project,
                           std::size_t index) const {
    try {
      return modeling::apply(command, project);
    } catch (const modeling::ModelingError& error) {
      throw modeling::ModelingError(commands_ + ": commands[" + std::to_string(index) + "] (" +
                                        modeling::label(command) + "): " + error.what(),
                                    error.kind());
    }
  }

  static Json report(const modeling::Command& command, const modeling::Change& change,
                     const modeling::Edited& edited) {
    Json patches = Json::array();
    const std::vector<std::string> names = modeling::patchNames(edited.project.body);
    for (int patch : change.changedPatches) patches.push_back(names[patch]);
    return {{"label", modeling::label(command)},
            {"moved_points", change.movedPoints.size()},
            {"changed_patches", patches},
            {"changed", changedParts(change)},
            {"deviation_mm", edited.deviation}};
  }

  static std::string line(std::size_t index, const modeling::Command& command,
                          const modeling::Change& change, const modeling::Edited& edited) {
    std::string text = format("%3zu  ", index) + modeling::label(command) + ": ";
    std::string what;
    const auto add = [&](const std::string& part) { what += (what.empty() ? "" : ", ") + part; };
    if (!change.movedPoints.empty())
      add(format("%zu points moved in %zu patches", change.movedPoints.size(),
                 change.changedPatches.size()));
    const auto* solid = std::get_if<modeling::Solid>(&edited.project.body);
    if (change.topology && solid) add(format("%zu control points", solid->controlPoints().size()));
    for (const std::string& part : changedParts(change))
      if (part != "topology") add(part + " changed");
    if (edited.deviation > 0) add(format("deviation %.3g mm", edited.deviation));
    return text + (what.empty() ? "no change" : what) + "\n";
  }

  std::string file_;
  std::string commands_;
  OutputOption output_;
  bool inPlace_ = false;
};

}  // namespace

std::unique_ptr<Command> makeEditCommand() {
  return std::make_unique<EditCommand>();
}

}  // namespace palpa::cli
