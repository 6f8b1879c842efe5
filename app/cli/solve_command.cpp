#include "app/cli/commands.h"
#include "app/cli/deformed_file.h"
#include "app/cli/output_option.h"
#include "app/cli/project_input.h"
#include "app/cli/result_file.h"
#include "app/cli/sample_options.h"
#include "app/cli/state_report.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/results/error_estimate.h"

namespace palpa::cli {
namespace {

class SolveCommand : public Command {
 public:
  std::string name() const override { return "solve"; }
  std::string summary() const override { return "Solve for a project's supports and loads"; }
  std::string example() const override {
    return "palpa-cli solve ball.json --sample 0,0,25 --json";
  }

  void declare(CLI::App& options) override {
    input_.declare(options);
    input_.declareModel(options);
    samples_.declare(options);
    output_.declare(options, resultFileHelp());
    deformed_.declare(options);
  }

  void run(const Context& context) override {
    samples_.validate();
    if (output_.isGiven()) requireResultFileName(output_.path());
    deformed_.validate();
    const modeling::Project project = input_.read(context);
    const auto model = app::buildTouchModel(project, input_.buildOptions(), context.job());
    app::TouchState state = model->rest();
    app::addErrors(*model, state, context.job());
    const StateReport report{*model, state, samples_.evaluate(*model, state), 0,
                             samples_.hasFormerName()};
    if (output_.isGiven()) writeResult(*model, state, report.json(), output_.path());
    deformed_.write(project, *model, state, context);
    context.print(report.json(), report.text());
  }

 private:
  ProjectInput input_;
  SampleOptions samples_;
  OutputOption output_;
  DeformedFile deformed_;
};

}  // namespace

std::unique_ptr<Command> makeSolveCommand() {
  return std::make_unique<SolveCommand>();
}

}  // namespace palpa::cli
