#include "app/cli/body_choice.h"
#include "app/cli/body_file.h"
#include "app/cli/commands.h"
#include "app/cli/errors.h"
#include "app/cli/output_option.h"
#include "app/cli/values.h"
#include "modeling/exchange/file_format.h"

namespace palpa::cli {
namespace {

class ConvertCommand : public Command {
 public:
  std::string name() const override { return "convert"; }
  std::string summary() const override { return "Convert a body between file formats"; }
  std::string example() const override {
    return "palpa-cli convert bracket.step -o bracket.stl --edge-length 2\n"
           "  palpa-cli convert ball.json -o ball.igs";
  }

  void declare(CLI::App& options) override {
    options
        .add_option("file", file_, "File to read: " + modeling::endingsText(modeling::isReadable))
        ->required()
        ->type_name("");
    options
        .add_option("--edge-length", edgeLength_,
                    "Target length of mesh edges in mm (default: the project's, or a suitable one)")
        ->type_name("LENGTH");
    options
        .add_option(
            "--tolerance", tolerance_,
            "Largest deviation of patches from curved faces in mm (default: 1e-4 of the size)")
        ->type_name("LENGTH");
    choice_.declare(options);
    choice_.declarePlacement(options);
    output_.declare(options, "File to write: " + modeling::endingsText(modeling::isWritable))
        ->required();
  }

  void run(const Context& context) override {
    modeling::ImportOptions options;
    if (!edgeLength_.empty()) options.edgeLength = parsePositive("--edge-length", edgeLength_);
    if (!tolerance_.empty()) options.tolerance = parsePositive("--tolerance", tolerance_);
    choice_.addTo(options);
    if (choice_.isGiven() && modeling::fileFormatOf(file_) == modeling::FileFormat::kProject)
      throw UsageError(file_ +
                       " is a project, which has one body in mm; --solid, --unit, --scale "
                       "and --up are for CAD and mesh files");
    modeling::requireFormat(output_.path(), modeling::isWritable);
    const Job job = context.job();
    ReadBody read = readBody(file_, options, job);
    if (options.edgeLength > 0) read.project.mesh.edgeLength = options.edgeLength;
    writeBody(read.project, output_.path(), options.edgeLength > 0, job);
    Json report{{"file", output_.path()}};
    report.update(toJson(read));
    context.print(report, output_.path() + ": converted from " + file_ + "\n" + toText(read));
  }

 private:
  std::string file_;
  std::string edgeLength_;
  std::string tolerance_;
  BodyChoice choice_;
  OutputOption output_;
};

}  // namespace

std::unique_ptr<Command> makeConvertCommand() {
  return std::make_unique<ConvertCommand>();
}

}  // namespace palpa::cli
