#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/core/session/rebuild_pipeline.h"
#include "modeling/editing/document.h"
#include "modeling/mesh/mesh_focus.h"
#include "modeling/project/autosave.h"

namespace palpa::app {

/// An open project, as every front end sees it: the document with its history, its file, the
/// snapshot for recovery, and the model that is rebuilt after edits in the background.
///
/// All functions are called from one thread; the pipeline calls `rebuildChanged` from others.
/// Functions throw ModelingError if they fail, and leave the session unchanged.
class Session {
 public:
  struct Options {
    BuildOptions build;
    int threads = 0;                       ///< of the rebuild; 0: all cores
    std::filesystem::path cacheFolder;     ///< empty: solved models are not stored
    double cacheLimit = 0;                 ///< bytes; 0: solved models are not stored
    std::filesystem::path autosaveFolder;  ///< empty: no snapshots
    /// The snapshot is on the disk at most this long after the first edit that is not saved.
    std::chrono::seconds autosaveEvery{60};
    /// Largest time between two calls of autosaveIfDue().
    std::chrono::milliseconds autosavePoll{1000};
    /// Clock of the edits; replaced in tests.
    std::function<std::chrono::steady_clock::time_point()> clock = std::chrono::steady_clock::now;
    std::function<void()> rebuildChanged;  ///< RebuildPipeline's `changed`
  };

  /// A project that has no file yet; it counts as clean.
  Session(modeling::Project project, Options options);
  /// A project read from a file.
  Session(const std::filesystem::path& file, Options options);
  /// A project recovered from a snapshot. It counts as modified, so that the user is asked to save
  /// it.
  Session(const modeling::Snapshot& snapshot, Options options);

  const modeling::Document& document() const { return document_; }
  const modeling::Project& project() const { return document_.project(); }
  RebuildPipeline& pipeline() { return *pipeline_; }
  /// Null without a cache folder or limit.
  ModelCache* cache() const { return options_.build.cache.get(); }
  /// Builds the model again, after a failure or a stop.
  void rebuild() { submit(); }
  /// Ends a motion: builds the model that perform() has delayed.
  void endMotion() { pipeline_->startPending(); }

  /// Applies a command; a change that concerns the model starts a rebuild. A command that is merged
  /// or in a group is part of a motion: its rebuild starts after 0.1 s without further commands, or
  /// at endMotion() or endGroup().
  modeling::Performed perform(const modeling::Command& command,
                              modeling::Merge merge = modeling::Merge::kNo);
  modeling::Change undo();
  modeling::Change redo();
  /// Document::goToState().
  modeling::Change goToState(std::size_t position);
  /// Edits up to endGroup() are one step of undo.
  void beginGroup(std::string label) { document_.beginGroup(std::move(label)); }
  void endGroup();
  modeling::Change cancelGroup();
  void setView(std::string view) { document_.setView(std::move(view)); }
  /// The same for a change that the user expects to be saved: the project counts as modified until
  /// it is saved.
  void editView(std::string view);

  /// The file that save() writes; none for a project that was never saved.
  const std::optional<std::filesystem::path>& file() const { return file_; }
  /// True if there are unsaved edits. A recovered project counts as edited.
  bool isModified() const { return recovered_ || isViewEdited_ || !document_.isClean(); }
  /// Throws std::logic_error without a file.
  void save();
  void saveAs(const std::filesystem::path& file);
  /// The part of saveAs() after writing, for a caller whose other thread has written the present
  /// project to `file`.
  void markSavedAs(const std::filesystem::path& file);

  /// Writes the snapshot if it is due; to be called regularly with the present time. It is due so
  /// early that one more call and writing, which takes as long as the last time, fit into the
  /// interval. True if a snapshot was written. Throws at most once per interval.
  bool autosaveIfDue(std::chrono::steady_clock::time_point now);

  /// Removes the snapshot, because the user has saved or discarded the edits.
  void close();

 private:
  void rebuildIfNeeded(const modeling::Change& change, std::chrono::milliseconds quiet = {});
  void submit(std::chrono::milliseconds quiet = {});
  void countEdit();

  modeling::Document document_;
  std::vector<modeling::MeshFocus> foci_;  ///< of the model that was asked for last
  Options options_;
  std::optional<std::filesystem::path> file_;
  bool recovered_ = false;
  bool isViewEdited_ = false;
  std::unique_ptr<modeling::Autosave> autosave_;
  std::uint64_t edits_ = 0;           // number of edits so far
  std::uint64_t autosavedEdits_ = 0;  // of these, in the snapshot or in the file
  std::optional<std::chrono::steady_clock::time_point> autosaveDue_;
  std::chrono::steady_clock::duration writing_{std::chrono::seconds(1)};  // of the last snapshot
  std::unique_ptr<RebuildPipeline> pipeline_;
};

}  // namespace palpa::app
