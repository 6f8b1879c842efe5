#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/core/model/touch_model.h"
#include "app/core/results/touch_sweep.h"

namespace palpa::cli {

/// The options that describe touches: groups that begin with --at, or --place, or --node. Without
/// them a command plays the touches of the project.
class TouchOptions {
 public:
  void declare(CLI::App& options);

  /// Throws UsageError for combinations without meaning. Call it before long work.
  void validate() const;

  /// True if the command line describes a touch.
  bool isGiven() const { return option(kAt).isGiven() || isPlaced() || isNode(); }

  /// True if the program chooses the place: --place auto.
  bool isPlaced() const { return !place_.empty(); }

  bool isNode() const { return !node_.empty(); }

  bool hasSteps() const { return !steps_.empty(); }

  /// The project with the touches of the command line, if there are any, instead of the recorded
  /// ones. With --place auto and without supports it gets the support of
  /// modeling::proposeSupport(), too. Build the model for it: its elements follow the touches.
  /// Throws ModelingError if there is no place.
  modeling::Project touched(modeling::Project project) const;

  /// Plays the touches of a project of touched(), or --node. Throws SolverError, Cancelled.
  app::TouchState play(const app::TouchModel& model, const modeling::Project& project,
                       const Context& context) const {
    return play(model, project, context, context.job());
  }
  /// The same with another job.
  app::TouchState play(const app::TouchModel& model, const modeling::Project& project,
                       const Context& context, const Job& job) const;

  /// The same touches at 0 to `count` parts of their displacements and forces. Not with isNode().
  /// Throws SolverError, Cancelled.
  std::vector<app::SweepRow> sweep(const app::TouchModel& model, const modeling::Project& project,
                                   int count, const Context& context) const;

  /// Writes the states of sweep() as a series, as app::writeSweepSeries().
  void writeSeries(const app::TouchModel& model, std::span<const app::SweepRow> rows,
                   const std::string& path, const Context& context) const;

 private:
  /// Options of one touch; each may occur once per touch.
  enum Which { kAt, kKind, kDisplace, kForce, kRadius, kFriction, kCount };
  struct Repeated {
    CLI::Option* option = nullptr;
    std::vector<std::string> values;
    bool isGiven() const { return !values.empty(); }
  };
  /// The values of one touch; empty: not given.
  using Group = std::array<std::string, kCount>;

  const Repeated& option(Which which) const { return repeated_[which]; }
  std::vector<Group> groups() const;
  modeling::Touch touchOf(const Group& group) const;
  std::vector<modeling::Touch> touches() const;
  void validateNode() const;
  void validatePlace() const;
  void place(modeling::Touch& touch, const modeling::Project& project) const;
  int steps() const;

  const CLI::App* app_ = nullptr;
  std::array<Repeated, kCount> repeated_;
  std::string node_;
  std::string place_;
  std::string depth_;
  std::string steps_;
};

}  // namespace palpa::cli
