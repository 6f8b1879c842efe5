#include "app/cli/output_option.h"

#include <filesystem>

namespace palpa::cli {

CLI::Option* OutputOption::declare(CLI::App& options, const std::string& help) {
  return options.add_option("-o,--output", path_, help)->type_name("FILE");
}

std::string OutputOption::ending() const {
  return std::filesystem::path(path_).extension();
}

void OutputOption::addTo(Json& report, std::string& text) const {
  report["file"] = path_;
  text += "written    " + path_ + "\n";
}

}  // namespace palpa::cli
