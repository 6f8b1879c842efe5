#pragma once

#include <QDialog>
#include <QPushButton>
#include <QTreeWidget>
#include <functional>

#include "app/gui/document/editor.h"
#include "modeling/project/autosave.h"

namespace palpa::gui {

/// What a crash left: each can be recovered, discarded, or kept for the next start.
class RecoveryDialog : public QDialog {
  Q_OBJECT

 public:
  /// `mayReplace` is asked before the open project gives way to a recovered one.
  RecoveryDialog(Editor& editor, std::vector<modeling::Snapshot> snapshots,
                 std::function<bool()> mayReplace, QWidget* parent);

 private:
  /// Null when nothing is chosen.
  const modeling::Snapshot* chosen() const;
  void recover();
  void discard();

  Editor& editor_;
  std::vector<modeling::Snapshot> snapshots_;
  std::function<bool()> mayReplace_;
  QTreeWidget* list_;
};

/// Looks for snapshots on a thread of its own and shows the dialog when there are some and nothing
/// else is being asked or done; `done` is called afterwards, with whether there were any. `window`
/// waits for the thread when it goes earlier; nothing else happens then.
void offerRecovery(Editor& editor, QWidget& window, const std::function<bool()>& mayReplace,
                   const std::function<void(bool any)>& done);

}  // namespace palpa::gui
