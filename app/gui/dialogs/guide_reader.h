#pragma once

#include <QTextBrowser>
#include <vector>

namespace palpa::gui {

/// Shows pages of the documentation: Markdown files with pictures, tables and links. It follows
/// links to pages and headings itself and passes all others to the desktop.
class GuideReader : public QTextBrowser {
  Q_OBJECT

 public:
  struct Mark {
    int position = 0, length = 0;
    bool isPresent = false;
  };

  explicit GuideReader(QWidget* parent = nullptr);

  /// Selects a part of the page and scrolls to it. With length 0: marks its line instead.
  void goTo(int position, int length = 0);
  /// Highlights parts of the page, the present one stronger.
  void setMarks(const std::vector<Mark>& marks);

  /// Scales pictures down to the width of the page.
  QVariant loadResource(int type, const QUrl& name) override;

 protected:
  void doSetSource(const QUrl& name, QTextDocument::ResourceType type) override;
  void changeEvent(QEvent* event) override;

 private:
  void layOut();

  int line_ = -1;  // position of the marked line
};

}  // namespace palpa::gui
