#include "app/gui/document/thumbnails.h"

#include <QCryptographicHash>
#include <QDir>
#include <QFileInfo>

#include "app/core/model/model_cache.h"

namespace palpa::gui {
namespace {

QString folder() {
  const std::filesystem::path cache = app::defaultCacheFolder();
  return cache.empty() ? QString() : QString::fromStdString((cache / "thumbnails").string());
}

/// The name hides the path of the file: other users may be able to list the folder.
QString nameOf(const QString& file) {
  const QByteArray path = QFileInfo(file).absoluteFilePath().toUtf8();
  return QCryptographicHash::hash(path, QCryptographicHash::Sha256).toHex().left(32) + ".png";
}

}  // namespace

QString thumbnailPath(const QString& file) {
  const QString in = folder();
  if (in.isEmpty() || !QDir().mkpath(in)) return {};
  return QDir(in).filePath(nameOf(file));
}

QImage thumbnailOf(const QString& file) {
  const QString in = folder();
  return in.isEmpty() ? QImage() : QImage(QDir(in).filePath(nameOf(file)));
}

void keepThumbnails(const QStringList& files) {
  if (folder().isEmpty()) return;
  QStringList kept;
  for (const QString& file : files) kept << nameOf(file);
  QDir in(folder());
  for (const QString& name : in.entryList({"*.png"}, QDir::Files))
    if (!kept.contains(name)) in.remove(name);
}

}  // namespace palpa::gui
