// palpa-cli: the command line of Palpa. One file per subcommand; see docs/guide/command-line.md.
#include <algorithm>
#include <iostream>
#include <string_view>

#include "app/cli/command.h"
#include "app/cli/errors.h"
#include "app/cli/help_format.h"
#include "app/cli/interrupt.h"
#include "app/cli/manual.h"
#include "app/cli/usage_message.h"
#include "app/core/system/memory.h"

namespace palpa::cli {
namespace {

/// Thrown by options that print a text and end the program.
struct Printed : CLI::Success {
  explicit Printed(std::string what) : text(std::move(what)) {}
  std::string text;
};

void declareCommon(CLI::App& app, CommonOptions& options) {
  app.add_flag("--json", options.json, "Write one JSON object instead of text");
  app.add_flag("-q,--quiet", options.quiet, "Write neither text nor progress");
  app.add_option("--threads", options.threads, "Number of threads; 0 means all cores")
      ->check(CLI::Range(0, 1024).description(""))
      ->type_name("N");
}

void report(const Failure& failure, bool asJson) {
  std::cerr << "palpa-cli: " << failure.message << '\n';
  if (!asJson) return;
  const Json error{{"error",
                    {{"kind", failure.kind},
                     {"exit_code", static_cast<int>(failure.code)},
                     {"message", failure.message}}}};
  std::cout << error.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

int run(int argc, char** argv) {
  CLI::App app(
      "Palpa: model a solid with spline patches and touch it as a real elastic body.\n"
      "Lengths in mm, forces in N, stresses in MPa.");
  app.name("palpa-cli");
  app.formatter(std::make_shared<HelpFormat>());
  app.set_help_flag("-h,--help", "Show this help");
  app.set_version_flag("-V,--version", "palpa-cli " PALPA_VERSION, "Show the version");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 2 usage, 3 bad input, 4 cannot be solved, 5 cancelled.\n"
      "'palpa-cli COMMAND --help' shows the options of a command and an example.");

  // For packages. Without a group the help does not list them.
  app.add_flag_callback("--manual", [&app] { throw Printed(manualPage(app)); })->group("");
  app.add_flag_callback("--bash-completion", [&app] { throw Printed(bashCompletion(app)); })
      ->group("");

  CommonOptions options;
  const auto commands = allCommands();
  std::vector<CLI::App*> declared;
  for (const auto& command : commands) {
    CLI::App* sub = app.add_subcommand(command->name(), command->summary());
    sub->group("Commands");
    command->declare(*sub);
    declareCommon(*sub, options);
    const bool areSeveral = command->example().find('\n') != std::string::npos;
    sub->footer((areSeveral ? "Examples:\n  " : "Example:\n  ") + command->example());
    declared.push_back(sub);
  }

  try {
    app.parse(argc, argv);
  } catch (const Printed& printed) {
    std::cout << printed.text;
    return kDone;
  } catch (const CLI::Success& success) {
    return app.exit(success);  // --help, --version
  } catch (const CLI::ParseError& error) {
    // CLI11 may stop before it reads --json.
    const bool asJson = std::any_of(argv, argv + argc,
                                    [](std::string_view argument) { return argument == "--json"; });
    report({kUsage, "usage", usageMessage(error, app, argc, argv)}, asJson);
    return kUsage;
  }

  ProgressLine progress(!options.quiet);
  try {
    const Interrupt interrupt;
    const Context context{options, interrupt.token(), progress};
    for (std::size_t i = 0; i < commands.size(); ++i) {
      if (declared[i]->parsed()) commands[i]->run(context);
    }
    return kDone;
  } catch (...) {
    progress.clear();
    const Failure failure = currentFailure();
    report(failure, options.json && !failure.isReported);
    return failure.code;
  }
}

}  // namespace
}  // namespace palpa::cli

int main(int argc, char** argv) {
  palpa::app::reuseFreedMemory();
  return palpa::cli::run(argc, argv);
}
