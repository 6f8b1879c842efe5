#include "app/gui/base/settings.h"

#include <QDir>
#include <QFileInfo>
#include <algorithm>
#include <cmath>
#include <thread>

namespace palpa::gui {
namespace {

QString unitKey(std::size_t quantity) {
  return QStringLiteral("units/") + quantities()[quantity].key;
}

double finiteOr(const QVariant& value, double fallback, double most) {
  bool isNumber = false;
  const double number = value.toDouble(&isNumber);
  return isNumber && std::isfinite(number) && number >= 0 && number <= most ? number : fallback;
}

int between(const QVariant& value, int low, int high, int fallback) {
  bool isNumber = false;
  const int number = value.toInt(&isNumber);
  return isNumber && number >= low && number <= high ? number : fallback;
}

}  // namespace

Settings::Settings(QObject* parent)
    : QObject(parent), file_(QSettings::IniFormat, QSettings::UserScope, "palpa", "palpa") {
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    const QString symbol = file_.value(unitKey(i)).toString();
    const auto& units = unitsOf(static_cast<Quantity>(i));
    const auto found = std::find_if(units.begin(), units.end(),
                                    [&](const Unit& unit) { return unit.symbol == symbol; });
    if (found != units.end()) units_.chosen[i] = static_cast<int>(found - units.begin());
  }
}

void Settings::set(const QString& key, const QVariant& value) {
  if (file_.value(key) == value) return;
  file_.setValue(key, value);
  Q_EMIT changed();
}

Theme Settings::theme() const {
  return file_.value("theme").toString() == "dark" ? Theme::kDark : Theme::kLight;
}

void Settings::setTheme(Theme theme) {
  set("theme", theme == Theme::kDark ? "dark" : "light");
}

void Settings::setUnits(const ShownUnits& units) {
  if (units == units_) return;
  units_ = units;
  for (std::size_t i = 0; i < kQuantityCount; ++i)
    file_.setValue(unitKey(i), units_.of(static_cast<Quantity>(i)).symbol);
  Q_EMIT changed();
}

int Settings::threads() const {
  return between(file_.value("threads"), 0, 1024, 0);
}

void Settings::setThreads(int threads) {
  set("threads", threads);
}

double Settings::memoryLimitGiB() const {
  return finiteOr(file_.value("memoryLimitGiB"), 0, 1e6);
}

void Settings::setMemoryLimitGiB(double limit) {
  set("memoryLimitGiB", limit);
}

double Settings::cacheLimitGiB() const {
  return finiteOr(file_.value("cacheLimitGiB"), 4, 1e6);
}

void Settings::setCacheLimitGiB(double limit) {
  set("cacheLimitGiB", limit);
}

int Settings::autosaveSeconds() const {
  return between(file_.value("autosaveSeconds"), 5, 86400, 60);
}

void Settings::setAutosaveSeconds(int seconds) {
  set("autosaveSeconds", seconds);
}

QStringList Settings::recentFiles() const {
  return file_.value("recentFiles").toStringList().mid(0, kMaxRecentFiles);
}

void Settings::addRecentFile(const QString& file) {
  const QString absolute = QFileInfo(file).absoluteFilePath();
  QStringList files = recentFiles();
  files.removeAll(absolute);
  files.prepend(absolute);
  set("recentFiles", files.mid(0, kMaxRecentFiles));
}

void Settings::removeRecentFile(const QString& file) {
  QStringList files = recentFiles();
  files.removeAll(file);
  set("recentFiles", files);
}

void Settings::clearRecentFiles() {
  set("recentFiles", QStringList());
}

bool Settings::welcomesAtStart() const {
  return file_.value("welcomeAtStart", true).toBool();
}

void Settings::setWelcomesAtStart(bool welcomes) {
  set("welcomeAtStart", welcomes);
}

QString Settings::lastFolder() const {
  const QString folder = file_.value("lastFolder").toString();
  return QDir(folder).exists() ? folder : QDir::homePath();
}

void Settings::setLastFolder(const QString& folder) {
  set("lastFolder", folder);
}

QByteArray Settings::windowGeometry() const {
  return file_.value("window/geometry").toByteArray();
}

QByteArray Settings::windowState() const {
  return file_.value("window/state").toByteArray();
}

void Settings::setWindow(const QByteArray& geometry, const QByteArray& state) {
  file_.setValue("window/geometry", geometry);
  file_.setValue("window/state", state);
}

QByteArray Settings::forcesSplitter() const {
  return file_.value("forces/splitter").toByteArray();
}

void Settings::setForcesSplitter(const QByteArray& state) {
  file_.setValue("forces/splitter", state);
}

QByteArray Settings::ownMaterials() const {
  return file_.value("materials/own").toByteArray();
}

void Settings::setOwnMaterials(const QByteArray& materials) {
  file_.setValue("materials/own", materials);
}

QByteArray Settings::guideGeometry() const {
  return file_.value("guide/geometry").toByteArray();
}

void Settings::setGuideGeometry(const QByteArray& geometry) {
  file_.setValue("guide/geometry", geometry);
}

bool Settings::isFirstRun() const {
  return !file_.contains("window/state");
}

int Settings::colourRangeMode() const {
  return between(file_.value("colourRange/mode"), 0, 3, 0);
}

void Settings::setColourRangeMode(int mode) {
  set("colourRange/mode", mode);
}

std::optional<std::array<double, 2>> Settings::colourRange(app::SurfaceQuantity quantity) const {
  const QStringList parts =
      file_.value(QStringLiteral("colourRange/") + app::infoOf(quantity).name).toStringList();
  if (parts.size() != 2) return std::nullopt;
  bool isLow = false, isHigh = false;
  const std::array<double, 2> range{parts[0].toDouble(&isLow), parts[1].toDouble(&isHigh)};
  const bool isValid =
      isLow && isHigh && std::isfinite(range[0]) && std::isfinite(range[1]) && range[0] < range[1];
  return isValid ? std::optional(range) : std::nullopt;
}

void Settings::setColourRange(app::SurfaceQuantity quantity, const std::array<double, 2>& range) {
  set(QStringLiteral("colourRange/") + app::infoOf(quantity).name,
      QStringList{QString::number(range[0], 'g', 17), QString::number(range[1], 'g', 17)});
}

bool Settings::areExtremesShown() const {
  return file_.value("extremesShown", false).toBool();
}

void Settings::setExtremesShown(bool shown) {
  set("extremesShown", shown);
}

bool Settings::usesMouse3d() const {
  return file_.value("mouse3d", true).toBool();
}

void Settings::setUsesMouse3d(bool uses) {
  set("mouse3d", uses);
}

}  // namespace palpa::gui
