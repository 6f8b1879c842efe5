#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "app/core/session/rebuild_pipeline.h"
#include "modeling/editing/document.h"
#include "modeling/project/autosave.h"

namespace palpa::app {

/// One project being worked on, as every front end sees it: the document with its history, the file
/// it belongs to, the snapshot for recovery, and the model that follows the edits in the
/// background.
///
/// All functions are called from one thread, except that the pipeline's `changed` comes from
/// others. What fails throws ModelingError and leaves the session as it was.
class Session {
 public:
  struct Options {
    BuildOptions build;
    int threads = 0;                         ///< of the rebuild; 0: all cores
    std::filesystem::path cacheFolder;       ///< empty: solved models are not stored
    double cacheLimit = 0;                   ///< bytes; 0: solved models are not stored
    std::filesystem::path autosaveFolder;    ///< empty: no snapshots
    std::chrono::seconds autosaveEvery{60};  ///< after the first edit that is not saved
    std::function<void()> rebuildChanged;    ///< RebuildPipeline's `changed`
  };

  /// A project that has no file yet; it counts as clean.
  Session(modeling::Project project, Options options);
  /// A project read from a file.
  Session(const std::filesystem::path& file, Options options);
  /// What was recovered from a snapshot: not clean, so that it is offered to be saved.
  Session(const modeling::Snapshot& snapshot, Options options);

  const modeling::Document& document() const { return document_; }
  const modeling::Project& project() const { return document_.project(); }
  RebuildPipeline& pipeline() { return *pipeline_; }
  /// Null without a folder or a limit.
  ModelCache* cache() const { return options_.build.cache.get(); }
  /// Builds the model again, as after a failure or a stop.
  void rebuild() { pipeline_->submit(project()); }
  /// The hand has let go: what perform() holds back is built now.
  void endMotion() { pipeline_->startPending(); }

  /// Applies a command; a change that matters to the model starts a rebuild. A command that is
  /// merged or in a group is part of a motion: it is built when no other has come for 0.1 s, or at
  /// endMotion() or endGroup().
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

  /// Where save() writes; none for a project that was never saved.
  const std::optional<std::filesystem::path>& file() const { return file_; }
  /// Are there edits that save() would write? A recovered project counts as edited.
  bool isModified() const { return recovered_ || !document_.isClean(); }
  /// std::logic_error without a file.
  void save();
  void saveAs(const std::filesystem::path& file);
  /// The project as it is now was written to `file` by another thread: what saveAs() does after
  /// writing.
  void markSavedAs(const std::filesystem::path& file);

  /// Writes the snapshot when it is due; to be called now and then with the present time. True when
  /// one was written. Errors reach the caller once per interval.
  bool autosaveIfDue(std::chrono::steady_clock::time_point now);

  /// Forgets the snapshot: the person has saved or does not want the edits.
  void close();

 private:
  void rebuildIfNeeded(const modeling::Change& change, std::chrono::milliseconds quiet = {});

  modeling::Document document_;
  Options options_;
  std::optional<std::filesystem::path> file_;
  bool recovered_ = false;
  std::unique_ptr<modeling::Autosave> autosave_;
  std::uint64_t edits_ = 0;           // so far
  std::uint64_t autosavedEdits_ = 0;  // that are in the snapshot or in the file
  std::optional<std::chrono::steady_clock::time_point> autosaveDue_;
  std::unique_ptr<RebuildPipeline> pipeline_;
};

}  // namespace palpa::app
