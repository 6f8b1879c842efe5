#include "app/cli/commands.h"
#include "app/cli/deformed_file.h"
#include "app/cli/result_file.h"
#include "app/cli/simulation.h"
#include "app/cli/state_report.h"
#include "app/core/results/error_estimate.h"

namespace palpa::cli {
namespace {

class SolveCommand : public Command {
 public:
  std::string name() const override { return "solve"; }
  std::string summary() const override { return "Solve for a project's supports and loads"; }
  std::string example() const override { return "palpa-cli solve ball.json --probe 0,0,25 --json"; }

  void declare(CLI::App& options) override {
    input_.declare(options);
    probes_.declare(options);
    options.add_option("-o,--output", output_, kResultFileHelp)->type_name("FILE");
    deformed_.declare(options);
  }

  void run(const Context& context) override {
    probes_.validate();
    if (!output_.empty()) requireResultFileName(output_);
    deformed_.validate();
    const modeling::Project project = input_.read();
    const auto model = buildModel(project, context);
    app::TouchState state = model->rest();
    state.errorEstimate = app::estimateError(*model, state, jobOf(context));
    const StateReport report{*model, state, probes_.read(*model, state)};
    if (!output_.empty()) writeResult(*model, state, report.json(), output_);
    deformed_.write(project, *model, state, context);
    context.print(report.json(), report.text());
  }

 private:
  ProjectInput input_;
  ProbeInput probes_;
  std::string output_;
  DeformedFile deformed_;
};

}  // namespace

std::unique_ptr<Command> makeSolveCommand() {
  return std::make_unique<SolveCommand>();
}

}  // namespace palpa::cli
