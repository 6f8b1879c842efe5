#pragma once

#include <QDialog>

class QLineEdit;
class QTreeWidget;

namespace palpa::gui {

class GuideReader;

/// Window with the user guide: list of pages, page, search field. Pages are files of the
/// installation; no network is needed.
class GuideWindow : public QDialog {
  Q_OBJECT

 public:
  /// `folder` contains README.md; its links to other pages are the list.
  GuideWindow(const QString& folder, QWidget* parent);

 private:
  void fillContents(const QString& folder);
  void chooseShown(const QUrl& place);
  void find();

  GuideReader* reader_;
  QTreeWidget* contents_;
  QLineEdit* searchText_;
};

}  // namespace palpa::gui
