#pragma once

#include <QByteArray>
#include <QObject>
#include <QSettings>
#include <QStringList>

#include "app/gui/base/appearance.h"
#include "app/gui/base/units.h"

namespace palpa::gui {

/// What a person prefers, kept between runs. Values out of range in the file become defaults.
/// Setters write at once and emit `changed` when the value differs.
class Settings : public QObject {
  Q_OBJECT

 public:
  static constexpr int kMaxRecentFiles = 10;

  explicit Settings(QObject* parent = nullptr);

  Theme theme() const;
  void setTheme(Theme theme);

  ShownUnits units() const { return units_; }
  void setUnits(const ShownUnits& units);

  /// Threads of the rebuild; 0: all cores.
  int threads() const;
  void setThreads(int threads);

  /// Memory one model may take, GiB; 0: most of what is free.
  double memoryLimitGiB() const;
  void setMemoryLimitGiB(double limit);

  /// Size the cache of models on disk may reach, GiB; 0: no cache.
  double cacheLimitGiB() const;
  void setCacheLimitGiB(double limit);

  /// Seconds from the first unsaved edit to a snapshot for recovery.
  int autosaveSeconds() const;
  void setAutosaveSeconds(int seconds);

  /// Absolute names, latest first.
  QStringList recentFiles() const;
  void addRecentFile(const QString& file);
  void removeRecentFile(const QString& file);
  void clearRecentFiles();

  /// Folder that file dialogs begin in.
  QString lastFolder() const;
  void setLastFolder(const QString& folder);

  /// Of the window: QMainWindow::saveGeometry() and saveState(); empty before the first close.
  QByteArray windowGeometry() const;
  QByteArray windowState() const;
  void setWindow(const QByteArray& geometry, const QByteArray& state);

  /// True until the first time the window was closed.
  bool isFirstRun() const;

 Q_SIGNALS:
  void changed();

 private:
  void set(const QString& key, const QVariant& value);

  QSettings file_;
  ShownUnits units_;
};

}  // namespace palpa::gui
