#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <memory>

#include "app/core/session.h"
#include "app/gui/selection.h"
#include "app/gui/settings.h"

namespace palpa::gui {

/// The open project as the window's parts share it: the session, what is selected, and signals for
/// everything that changes. Errors become the signal `refused`; nothing throws.
class Editor : public QObject {
  Q_OBJECT

 public:
  explicit Editor(Settings& settings, QObject* parent = nullptr);
  ~Editor() override;

  const modeling::Project& project() const { return session_->project(); }
  /// Null when the body is a mesh body, which has no control points.
  const modeling::Solid* solid() const { return std::get_if<modeling::Solid>(&project().body); }
  const app::Session& session() const { return *session_; }
  app::RebuildStatus rebuildStatus() const { return session_->pipeline().status(); }
  std::shared_ptr<const app::TouchModel> model() const { return session_->pipeline().model(); }

  // Projects. False when it failed (refused was emitted); the present one is still open then.
  void start(modeling::Project project);
  bool open(const QString& file);
  bool importFile(const QString& file);
  bool save();
  bool saveAs(const QString& file);
  QString fileName() const;

  // Edits.
  bool perform(const modeling::Command& command, modeling::Merge merge = modeling::Merge::no);
  void undo();
  void redo();
  /// Undoes or redoes up to a state of Document::history().
  void goToState(std::size_t position);
  void cancelRebuild() { session_->pipeline().cancel(); }

  /// Makes the edits until endGroup() one step of undo; Session::beginGroup().
  void beginGroup(const QString& label);
  void endGroup();
  void cancelGroup();

  const Selection& selection() const { return selection_; }
  void select(Selection selection);

 Q_SIGNALS:
  void projectReplaced();
  void projectChanged(const modeling::Change& change);
  void selectionChanged();
  /// The rebuild's state, phase or model changed; at most 30 times a second.
  void rebuildChanged();
  /// The file or whether there is something to save changed.
  void fileChanged();
  /// Something could not be done; a sentence for people.
  void refused(const QString& message);
  /// Something worth knowing happened; a sentence for people.
  void said(const QString& message);

 private:
  app::Session::Options sessionOptions();
  void adopt(std::unique_ptr<app::Session> session);
  void changed(const modeling::Change& change);
  template <class Work>
  bool attempt(const Work& work);

  void forgetWhatIsGone(const modeling::Change& change);

  Settings& settings_;
  std::unique_ptr<app::Session> session_;
  Selection selection_;
  QTimer rebuildTimer_;
  QTimer autosaveTimer_;
};

}  // namespace palpa::gui
