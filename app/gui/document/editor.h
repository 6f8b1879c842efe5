#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <functional>
#include <memory>
#include <vector>

#include "app/core/session/session.h"
#include "app/gui/base/settings.h"
#include "app/gui/document/export_body.h"
#include "app/gui/document/selection.h"

namespace palpa::modeling {
struct ImportOptions;
}

namespace palpa::gui {

class Measurements;
class TouchGradient;

/// The open project for the parts of the window: session, selection, and signals for all changes.
/// Functions do not throw; errors are emitted as `refused`.
class Editor : public QObject {
  Q_OBJECT

 public:
  /// Runs long work outside the window's thread and returns after its end; false if the user
  /// cancelled. Rethrows exceptions of the work.
  using Runner =
      std::function<bool(const QString& title, const std::function<void(const Job&)>& work)>;

  explicit Editor(Settings& settings, QObject* parent = nullptr);
  ~Editor() override;

  const modeling::Project& project() const { return session_->project(); }
  /// Null for a mesh body, which has no control points.
  const modeling::Solid* solid() const { return std::get_if<modeling::Solid>(&project().body); }
  const Settings& settings() const { return settings_; }
  Measurements& measurements() { return *measurements_; }
  TouchGradient& gradient() { return *gradient_; }
  const app::Session& session() const { return *session_; }
  app::RebuildStatus rebuildStatus() const { return session_->pipeline().status(); }
  std::shared_ptr<const app::TouchModel> model() const { return session_->pipeline().model(); }

  /// Runs file operations from now on; without a runner they run in the caller's thread.
  void setRunner(Runner runner) { runner_ = std::move(runner); }

  // Projects. False after a failure (`refused` was emitted) or a cancellation; the present project
  // then stays open.
  void start(modeling::Project project);
  bool open(const QString& file);
  /// With `needsChoice`, a file with several solids of which none is chosen sets it to true and is
  /// no failure that is told.
  bool importFile(const QString& file, const modeling::ImportOptions& options,
                  bool* needsChoice = nullptr);
  /// Writes the body as a CAD file (solids only) or a triangle mesh, by the ending of the name.
  bool exportFile(const QString& file, ExportedSurface surface,
                  const app::TouchPageSettings& page = {});
  /// Opens a snapshot of a crashed session and discards it after the new session has written one.
  bool recover(const modeling::Snapshot& snapshot);
  /// Saves to fileName(); false without a name.
  bool save();
  bool saveAs(const QString& file);
  QString fileName() const;
  /// Camera and visible items as text, saved with the project; not an edit.
  void setView(const std::string& view) { session_->setView(view); }
  /// The same for a change that must be saved: Session::editView().
  void editView(const std::string& view);

  // Edits.
  bool perform(const modeling::Command& command, modeling::Merge merge = modeling::Merge::kNo);
  /// Performs commands as one step of undo with this label; if one is refused, none is performed.
  bool performAll(const QString& label, const std::vector<modeling::Command>& commands);
  /// Call after the last merged command of a motion: starts the rebuild without waiting for more.
  void endMotion() { session_->endMotion(); }
  void undo();
  void redo();
  /// Undoes or redoes to a state of Document::history().
  void goToState(std::size_t position);
  void cancelRebuild() { session_->pipeline().cancel(); }
  /// Repeats a stopped or failed rebuild.
  void rebuildAgain() { session_->rebuild(); }

  /// Makes the edits until endGroup() one undo step (Session::beginGroup()). endGroup() and
  /// cancelGroup() do nothing if a failed command or another project has ended the group.
  void beginGroup(const QString& label);
  void endGroup();
  void cancelGroup();

  const Selection& selection() const { return selection_; }
  void select(Selection selection);

 Q_SIGNALS:
  /// Emitted before the project is replaced; tools must abort.
  void aboutToReplace();
  void projectReplaced();
  void projectChanged(const modeling::Change& change);
  void selectionChanged();
  /// State, phase or model of the rebuild changed; at most 30 times a second.
  void rebuildChanged();
  /// Emitted before the project is written; the view must call setView().
  void aboutToSave();
  /// The file name or Session::isModified() changed.
  void fileChanged();
  /// The project was written to its file.
  void saved(const QString& file);
  /// An operation failed; `message` is a sentence for the user.
  void refused(const QString& message);
  /// A note for the user.
  void said(const QString& message);

 private:
  app::Session::Options sessionOptions();
  void adopt(std::unique_ptr<app::Session> session);
  void changed(const modeling::Change& change);
  bool openInBackground(const QString& title, const std::function<std::unique_ptr<app::Session>(
                                                  const Job&, const app::Session::Options&)>& make);
  template <class Work>
  bool attempt(const Work& work);

  void deselectRemoved(const modeling::Change& change);

  Settings& settings_;
  Runner runner_;
  std::unique_ptr<app::Session> session_;
  Measurements* measurements_;  // owned by this object
  TouchGradient* gradient_;     // owned by this object
  Selection selection_;
  QTimer rebuildTimer_;
  QTimer autosaveTimer_;
};

}  // namespace palpa::gui
