#include "app/cli/body_file.h"
#include "app/cli/commands.h"
#include "app/cli/errors.h"
#include "app/cli/output_option.h"
#include "app/cli/project_input.h"
#include "modeling/exchange/file_format.h"

namespace palpa::cli {
namespace {

class ExportCommand : public Command {
 public:
  std::string name() const override { return "export"; }
  std::string summary() const override { return "Write a project's body to a CAD or mesh file"; }
  std::string example() const override { return "palpa-cli export ball.json -o ball.step"; }

  void declare(CLI::App& options) override {
    input_.declare(options);
    output_
        .declare(options, "File to write: " + modeling::endingsText(modeling::isCad) +
                              " (the solid), " + modeling::endingsText(modeling::isWritableMesh) +
                              " (its mesh)")
        ->required();
  }

  void run(const Context& context) override {
    if (modeling::requireFormat(output_.path(), modeling::isWritable) ==
        modeling::FileFormat::kProject)
      throw UsageError(
          "export: --output must be a CAD or mesh file; palpa-cli convert copies projects");
    const ReadBody read = input_.readWithNotes(context.job());
    writeBody(read.project, output_.path(), input_.hasEdgeLength(), context.job());
    Json report{{"file", output_.path()}};
    report.update(toJson(read));
    context.print(report, output_.path() + ": written from " + input_.file() + "\n" + toText(read));
  }

 private:
  ProjectInput input_;
  OutputOption output_;
};

}  // namespace

std::unique_ptr<Command> makeExportCommand() {
  return std::make_unique<ExportCommand>();
}

}  // namespace palpa::cli
