#include "app/gui/dialogs/recent_list.h"

#include <QApplication>
#include <QContextMenuEvent>
#include <QFileInfo>
#include <QKeyEvent>
#include <QMenu>
#include <QPainter>
#include <QScrollBar>

#include "app/gui/base/appearance.h"
#include "app/gui/document/thumbnails.h"

namespace palpa::gui {
namespace {

constexpr int kFileRole = Qt::UserRole, kMissingRole = Qt::UserRole + 1;
const QSize kPicture = kThumbnailSize / 2;  // logical pixels
constexpr int kSpace = 12;                  // px around a picture and its name
constexpr double kFaintName = 0.35;         // opacity of the picture of a missing file

/// The stored picture, or the sign of a body if there is none, in a frame.
QIcon pictureOf(const QString& file, bool isMissing) {
  const double ratio = qApp->devicePixelRatio();
  QPixmap picture(kPicture * ratio);
  picture.setDevicePixelRatio(ratio);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  if (isMissing) painter.setOpacity(kFaintName);
  const QRect all(QPoint(), kPicture);
  if (const QImage stored = thumbnailOf(file); !stored.isNull())
    painter.drawImage(all, stored);
  else
    icon("solid").paint(&painter, all.adjusted(56, 26, -56, -26));
  painter.setPen(qApp->palette().color(QPalette::Mid));
  painter.drawRect(all.adjusted(0, 0, -1, -1));
  painter.end();
  QIcon result;
  for (const QIcon::Mode mode : {QIcon::Normal, QIcon::Selected}) result.addPixmap(picture, mode);
  return result;
}

}  // namespace

RecentList::RecentList(Settings& settings, QWidget* parent)
    : QListWidget(parent), settings_(settings) {
  setObjectName("recentFiles");
  setAccessibleName(tr("Recent files"));
  setViewMode(QListView::IconMode);
  setMovement(QListView::Static);
  setFlow(QListView::LeftToRight);
  setWrapping(false);
  setIconSize(kPicture);
  setGridSize({kPicture.width() + kSpace, kPicture.height() + 2 * fontMetrics().height() + kSpace});
  setWordWrap(false);
  setTextElideMode(Qt::ElideMiddle);
  setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  setFixedHeight(gridSize().height() + horizontalScrollBar()->sizeHint().height() + kSpace);
  connect(this, &QListWidget::itemClicked, this, &RecentList::choose);
  fill();
}

void RecentList::fill() {
  clear();
  for (const QString& file : settings_.recentFiles()) {
    const bool isMissing = !QFileInfo::exists(file);
    const QString name = QFileInfo(file).fileName();
    auto* item = new QListWidgetItem(pictureOf(file, isMissing),
                                     isMissing ? name + "\n" + tr("missing") : name, this);
    item->setData(kFileRole, file);
    item->setData(kMissingRole, isMissing);
    item->setTextAlignment(Qt::AlignHCenter | Qt::AlignTop);
    item->setToolTip(isMissing
                         ? tr("%1 is not there any more. Delete removes it from the list").arg(file)
                         : file);
    if (isMissing) item->setForeground(palette().placeholderText());
  }
  if (count() > 0) setCurrentRow(0);
}

void RecentList::choose(const QListWidgetItem* item) {
  if (item && !item->data(kMissingRole).toBool())
    Q_EMIT fileChosen(item->data(kFileRole).toString());
}

void RecentList::removeFromList(const QListWidgetItem* item) {
  const int row = QListWidget::row(item);
  settings_.removeRecentFile(item->data(kFileRole).toString());
  keepThumbnails(settings_.recentFiles());
  fill();
  if (count() > 0) setCurrentRow(std::min(row, count() - 1));
}

void RecentList::keyPressEvent(QKeyEvent* event) {
  const bool isEnter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
  if (isEnter && currentItem()) {
    choose(currentItem());
  } else if (event->matches(QKeySequence::Delete) && currentItem()) {
    removeFromList(currentItem());
  } else {
    QListWidget::keyPressEvent(event);
  }
}

void RecentList::contextMenuEvent(QContextMenuEvent* event) {
  const QListWidgetItem* item = itemAt(event->pos());
  if (!item) return;
  QMenu menu(this);
  QAction* open = menu.addAction(tr("&Open"));
  open->setEnabled(!item->data(kMissingRole).toBool());
  const QAction* remove = menu.addAction(tr("&Remove from the list"));
  const QAction* chosen = menu.exec(event->globalPos());
  if (chosen == open) choose(item);
  if (chosen == remove) removeFromList(item);
}

}  // namespace palpa::gui
