#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "modeling/project/project.h"

// Autosave and recovery. Each process writes snapshots of its open projects into a state folder
// that all processes share; later processes find the snapshots of crashed ones. A snapshot file is
// one line of JSON (process, time) followed by the text of a project file.
namespace palpa::modeling {

/// `palpa/autosave` in $XDG_STATE_HOME, or in ~/.local/state if the variable is not an absolute
/// path. Throws ModelingError (notFound) if there is no home folder either.
std::filesystem::path defaultAutosaveFolder();

/// Snapshot of one open project; each open project needs one object. Not thread-safe.
class Autosave {
 public:
  /// The folder is created with the first snapshot, readable by its owner only.
  explicit Autosave(std::filesystem::path folder);
  Autosave(const Autosave&) = delete;
  Autosave& operator=(const Autosave&) = delete;

  /// Replaces the snapshot atomically: after a crash during writing the previous snapshot remains.
  /// `original` is the file of the project, empty if there is none; `revision` counts the edits.
  /// Throws ModelingError and keeps the previous snapshot if writing fails.
  void write(const Project& project, const std::filesystem::path& original, std::uint64_t revision);

  /// Removes the snapshot, after saving and on a clean close. The destructor keeps it, because
  /// snapshots serve when a program ends without closing its projects.
  void remove() noexcept;

 private:
  std::filesystem::path folder_;
  std::filesystem::path file_;  // empty: no snapshot
  unsigned document_;           // number of this object in its process
};

/// A recoverable project.
struct Snapshot {
  std::filesystem::path file;
  std::filesystem::path original;  ///< absolute; empty for a project that was never saved
  std::string projectName;
  std::chrono::system_clock::time_point time;
  std::uint64_t revision = 0;
};

/// Content of an autosave folder.
struct RecoveryList {
  /// Snapshots of ended processes that are newer than the original file or have none, latest first.
  /// Each was read once, so that recover() succeeds.
  std::vector<Snapshot> snapshots;
  /// Snapshots of ended processes that are older than the original file and not needed any more.
  std::vector<Snapshot> outdated;
  /// A line for each unusable file, with its name and the reason.
  std::vector<std::string> problems;
};

/// Examines the folder without changes. A missing folder holds no snapshots. Cost: as loading all
/// projects in the folder.
RecoveryList findRecoverable(const std::filesystem::path& folder);

/// The project of a snapshot. Throws ModelingError if the file was removed or changed meanwhile.
Project recover(const Snapshot& snapshot);

/// Removes a snapshot that is not wanted or was recovered (after the first write() of the new
/// Autosave). Does nothing if the file is missing. Throws ModelingError (io) if removing fails.
void discard(const Snapshot& snapshot);

}  // namespace palpa::modeling
