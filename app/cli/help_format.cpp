#include "app/cli/help_format.h"

#include <sstream>

namespace palpa::cli {
namespace {

constexpr std::size_t kNameColumns = 28;  // columns
constexpr std::size_t kTextColumns = 80 - kNameColumns;

/// Characters, not bytes: "…" and "°" take one column.
std::size_t columnsOf(const std::string& text) {
  std::size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  return count;
}

std::string wrapped(const std::string& text) {
  std::istringstream words(text);
  std::string result, word;
  std::size_t used = 0;
  while (words >> word) {
    const std::size_t size = columnsOf(word);
    if (used > 0 && used + 1 + size > kTextColumns) {
      result += '\n';
      used = 0;
    }
    if (used > 0) result += ' ';
    used += (used > 0) + size;
    result += word;
  }
  return result;
}

}  // namespace

HelpFormat::HelpFormat() {
  column_width(kNameColumns);
  label("SUBCOMMAND", "COMMAND");
  label("OPTIONS", "options");
  label("REQUIRED", "(required)");
  label("Positionals", "Arguments");
}

std::string HelpFormat::make_option_desc(const CLI::Option* option) const {
  return wrapped(option->get_description());
}

std::string HelpFormat::make_subcommand(const CLI::App* command) const {
  std::ostringstream out;
  CLI::detail::format_help(out, command->get_name(), wrapped(command->get_description()),
                           kNameColumns);
  return out.str();
}

}  // namespace palpa::cli
