#pragma once

#include <QByteArray>
#include <QObject>
#include <QSettings>
#include <QStringList>

#include "app/gui/base/appearance.h"
#include "app/gui/base/units.h"

namespace palpa::gui {

/// Preferences of the user, stored between runs. Values in the file that are out of range become
/// defaults. Setters write immediately and emit `changed` if the value differs.
class Settings : public QObject {
  Q_OBJECT

 public:
  static constexpr int kMaxRecentFiles = 10;

  explicit Settings(QObject* parent = nullptr);

  Theme theme() const;
  void setTheme(Theme theme);

  ShownUnits units() const { return units_; }
  void setUnits(const ShownUnits& units);

  /// Number of threads of the rebuild; 0: all cores.
  int threads() const;
  void setThreads(int threads);

  /// Memory limit of one model, GiB; 0: most of the free memory.
  double memoryLimitGiB() const;
  void setMemoryLimitGiB(double limit);

  /// Size limit of the model cache on disk, GiB; 0: no cache.
  double cacheLimitGiB() const;
  void setCacheLimitGiB(double limit);

  /// Time from the first unsaved edit to a snapshot for recovery, s.
  int autosaveSeconds() const;
  void setAutosaveSeconds(int seconds);

  /// Absolute names, newest first.
  QStringList recentFiles() const;
  void addRecentFile(const QString& file);
  void removeRecentFile(const QString& file);
  void clearRecentFiles();

  /// Initial folder of file dialogs.
  QString lastFolder() const;
  void setLastFolder(const QString& folder);

  /// QMainWindow::saveGeometry() and saveState() of the last run; empty before the first close.
  QByteArray windowGeometry() const;
  QByteArray windowState() const;
  void setWindow(const QByteArray& geometry, const QByteArray& state);

  /// True until the window is closed for the first time.
  bool isFirstRun() const;

 Q_SIGNALS:
  void changed();

 private:
  void set(const QString& key, const QVariant& value);

  QSettings file_;
  ShownUnits units_;
};

}  // namespace palpa::gui
