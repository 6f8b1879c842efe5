#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "app/core/live/touch_command.h"
#include "app/core/model/touch_model.h"

// Recordings as files: docs/touch.md, resources/recording.schema.json.
namespace palpa::app {

inline constexpr int kRecordingVersion = 1;
inline constexpr std::size_t kMaxRecordingFile = 96UL << 20;   // bytes
inline constexpr std::size_t kMaxRecordingValues = 8'000'000;  // numbers, strings, lists, …

/// Which model was touched, as far as a replay wants to know.
struct RecordedModel {
  std::string name;  ///< of the project
  /// Stands for mesh, supports, loads and material; coordinates are rounded to 1e-7 of the body's
  /// size, so that it is the same on other machines.
  std::string key;
  int nodes = 0;
};

RecordedModel recordedModelOf(const TouchModel& model, const std::string& projectName);

/// A sentence that says how the models differ, so that a replay gives other forces; empty when they
/// do not.
std::string differenceOf(const RecordedModel& recorded, const RecordedModel& present);

struct RecordingFile {
  RecordedModel model;
  TouchRecording recording;
};

/// One command per line; numbers as short as they read back exactly.
std::string toJson(const RecordingFile& file);

/// Every error is a ModelingError that names source and place: `press.json: commands[3].contact: 7
/// was not begun`. What is read can be replayed: commands in the order of their steps, about
/// contacts that are there, at most as many at once as a snapshot can hold. Hostile files are
/// refused before they cost much.
RecordingFile parseRecording(std::string_view text, const std::string& sourceName);
RecordingFile readRecording(const std::filesystem::path& path);

/// Reads the text back first, then replaces the file at once. Throws ModelingError; the old file is
/// untouched then.
void writeRecording(const RecordingFile& file, const std::filesystem::path& path);

}  // namespace palpa::app
