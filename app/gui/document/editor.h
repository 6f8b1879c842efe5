#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <functional>
#include <memory>

#include "app/core/session/session.h"
#include "app/gui/document/export_body.h"
#include "app/gui/document/selection.h"
#include "app/gui/base/settings.h"

namespace palpa::gui {

/// The open project as the window's parts share it: the session, what is selected, and signals for
/// everything that changes. Errors become the signal `refused`; nothing throws.
class Editor : public QObject {
  Q_OBJECT

 public:
  /// Does long work, elsewhere than in the window's thread, and returns when it has ended; false
  /// when the person cancelled. What the work throws comes out of it.
  using Runner =
      std::function<bool(const QString& title, const std::function<void(const Job&)>& work)>;

  explicit Editor(Settings& settings, QObject* parent = nullptr);
  ~Editor() override;

  const modeling::Project& project() const { return session_->project(); }
  /// Null when the body is a mesh body, which has no control points.
  const modeling::Solid* solid() const { return std::get_if<modeling::Solid>(&project().body); }
  const Settings& settings() const { return settings_; }
  const app::Session& session() const { return *session_; }
  app::RebuildStatus rebuildStatus() const { return session_->pipeline().status(); }
  std::shared_ptr<const app::TouchModel> model() const { return session_->pipeline().model(); }

  /// How files are read and written from now on; until then in the caller's thread.
  void setRunner(Runner runner) { runner_ = std::move(runner); }

  // Projects. False when it failed (refused was emitted) or was cancelled; the present one is still
  // open then.
  void start(modeling::Project project);
  bool open(const QString& file);
  bool importFile(const QString& file);
  /// Writes the body: a CAD file (solids only) or a triangle mesh, by the ending of the name.
  bool exportFile(const QString& file, ExportedSurface surface);
  /// Opens what a crash left; its snapshot goes when the new session has written its own.
  bool recover(const modeling::Snapshot& snapshot);
  /// To fileName(); false without one.
  bool save();
  bool saveAs(const QString& file);
  QString fileName() const;
  /// How the window shows the project, saved with it; not an edit.
  void setView(const std::string& view) { session_->setView(view); }

  // Edits.
  bool perform(const modeling::Command& command, modeling::Merge merge = modeling::Merge::kNo);
  /// After the last of a motion's merged commands: its rebuild need not wait for more.
  void endMotion() { session_->endMotion(); }
  void undo();
  void redo();
  /// Undoes or redoes up to a state of Document::history().
  void goToState(std::size_t position);
  void cancelRebuild() { session_->pipeline().cancel(); }
  /// After a stop or a failure.
  void rebuildAgain() { session_->rebuild(); }

  /// Makes the edits until endGroup() one step of undo; Session::beginGroup(). Nothing is ended or
  /// cancelled where a failed command, or another project, has done so meanwhile.
  void beginGroup(const QString& label);
  void endGroup();
  void cancelGroup();

  const Selection& selection() const { return selection_; }
  void select(Selection selection);

 Q_SIGNALS:
  /// The time to end what was begun with the present project.
  void aboutToReplace();
  void projectReplaced();
  void projectChanged(const modeling::Change& change);
  void selectionChanged();
  /// The rebuild's state, phase or model changed; at most 30 times a second.
  void rebuildChanged();
  /// The time for setView().
  void aboutToSave();
  /// The file or whether there is something to save changed.
  void fileChanged();
  /// The project was written to its file.
  void saved(const QString& file);
  /// Something could not be done; a sentence for people.
  void refused(const QString& message);
  /// Something worth knowing happened; a sentence for people.
  void said(const QString& message);

 private:
  app::Session::Options sessionOptions();
  void adopt(std::unique_ptr<app::Session> session);
  void changed(const modeling::Change& change);
  bool openInBackground(const QString& title, const std::function<std::unique_ptr<app::Session>(
                                                  const Job&, const app::Session::Options&)>& make);
  template <class Work>
  bool attempt(const Work& work);

  void forgetWhatIsGone(const modeling::Change& change);

  Settings& settings_;
  Runner runner_;
  std::unique_ptr<app::Session> session_;
  Selection selection_;
  QTimer rebuildTimer_;
  QTimer autosaveTimer_;
};

}  // namespace palpa::gui
