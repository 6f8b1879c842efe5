#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/project_input.h"
#include "app/core/model/touch_model.h"
#include "app/core/results/field_sample.h"

namespace palpa::cli {

/// Threads, progress and cancelling as the common options say.
Job jobOf(const Context& context);

/// Builds the model of a project as the common options say: threads, progress, cancelling.
std::shared_ptr<const app::TouchModel> buildModel(const modeling::Project& project,
                                                  const Context& context);

/// The options that describe touches: groups that begin with --at, --node, or none for the
/// project's recorded touches.
class TouchInput {
 public:
  void declare(CLI::App& options);

  /// Throws UsageError for combinations without meaning. To be called before the long work.
  void validate() const;

  /// True when the command line itself describes a touch.
  bool isGiven() const { return option(kAt).isGiven() || !node_.empty(); }

  bool hasSteps() const { return !steps_.empty(); }

  /// The project with the touches of the command line, if it has any, in place of its own: what the
  /// model is to be built for, as its elements follow the touches.
  modeling::Project touched(modeling::Project project) const;

  /// Throws SolverError, Cancelled.
  app::TouchState play(const app::TouchModel& model, const modeling::Project& project,
                       const Context& context) const;

 private:
  /// Options of one touch; each may occur once per touch.
  enum Which { kAt, kKind, kDisplace, kForce, kRadius, kFriction, kCount };
  struct Repeated {
    CLI::Option* option = nullptr;
    std::vector<std::string> values;
    bool isGiven() const { return !values.empty(); }
  };
  /// What was given of one touch; empty: not given.
  using Group = std::array<std::string, kCount>;

  const Repeated& option(Which which) const { return repeated_[which]; }
  std::vector<Group> groups() const;
  std::vector<modeling::Touch> touches() const;
  void validateNode() const;
  int steps() const;

  const CLI::App* app_ = nullptr;
  std::array<Repeated, kCount> repeated_;
  std::string node_;
  std::string steps_;
};

/// Places at which the solution is to be read off: --probe, any number.
class ProbeInput {
 public:
  void declare(CLI::App& options);
  void validate() const;
  bool isGiven() const { return !probes_.empty(); }
  std::vector<app::FieldSample> read(const app::TouchModel& model, const app::TouchState& state) const;

 private:
  std::vector<std::string> probes_;
};

}  // namespace palpa::cli
