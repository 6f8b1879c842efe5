#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/project_input.h"
#include "app/core/probe.h"
#include "app/core/touch_model.h"

namespace palpa::cli {

/// As the common options say: threads, progress, cancelling.
bem::Job jobOf(const Context& context);

/// Builds the model of a project.
std::shared_ptr<const app::TouchModel> buildModel(const modeling::Project& project,
                                                  const Context& context);

/// The options that describe a touch: --at with --displace or --force, --node, or none for the
/// project's recorded touches.
class TouchInput {
 public:
  void declare(CLI::App& options);

  /// Throws UsageError for combinations without meaning. To be called before the long work.
  void validate() const;

  /// True when the command line itself describes a touch.
  bool isGiven() const { return !at_.empty() || !node_.empty(); }

  app::TouchState play(const app::TouchModel& model, const modeling::Project& project) const;

 private:
  modeling::Touch touch() const;

  std::string at_;
  std::string node_;
  std::string displacement_;
  std::string force_;
  std::string radius_;
  std::string kind_ = "grab";
};

/// Places at which the solution is to be read off: --probe, any number.
class ProbeInput {
 public:
  void declare(CLI::App& options);
  void validate() const;
  std::vector<app::Probe> read(const app::TouchModel& model, const app::TouchState& state) const;

 private:
  std::vector<std::string> probes_;
};

}  // namespace palpa::cli
