#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "modeling/project/project.h"

// Autosave and recovery. A program writes snapshots of each open project into a state folder that
// all running programs share; the next program finds the snapshots of those that crashed.
// A snapshot file is one line of JSON (whose, when) followed by the text of a project file.
namespace palpa::modeling {

/// `palpa/autosave` in $XDG_STATE_HOME, or in ~/.local/state when that is not set to an absolute
/// path. @throws ModelingError (notFound) when there is no home folder either
std::filesystem::path defaultAutosaveFolder();

/// The snapshot of one open project. One object per open project; not for concurrent use.
class Autosave {
 public:
  /// Makes the folder when the first snapshot is written, readable by its owner only.
  explicit Autosave(std::filesystem::path folder);
  Autosave(const Autosave&) = delete;
  Autosave& operator=(const Autosave&) = delete;

  /// Replaces the snapshot atomically: a crash meanwhile leaves the previous one. `original` is the
  /// project's own file, empty when it has none yet; `revision` counts the edits.
  /// @throws ModelingError; the previous snapshot is unchanged then
  void write(const Project& project, const std::filesystem::path& original, std::uint64_t revision);

  /// After saving and on a clean close. The destructor does not do it: what ends a program without
  /// closing its projects is what the snapshot is for.
  void remove() noexcept;

 private:
  std::filesystem::path folder_;
  std::filesystem::path file_;  // empty: no snapshot
  unsigned document_;           // number of this object in its process
};

struct Snapshot {
  std::filesystem::path file;
  std::filesystem::path original;  ///< absolute; empty for a project that was never saved
  std::string projectName;
  std::chrono::system_clock::time_point time;
  std::uint64_t revision = 0;
};

struct RecoveryList {
  /// Of processes that ended without removing them, newer than the original file or without one;
  /// latest first. All of them were read once: recover() gives a project.
  std::vector<Snapshot> snapshots;
  /// Of ended processes, but the original file was written later: nothing is lost without them.
  std::vector<Snapshot> outdated;
  /// A line for each file that cannot be used, with its name and why.
  std::vector<std::string> problems;
};

/// Looks through the folder; changes nothing. A folder that does not exist holds no snapshots.
/// Costs as much as loading all projects in it.
RecoveryList findRecoverable(const std::filesystem::path& folder);

/// @throws ModelingError when the file has gone or changed since
Project recover(const Snapshot& snapshot);

/// Removes a snapshot that was recovered (once the new Autosave has written its own) or is not
/// wanted. One that has gone already is no error. @throws ModelingError (io)
void discard(const Snapshot& snapshot);

}  // namespace palpa::modeling
