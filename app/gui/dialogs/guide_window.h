#pragma once

#include <QDialog>
#include <optional>

#include "app/gui/base/settings.h"
#include "app/gui/dialogs/guide_search.h"

class QLabel;
class QLineEdit;
class QSplitter;
class QToolButton;
class QTreeWidget;

namespace palpa::gui {

class GuideReader;

/// Window with the user guide: list of pages, page, search in all pages. Pages are files of the
/// installation; no network is needed. Place and size are stored in the settings.
class GuideWindow : public QDialog {
  Q_OBJECT

 public:
  /// `folder` contains README.md; its links to other pages are the list.
  GuideWindow(const QString& folder, Settings& settings, QWidget* parent);

  /// Shows the place in the pages where a text occurs first, and marks it. Does nothing if the text
  /// is the same as in the last call, so that the reader returns to where they were.
  void showTopic(const QString& text);

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void moveEvent(QMoveEvent* event) override;

 private:
  void fillContents(const QString& folder);
  void addShortcuts();
  /// Beside the window of the program, or over its panels where the screen is too small.
  void placeBeside(const QWidget& window);
  void storePlace();
  void chooseShown(const QUrl& place);
  void search(const QString& text);
  void step(bool forwards);
  void showMatch(std::optional<int> match);
  /// Marks all matches of the page that is shown.
  void mark();
  QUrl pageOfRow(int row) const;

  Settings& settings_;
  GuideSearch search_;
  GuideReader* reader_;
  QTreeWidget* contents_;
  QSplitter* splitter_;
  QLineEdit* searchText_;
  QLabel* count_;
  std::optional<int> match_;  // the present one
  QString topic_;
};

}  // namespace palpa::gui
