#pragma once

#include <QDialog>

class QLineEdit;
class QTreeWidget;

namespace palpa::gui {

class GuideReader;

/// The user guide, beside the window: the list of its pages, a page, a field to find words. Pages
/// are files of the installation, so it needs no network.
class GuideWindow : public QDialog {
  Q_OBJECT

 public:
  /// `folder` holds README.md, whose links to other pages make the list.
  GuideWindow(const QString& folder, QWidget* parent);

 private:
  void fillContents(const QString& folder);
  void chooseShown(const QUrl& place);
  void find();

  GuideReader* reader_;
  QTreeWidget* contents_;
  QLineEdit* wanted_;
};

}  // namespace palpa::gui
