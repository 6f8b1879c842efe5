#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/cli/command.h"
#include "app/core/page/make_touch_page.h"

namespace palpa::cli {

/// The options of a page that can be touched: --places, --page-size, --radius.
class PageOptions {
 public:
  void declare(CLI::App& options);
  bool isGiven() const { return !places_.empty() || !size_.empty() || !radius_.empty(); }
  /// Throws UsageError for a number out of range. Call it before long work.
  app::TouchPageSettings settings() const;

 private:
  std::string places_, size_, radius_;
};

/// Size of the file, number of places, errors.
Json toJson(const app::TouchPage& page, double bytes);
std::string toText(const app::TouchPage& page, double bytes);

}  // namespace palpa::cli
