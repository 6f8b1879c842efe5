#include "app/cli/usage_message.h"

#include <string_view>
#include <vector>

#include "app/cli/suggestion.h"

namespace palpa::cli {
namespace {

std::vector<std::string> commandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::vector<std::string> optionNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group().empty()) continue;  // a former name
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// The first word that is no option of the command; "--radius=3" counts as "--radius".
std::string unknownOption(const CLI::App& command, int argc, const char* const* argv) {
  for (int i = 2; i < argc; ++i) {
    const std::string word(argv[i]);
    const std::string name = word.substr(0, word.find('='));
    // Numbers such as -1,0,0 are values.
    const bool isOption =
        name.size() > 1 && name[0] == '-' && !(name[1] >= '0' && name[1] <= '9') && name[1] != '.';
    if (isOption && !command.get_option_no_throw(name)) return name;
  }
  return {};
}

std::string readOn(const std::string& command) {
  return "; see palpa-cli " + (command.empty() ? command : command + " ") + "--help";
}

}  // namespace

std::string usageMessage(const CLI::ParseError& error, const CLI::App& app, int argc,
                         const char* const* argv) {
  const std::vector<std::string> commands = commandNames(app);
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  if (argc > 1 && argv[1][0] == '-')
    return std::string(argv[1]) + " stands where the command belongs" + readOn({});
  if (chosen.empty()) {
    if (argc < 2) {
      std::string all;
      for (const std::string& name : commands) all += (all.empty() ? "" : ", ") + name;
      return "name a command: " + all + readOn({});
    }
    const std::string word(argv[1]);
    return "there is no command '" + word + "'" + didYouMean(word, commands) + readOn({});
  }
  const CLI::App& command = *chosen.front();
  const auto code = static_cast<CLI::ExitCodes>(error.get_exit_code());
  const std::string help = readOn(command.get_name());
  if (code == CLI::ExitCodes::ExtrasError) {
    const std::string option = unknownOption(command, argc, argv);
    if (!option.empty())
      return command.get_name() + " has no option " + option +
             didYouMean(option, optionNames(command)) + help;
    const std::vector<std::string> extras = app.remaining(true);
    if (!extras.empty())
      return command.get_name() + " does not expect '" + extras.front() + "'" + help;
  }
  if (code == CLI::ExitCodes::RequiredError) {
    for (const CLI::Option* option : command.get_options())
      if (option->get_required() && option->count() == 0)
        return command.get_name() + " needs " +
               (option->get_positional() ? "a " + option->get_name(true) : option->get_name()) +
               help;
  }
  return error.what() + help;
}

}  // namespace palpa::cli
