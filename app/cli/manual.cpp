#include "app/cli/manual.h"

#include <sstream>
#include <vector>

namespace palpa::cli {
namespace {

/// Escapes minus signs, backslashes, and a dot or quote at the start of a line for troff.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n'))
      result += std::string("\\&") + c;
    else
      result += c;
  }
  return result;
}

std::vector<const CLI::App*> commandsOf(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<const CLI::Option*> optionsOf(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

/// All names of an option and the name of its value.
std::string heading(const CLI::Option& option) {
  std::string text;
  for (const std::string& name : option.get_snames()) text += "-" + name + ", ";
  for (const std::string& name : option.get_lnames()) text += "--" + name + ", ";
  text = text.empty() ? option.get_name(true) : text.substr(0, text.size() - 2);
  const bool hasValue = option.get_items_expected_max() > 0 && !option.get_type_name().empty();
  return hasValue && option.nonpositional() ? text + " " + option.get_type_name() : text;
}

void writeOptions(const CLI::App& app, std::ostream& out) {
  for (const CLI::Option* option : optionsOf(app))
    out << ".TP\n.B " << escaped(heading(*option)) << '\n'
        << escaped(option->get_description()) << '\n';
}

void writeText(const std::string& text, std::ostream& out) {
  out << ".nf\n" << escaped(text) << "\n.fi\n";
}

}  // namespace

std::string manualPage(const CLI::App& app) {
  std::ostringstream out;
  const std::string description = app.get_description();
  const std::size_t firstLine = description.find('\n');
  out << ".TH PALPA\\-CLI 1 \"\" \"Palpa\" \"User Commands\"\n.SH NAME\n"
      << "palpa\\-cli \\- model elastic solids with spline patches and touch them\n"
      << ".SH SYNOPSIS\n.B palpa\\-cli\n.I COMMAND\n[\\fIoptions\\fR]\n.SH DESCRIPTION\n"
      << escaped(description.substr(0, firstLine)) << '\n';
  if (firstLine != std::string::npos)
    out << ".PP\n" << escaped(description.substr(firstLine + 1)) << '\n';
  out << ".SH OPTIONS\n";
  writeOptions(app, out);
  out << ".SH COMMANDS\n";
  for (const CLI::App* command : commandsOf(app)) {
    out << ".SS palpa\\-cli " << escaped(command->get_name()) << '\n'
        << escaped(command->get_description()) << '\n';
    writeOptions(*command, out);
    out << ".PP\n";
    writeText(command->get_footer(), out);
  }
  out << ".SH NOTES\n";
  writeText(app.get_footer(), out);
  out << ".SH SEE ALSO\n.BR palpa (1)\n";
  return out.str();
}

std::string bashCompletion(const CLI::App& app) {
  const auto namesOf = [](const CLI::App& of) {
    std::string names;
    for (const CLI::Option* option : optionsOf(of)) {
      for (const std::string& name : option->get_lnames()) names += " --" + name;
      for (const std::string& name : option->get_snames()) names += " -" + name;
    }
    return names.empty() ? names : names.substr(1);
  };
  std::ostringstream out;
  out << "# bash completion for palpa-cli\n_palpa_cli() {\n"
      << "  local word=${COMP_WORDS[COMP_CWORD]} options\n  COMPREPLY=()\n"
      << "  if [[ $COMP_CWORD -eq 1 ]]; then\n    COMPREPLY=($(compgen -W \"" << namesOf(app);
  for (const CLI::App* command : commandsOf(app)) out << ' ' << command->get_name();
  out << "\" -- \"$word\"))\n    return\n  fi\n  case ${COMP_WORDS[1]} in\n";
  for (const CLI::App* command : commandsOf(app))
    out << "    " << command->get_name() << ") options=\"" << namesOf(*command) << "\" ;;\n";
  out << "  esac\n  [[ $word != -* ]] || COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n}\n"
      << "complete -o default -F _palpa_cli palpa-cli\n";
  return out.str();
}

}  // namespace palpa::cli
