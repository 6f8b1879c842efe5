#pragma once

#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/core/model/touch_model.h"
#include "app/core/results/field_sample.h"

namespace palpa::cli {

/// What `solve`, `touch` and `render` tell about a state. The keys of the JSON object are
/// documented in docs/guide/command-line.md.
struct StateReport {
  const app::TouchModel& model;
  const app::TouchState& state;
  std::vector<app::FieldSample> probes;
  double touchSeconds = 0;  ///< s, 0 without touches

  Json json() const;
  std::string text() const;
};

}  // namespace palpa::cli
