#pragma once

#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/core/live/touch_recording_file.h"
#include "app/core/live/touch_snapshot.h"

namespace palpa::cli {

/// Report of `touch --recording` on a replay. The keys of the JSON object are documented in
/// docs/guide/command-line.md.
class ReplayReport {
 public:
  /// `present`: the model of the replay.
  ReplayReport(const app::RecordingFile& file, app::RecordedModel present);

  /// The snapshot after a step, from 0.
  void add(const app::TouchSnapshot& snapshot, std::uint64_t step);

  /// Sentences on differences between the recording and the replay.
  const std::vector<std::string>& warnings() const { return warnings_; }

  Json json() const;
  std::string text() const;

 private:
  struct Contact {
    app::TouchId id = 0;
    bem::ContactTool tool{};
    std::uint64_t first = 0, last = 0;  ///< steps
    double largest = 0;                 ///< N
    std::uint64_t largestStep = 0;
    Eigen::Vector3d largestForce = Eigen::Vector3d::Zero();
    Eigen::Vector3d largestAt = Eigen::Vector3d::Zero();
    std::vector<app::TouchSnapshot::Status> statuses;  ///< in the order in which they appeared
  };
  Contact& find(const app::TouchSnapshot::Contact& contact, std::uint64_t step);

  app::RecordedModel recorded_, present_;
  std::uint64_t steps_;
  std::size_t commands_;
  std::vector<std::string> warnings_;
  std::vector<Contact> contacts_;
  std::uint64_t unconverged_ = 0;
};

}  // namespace palpa::cli
