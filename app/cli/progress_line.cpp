#include "app/cli/progress_line.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace palpa::cli {

ProgressLine::ProgressLine(bool wanted) : enabled_(wanted && isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  clear();
}

void ProgressLine::show(std::string_view phase, double fraction) {
  if (!enabled_) return;
  const std::scoped_lock lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (!shown_.empty() && fraction < 1 && now - last_ < std::chrono::milliseconds(50)) return;
  last_ = now;
  const int percent = static_cast<int>(100 * std::clamp(fraction, 0.0, 1.0));
  shown_ = std::string(phase) + "  " + std::to_string(percent) + " %";
  std::fprintf(stderr, "\r\033[K%s", shown_.c_str());
}

void ProgressLine::clear() {
  const std::scoped_lock lock(mutex_);
  if (!shown_.empty()) std::fprintf(stderr, "\r\033[K");
  shown_.clear();
}

}  // namespace palpa::cli
