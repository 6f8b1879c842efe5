#pragma once

#include <QTextBrowser>

namespace palpa::gui {

/// Shows pages of the documentation: Markdown files with pictures, tables and links. It follows
/// links to pages and headings itself and passes all others to the desktop.
class GuideReader : public QTextBrowser {
  Q_OBJECT

 public:
  explicit GuideReader(QWidget* parent = nullptr);

  /// Scales pictures down to the width of the page.
  QVariant loadResource(int type, const QUrl& name) override;

 protected:
  void doSetSource(const QUrl& name, QTextDocument::ResourceType type) override;
  void changeEvent(QEvent* event) override;

 private:
  void layOut();
};

}  // namespace palpa::gui
