#include <iostream>

#include "app/cli/body_choice.h"
#include "app/cli/body_file.h"
#include "app/cli/commands.h"
#include "app/cli/errors.h"
#include "app/cli/output_option.h"
#include "app/cli/text.h"
#include "app/cli/values.h"
#include "app/core/session/import_all.h"
#include "modeling/exchange/file_format.h"
#include "modeling/project/project_file.h"

namespace palpa::cli {
namespace {

class ImportCommand : public Command {
 public:
  std::string name() const override { return "import"; }
  std::string summary() const override { return "Make a project from a CAD or mesh file"; }
  std::string example() const override {
    return "palpa-cli import bracket.step -o bracket.json\n"
           "  palpa-cli import gearbox.step --list\n"
           "  palpa-cli import gearbox.step --solid 2 -o lid.json\n"
           "  palpa-cli import gearbox.step --all -o parts\n"
           "  palpa-cli import scan.stl --unit in --up y -o scan.json";
  }

  void declare(CLI::App& options) override {
    options
        .add_option("file", file_, "File to read: " + modeling::endingsText(modeling::isImportable))
        ->required()
        ->type_name("");
    options.add_flag("--list", lists_, "List the solids of the file and write nothing");
    choice_.declare(options);
    options.add_flag("--all", takesAll_, "Write a project for each solid");
    choice_.declarePlacement(options);
    options
        .add_option("--edge-length", edgeLength_,
                    "Target length of mesh edges in mm (default: gives about 600 nodes)")
        ->type_name("LENGTH");
    options
        .add_option(
            "--tolerance", tolerance_,
            "Largest deviation of patches from curved faces in mm (default: 1e-4 of the size)")
        ->type_name("LENGTH");
    options.add_option("--name", name_, "Name of the project (default: the file's)")
        ->type_name("TEXT");
    output_.declare(options,
                    "Project file to write (default: standard output); with --all a folder, or a "
                    "pattern as parts/{number}_{name}.json");
  }

  void run(const Context& context) override {
    modeling::ImportOptions options;
    if (!edgeLength_.empty()) options.edgeLength = parsePositive("--edge-length", edgeLength_);
    if (!tolerance_.empty()) options.tolerance = parsePositive("--tolerance", tolerance_);
    choice_.addTo(options);
    if (modeling::fileFormatOf(file_) == modeling::FileFormat::kProject)
      throw UsageError("import: " + file_ + " is a project already");
    if (lists_) return list(context, options);
    if (takesAll_) return importAll(context, options);
    ReadBody read = readBody(file_, options, context.job());
    if (!name_.empty()) read.project.name = name_;
    modeling::checkProject(read.project);
    if (!output_.isGiven()) {
      std::cout << modeling::toJson(read.project);
      return;
    }
    modeling::writeProject(read.project, output_.path());
    Json report{{"file", output_.path()}, {"name", read.project.name}};
    report.update(toJson(read));
    report["proposed_support"] = toJson(*read.held);
    context.print(report, output_.path() + ": made from " + file_ + ", held on " +
                              read.held->description() + "\n" + toText(read));
  }

 private:
  void list(const Context& context, const modeling::ImportOptions& options) {
    if (takesAll_ || choice_.hasSolid() || output_.isGiven())
      throw UsageError("--list writes nothing; give it without --all, --solid and -o");
    const modeling::FileBodies found = modeling::listBodies(
        file_, options.placement, modeling::ListedSurface::kNone, context.job());
    Json report{{"file", file_}};
    report.update(toJson(found));
    const std::size_t count = found.bodies.size();
    context.print(report, file_ + format(": %zu solid%s\n", count, count == 1 ? "" : "s") +
                              toText(found, options.placement));
  }

  void importAll(const Context& context, const modeling::ImportOptions& options) {
    if (choice_.hasSolid() || !name_.empty())
      throw UsageError("--all takes every solid by its name; give it without --solid and --name");
    if (!output_.isGiven())
      throw UsageError("--all needs -o with a folder, or a pattern as parts/{number}_{name}.json");
    const bool isFolder = !app::isFilePattern(output_.path());
    if (isFolder && modeling::fileFormatOf(output_.path()) == modeling::FileFormat::kProject)
      throw UsageError("-o " + output_.path() +
                       " is one file for all solids; give a folder, or a pattern as "
                       "parts/{number}_{name}.json");
    if (!isFolder) modeling::requireFormat(output_.path(), modeling::isProject);
    const modeling::FileBodies found = modeling::listBodies(
        file_, options.placement, modeling::ListedSurface::kNone, context.job());
    const auto saved = app::importAll(file_, found, options,
                                      app::projectFiles(found, output_.path()), context.job());
    Json report{{"file", file_}};
    report.update(toJson(found));
    std::string text;
    std::size_t problems = 0;
    for (std::size_t i = 0; i < saved.size(); ++i) {
      Json& solid = report["solids"][i];
      const std::string line = format("%3zu  ", i + 1);
      if (saved[i].problem.empty()) {
        solid["project"] = saved[i].file.string();
        text += line + saved[i].file.string() + "\n";
      } else {
        solid["problem"] = saved[i].problem;
        text += line + "not written: " + saved[i].problem + "\n";
        ++problems;
      }
    }
    context.print(
        report, file_ +
                    format(": %zu of %zu solids written\n", saved.size() - problems, saved.size()) +
                    text);
    if (problems > 0)
      throw ReportedFailure(
          file_ + format(": %zu of %zu solids could not be imported", problems, saved.size()));
  }

  std::string file_;
  BodyChoice choice_;
  bool lists_ = false;
  bool takesAll_ = false;
  std::string edgeLength_;
  std::string tolerance_;
  std::string name_;
  OutputOption output_;
};

}  // namespace

std::unique_ptr<Command> makeImportCommand() {
  return std::make_unique<ImportCommand>();
}

}  // namespace palpa::cli
