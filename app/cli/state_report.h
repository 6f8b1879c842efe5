#pragma once

#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/core/model/touch_model.h"
#include "app/core/results/field_sample.h"

namespace palpa::cli {

/// Report of `solve`, `touch` and `render` on a state. docs/guide/command-line.md documents the
/// keys of the JSON object.
struct StateReport {
  const app::TouchModel& model;
  const app::TouchState& state;
  std::vector<app::FieldSample> samples;
  double touchSeconds = 0;    ///< s, 0 without touches
  bool hasFormerKey = false;  ///< json() has the samples as "probes", too

  Json json() const;
  std::string text() const;
};

}  // namespace palpa::cli
