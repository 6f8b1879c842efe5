#include <iostream>

#include "app/cli/body_file.h"
#include "app/cli/commands.h"
#include "app/cli/errors.h"
#include "app/cli/output_option.h"
#include "app/cli/values.h"
#include "modeling/exchange/file_format.h"
#include "modeling/project/project_file.h"

namespace palpa::cli {
namespace {

class ImportCommand : public Command {
 public:
  std::string name() const override { return "import"; }
  std::string summary() const override { return "Make a project from a CAD or mesh file"; }
  std::string example() const override { return "palpa-cli import bracket.step -o bracket.json"; }

  void declare(CLI::App& options) override {
    options
        .add_option("file", file_, "File to read: " + modeling::endingsText(modeling::isImportable))
        ->required()
        ->type_name("");
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
    output_.declare(options, "Project file to write (default: standard output)");
  }

  void run(const Context& context) override {
    modeling::ImportOptions options;
    if (!edgeLength_.empty()) options.edgeLength = parsePositive("--edge-length", edgeLength_);
    if (!tolerance_.empty()) options.tolerance = parsePositive("--tolerance", tolerance_);
    if (modeling::fileFormatOf(file_) == modeling::FileFormat::kProject)
      throw UsageError("import: " + file_ + " is a project already");
    ReadBody read = readBody(file_, options, context.job());
    if (!name_.empty()) read.project.name = name_;
    if (options.edgeLength > 0) read.project.mesh.edgeLength = options.edgeLength;
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
  std::string file_;
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
