#include "app/cli/command.h"

#include <iostream>

#include "app/cli/errors.h"

namespace palpa::cli {

Job Context::job() const {
  return {stop,
          [&line = progress](Phase phase, double fraction) { line.show(nameOf(phase), fraction); },
          options.threads};
}

void Context::print(const Json& report, const std::string& text) const {
  progress.clear();
  if (options.json) {
    // Names in files may be any bytes; invalid UTF-8 must not end the program.
    std::cout << report.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  } else if (!options.quiet) {
    std::cout << text;
  }
  std::cout.flush();
  if (!std::cout) throw OutputError("cannot write to standard output");
}

}  // namespace palpa::cli
