#pragma once

#include <span>
#include <string>

#include "app/cli/command.h"
#include "app/core/results/touch_sweep.h"

namespace palpa::cli {

/// The curve of `touch --sweep`; docs/guide/command-line.md documents the keys.
Json sweepJson(std::span<const app::SweepRow> rows);
/// A line per touch and state; empty without rows.
std::string sweepText(std::span<const app::SweepRow> rows);

}  // namespace palpa::cli
