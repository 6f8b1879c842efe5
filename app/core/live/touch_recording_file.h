#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "app/core/live/touch_command.h"
#include "app/core/model/touch_model.h"

// Recordings as files: docs/touch.md, resources/recording.schema.json.
namespace palpa::app {

inline constexpr int kRecordingVersion = 2;
inline constexpr std::size_t kMaxRecordingFile = 96UL << 20;   // bytes
inline constexpr std::size_t kMaxRecordingValues = 8'000'000;  // numbers, strings, lists, …

/// Identity of the touched model, for a replay.
struct RecordedModel {
  std::string name;  ///< of the project
  /// Hash of mesh, supports, loads and material; coordinates are rounded to 1e-7 of the body's
  /// size, so that it is the same on other machines.
  std::string key;
  int nodes = 0;
};

RecordedModel recordedModelOf(const TouchModel& model, const std::string& projectName);

/// A sentence about the difference of the models, because of which a replay gives other forces;
/// empty without a difference.
std::string differenceOf(const RecordedModel& recorded, const RecordedModel& present);

struct RecordingFile {
  RecordedModel model;
  TouchRecording recording;
};

/// One command per line; numbers as short as they read back exactly.
std::string toJson(const RecordingFile& file);

/// Throws ModelingError that names source and location: `press.json: commands[3].contact: 7 was not
/// begun`. The result can be replayed: commands are in the order of their steps, their contacts
/// exist, and a snapshot can hold all contacts. Hostile files are refused before they cost much.
RecordingFile parseRecording(std::string_view text, const std::string& sourceName);
RecordingFile readRecording(const std::filesystem::path& path);

/// Checks the text by reading it back, then replaces the file atomically. Throws ModelingError; the
/// old file is unchanged then.
void writeRecording(const RecordingFile& file, const std::filesystem::path& path);

}  // namespace palpa::app
