#pragma once

#include <QObject>
#include <QPointer>
#include <QString>
#include <QStringList>
#include <array>
#include <map>
#include <memory>

#include "app/gui/window/main_window.h"
#include "tests/reliability/campaign.h"
#include "tests/reliability/window_process.h"

class QFileDialog;

namespace palpa::reliability {

/// State of the window before an entry is used. Except in kNewProject the project has unsaved
/// edits.
enum class Situation {
  kNewProject,  ///< a new window, with the welcome page that the entry replaces
  kSolid,       ///< a solid whose model is complete; something is selected
  kMeshBody,    ///< a mesh body
  kTouching,    ///< Simulate mode, a touch that is being dragged, and a long recording
  kRebuilding,  ///< a fine mesh that is being built
};
inline constexpr std::array kSituations{Situation::kNewProject, Situation::kSolid,
                                        Situation::kMeshBody, Situation::kTouching,
                                        Situation::kRebuilding};
const char* nameOf(Situation situation);

enum class Interruption { kEscape, kReturn, kCloseDialog, kCloseWindow };
inline constexpr std::array kInterruptions{Interruption::kEscape, Interruption::kReturn,
                                           Interruption::kCloseDialog, Interruption::kCloseWindow};
const char* nameOf(Interruption interruption);
/// "solid, entry Undo, Escape".
QString nameOf(Situation situation, const QString& target, Interruption interruption);

/// Number of dialogs in a row that are tried.
inline constexpr int kMaxDepth = 5;

/// Uses entries and buttons of a window and interrupts them. Fails the campaign if something is
/// left behind. Files are read from and written to one folder.
class Interrupter {
 public:
  Interrupter(Campaign& campaign, QString folder, ActionLog log);
  ~Interrupter();

  /// Names of all entries and buttons in a situation.
  QStringList targets(Situation situation);

  /// Enters the situation, uses a target, answers the first `depth` dialogs so that the work goes
  /// on, and interrupts at the next one. False if there were not so many dialogs; then the window
  /// itself was interrupted after the work.
  bool run(Situation situation, const QString& target, Interruption interruption, int depth);

  /// Number of interrupted dialogs and other figures.
  const std::map<std::string, long>& counts() const { return counts_; }

 private:
  gui::Editor& editor() { return window_->editor(); }
  gui::ViewportWidget& view() { return window_->viewport(); }
  void openWindow();
  void enter(Situation situation);
  void select();
  void startTouching();
  bool use(const QString& target);

  // Dialogs block use() until they are closed; a timer calls these functions meanwhile.
  void attend();
  void attendUnexpected(QWidget& dialog);
  void goOn(QWidget& dialog);
  void goOn(QFileDialog& dialog);
  void interrupt(QWidget* dialog);
  void leave(QWidget& dialog);

  void checkAfterwards(const QString& name);
  void checkFiles(const QString& name);

  Campaign& campaign_;
  const QString folder_;
  const ActionLog log_;
  Random random_;
  QObject attendant_;  // context of the timer that attends to dialogs
  std::unique_ptr<gui::MainWindow> window_;
  int windowUses_ = 0;
  bool isTouching_ = false;

  // Of the present case.
  Interruption interruption_{};
  int depth_ = 0, answered_ = 0, tries_ = 0;
  bool isInterrupted_ = false, isAttending_ = false;
  bool isModified_ = false;  // before the case, or when the window is closed
  bool isAsked_ = false;     // whether unsaved edits are to be kept
  bool isSaved_ = false, isReplaced_ = false;
  QPointer<QWidget> dialog_;  // that is being answered
  Clock::time_point dialogSince_;
  QString failure_;
  std::map<std::string, long> counts_;
};

}  // namespace palpa::reliability
