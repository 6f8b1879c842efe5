#include "app/core/session/session.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "app/core/model/stored_model.h"
#include "app/core/setup/boundary_setup.h"
#include "app/core/setup/project_geometry.h"
#include "modeling/project/mesh_foci.h"
#include "modeling/project/project_file.h"

namespace palpa::app {
namespace {

/// During a motion, a build waits for this time without commands.
constexpr std::chrono::milliseconds kQuiet{100};

/// True if the model depends on the change whatever the touches are. Names do not matter.
bool concernsModel(const modeling::Change& change) {
  return change.body() || change.material || change.supports || change.loads || change.mesh;
}

Session::Options withCache(Session::Options options) {
  if (!options.cacheFolder.empty() && options.cacheLimit > 0)
    options.build.cache = std::make_shared<ModelCache>(options.cacheFolder, options.cacheLimit);
  return options;
}

/// With the model that palpa-mpi has computed for a project file, if there is one beside it.
Session::Options withStoredModel(Session::Options options, const std::filesystem::path& project) {
  std::error_code error;
  const std::filesystem::path model = storedModelBeside(project);
  if (std::filesystem::is_regular_file(model, error)) options.build.storedModel = model;
  return options;
}

}  // namespace

Session::Session(modeling::Project project, Options options)
    : document_(std::move(project)),
      options_(withCache(std::move(options))),
      pipeline_(std::make_unique<RebuildPipeline>(options_.build, options_.threads,
                                                  options_.rebuildChanged)) {
  if (!options_.autosaveFolder.empty())
    autosave_ = std::make_unique<modeling::Autosave>(options_.autosaveFolder);
  rebuild();
}

Session::Session(const std::filesystem::path& file, Options options)
    : Session(modeling::readProject(file), withStoredModel(std::move(options), file)) {
  file_ = file;
  pipeline_->keepModel();
}

Session::Session(const modeling::Snapshot& snapshot, Options options)
    : Session(modeling::recover(snapshot), std::move(options)) {
  if (!snapshot.original.empty()) file_ = snapshot.original;
  recovered_ = true;
  countEdit();
}

modeling::Performed Session::perform(const modeling::Command& command, modeling::Merge merge) {
  modeling::Performed performed = document_.perform(command, merge);
  const bool isMotion = merge == modeling::Merge::kWithLast || document_.isInGroup();
  rebuildIfNeeded(performed.change, isMotion ? kQuiet : std::chrono::milliseconds(0));
  return performed;
}

modeling::Change Session::undo() {
  modeling::Change change = document_.undo();
  rebuildIfNeeded(change);
  return change;
}

modeling::Change Session::redo() {
  modeling::Change change = document_.redo();
  rebuildIfNeeded(change);
  return change;
}

modeling::Change Session::goToState(std::size_t position) {
  modeling::Change change = document_.goToState(position);
  rebuildIfNeeded(change);
  return change;
}

modeling::Change Session::cancelGroup() {
  modeling::Change change = document_.cancelGroup();
  rebuildIfNeeded(change);
  return change;
}

void Session::editView(std::string view) {
  if (view == project().view) return;
  document_.setView(std::move(view));
  isViewEdited_ = true;
  countEdit();
}

void Session::endGroup() {
  document_.endGroup();
  pipeline_->startPending();
}

void Session::rebuildIfNeeded(const modeling::Change& change, std::chrono::milliseconds quiet) {
  if (!change.any()) return;
  countEdit();
  // Elements and meshes are finer at touches.
  const bool isOtherMesh =
      change.touches && (usesSplines(project()) || modeling::meshFoci(project()) != foci_);
  if (concernsModel(change) || isOtherMesh) submit(quiet);
}

void Session::submit(std::chrono::milliseconds quiet) {
  foci_ = modeling::meshFoci(project());
  pipeline_->submit(project(), quiet);
}

void Session::countEdit() {
  ++edits_;
  if (autosaveDue_) return;
  // Twice the time of the last snapshot, as the disk may be slower now.
  const std::chrono::steady_clock::duration every = options_.autosaveEvery;
  autosaveDue_ = options_.clock() + every - std::min(options_.autosavePoll + 2 * writing_, every);
}

void Session::save() {
  if (!file_) throw std::logic_error("Session::save: the project has no file");
  saveAs(*file_);
}

void Session::saveAs(const std::filesystem::path& file) {
  modeling::writeProject(project(), file);
  markSavedAs(file);
}

void Session::markSavedAs(const std::filesystem::path& file) {
  file_ = file;
  document_.markSaved();
  recovered_ = false;
  isViewEdited_ = false;
  autosavedEdits_ = edits_;
  pipeline_->keepModel();
  close();
}

bool Session::autosaveIfDue(std::chrono::steady_clock::time_point now) {
  if (!autosave_ || edits_ == autosavedEdits_) return false;
  if (!isModified()) {  // undone: the file has everything
    autosave_->remove();
    autosavedEdits_ = edits_;
    autosaveDue_.reset();
    return false;
  }
  if (!autosaveDue_ || now < *autosaveDue_) return false;
  autosaveDue_ = now + options_.autosaveEvery;  // should writing fail: not again at once
  const auto begin = std::chrono::steady_clock::now();
  autosave_->write(project(), file_.value_or(std::filesystem::path()), edits_);
  writing_ = std::chrono::steady_clock::now() - begin;
  autosavedEdits_ = edits_;
  autosaveDue_.reset();  // the next edit begins a new interval
  return true;
}

void Session::close() {
  if (autosave_) autosave_->remove();
  autosaveDue_.reset();
}

}  // namespace palpa::app
