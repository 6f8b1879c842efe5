#pragma once

#include <QImage>
#include <QString>
#include <QStringList>

// Small pictures of files in the cache folder, for the welcome dialog.
namespace palpa::gui {

/// Size in pixels: twice the size that is shown.
inline constexpr QSize kThumbnailSize{320, 200};

/// PNG file for the picture of a file; empty without a cache folder. Makes the folder.
QString thumbnailPath(const QString& file);

/// Null if there is no picture.
QImage thumbnailOf(const QString& file);

/// Removes the pictures of all other files.
void keepThumbnails(const QStringList& files);

}  // namespace palpa::gui
