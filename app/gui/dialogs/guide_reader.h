#pragma once

#include <QTextBrowser>

namespace palpa::gui {

/// Shows pages of the documentation: Markdown files with pictures, tables and links between them.
/// Links to other pages and to headings are followed here, all others by the desktop.
class GuideReader : public QTextBrowser {
  Q_OBJECT

 public:
  explicit GuideReader(QWidget* parent = nullptr);

  /// Pictures are made as wide as the page at most.
  QVariant loadResource(int type, const QUrl& name) override;

 protected:
  void doSetSource(const QUrl& name, QTextDocument::ResourceType type) override;
  void changeEvent(QEvent* event) override;

 private:
  void layOut();
};

}  // namespace palpa::gui
