#pragma once

#include <QByteArray>
#include <QObject>
#include <QSettings>
#include <QStringList>
#include <array>
#include <optional>

#include "app/core/results/surface_quantity.h"
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

  /// True if the welcome dialog appears at a start without a file.
  bool welcomesAtStart() const;
  void setWelcomesAtStart(bool welcomes);

  /// Initial folder of file dialogs.
  QString lastFolder() const;
  void setLastFolder(const QString& folder);

  /// QMainWindow::saveGeometry() and saveState() of the last run; empty before the first close.
  QByteArray windowGeometry() const;
  QByteArray windowState() const;
  void setWindow(const QByteArray& geometry, const QByteArray& state);

  /// QSplitter::saveState() of the Forces panel; empty before it was moved.
  QByteArray forcesSplitter() const;
  void setForcesSplitter(const QByteArray& state);

  /// Simulation::RangeMode as a number.
  int colourRangeMode() const;
  void setColourRangeMode(int mode);
  /// Fixed range of the colours of a quantity, in the program's unit; none before it was set.
  std::optional<std::array<double, 2>> colourRange(app::SurfaceQuantity quantity) const;
  void setColourRange(app::SurfaceQuantity quantity, const std::array<double, 2>& range);
  bool areExtremesShown() const;
  void setExtremesShown(bool shown);

  /// True if a 3-D mouse moves the view.
  bool usesMouse3d() const;
  void setUsesMouse3d(bool uses);

  /// The user's materials as text: OwnMaterials.
  QByteArray ownMaterials() const;
  void setOwnMaterials(const QByteArray& materials);

  /// QWidget::saveGeometry() of the guide; empty before it was shown.
  QByteArray guideGeometry() const;
  void setGuideGeometry(const QByteArray& geometry);

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
