#pragma once

#include <QListWidget>

#include "app/gui/base/settings.h"

namespace palpa::gui {

/// Recent files with their pictures. Enter or a click chooses a file; Delete or the right button
/// removes one from the list. Missing files are grey and cannot be chosen.
class RecentList : public QListWidget {
  Q_OBJECT

 public:
  RecentList(Settings& settings, QWidget* parent);

 Q_SIGNALS:
  void fileChosen(const QString& file);

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

 private:
  void fill();
  void choose(const QListWidgetItem* item);
  void removeFromList(const QListWidgetItem* item);

  Settings& settings_;
};

}  // namespace palpa::gui
