#pragma once

#include <QDialog>
#include <QPushButton>
#include <QTreeWidget>

#include "app/gui/editor.h"
#include "modeling/project/autosave.h"

namespace palpa::gui {

/// What a crash left: each can be recovered, discarded, or kept for the next start.
class RecoveryDialog : public QDialog {
  Q_OBJECT

 public:
  RecoveryDialog(Editor& editor, std::vector<modeling::Snapshot> snapshots, QWidget* parent);

 private:
  /// Null when nothing is chosen.
  const modeling::Snapshot* chosen() const;
  void recover();
  void discard();

  Editor& editor_;
  std::vector<modeling::Snapshot> snapshots_;
  QTreeWidget* list_;
};

/// Looks for snapshots on a thread of its own and shows the dialog when there are some; `done` is
/// called afterwards, with whether there were any. Nothing happens when `window` is gone by then.
void offerRecovery(Editor& editor, QWidget& window, const std::function<void(bool any)>& done);

}  // namespace palpa::gui
