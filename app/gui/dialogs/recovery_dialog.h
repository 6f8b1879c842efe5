#pragma once

#include <QDialog>
#include <QPushButton>
#include <QTreeWidget>
#include <functional>

#include "app/gui/document/editor.h"
#include "modeling/project/autosave.h"

namespace palpa::gui {

/// Snapshots of a crashed session. Each can be recovered, discarded, or kept for the next start.
class RecoveryDialog : public QDialog {
  Q_OBJECT

 public:
  /// `mayReplace` decides before a recovered project replaces the open one.
  RecoveryDialog(Editor& editor, std::vector<modeling::Snapshot> snapshots,
                 std::function<bool()> mayReplace, QWidget* parent);

 private:
  /// Null without a choice.
  const modeling::Snapshot* chosen() const;
  void recover();
  void discard();

  Editor& editor_;
  std::vector<modeling::Snapshot> snapshots_;
  std::function<bool()> mayReplace_;
  QTreeWidget* list_;
};

/// Searches for snapshots on a separate thread. Shows the dialog if any exist, as soon as no other
/// dialog is open and no job is running. Then calls `done`, which receives whether any existed. The
/// destructor of `window` waits for the thread; in this case neither happens.
void offerRecovery(Editor& editor, QWidget& window, const std::function<bool()>& mayReplace,
                   const std::function<void(bool any)>& done);

}  // namespace palpa::gui
