#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QScreen>
#include <QScrollBar>
#include <QTextBlock>
#include <QTreeWidget>
#include <set>

#include "app/gui/base/appearance.h"
#include "app/gui/dialogs/guide_reader.h"
#include "app/gui/dialogs/guide_window.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

class Guide : public WindowTest {
 protected:
  void open() {
    QApplication::setActiveWindow(window_.get());
    QTest::keyClick(window_.get(), Qt::Key_F1);
    guide_ = window_->findChild<GuideWindow*>();
    ASSERT_NE(guide_, nullptr);
    ASSERT_TRUE(QTest::qWaitForWindowExposed(guide_));
    QApplication::setActiveWindow(guide_);
    reader_ = guide_->findChild<GuideReader*>();
    contents_ = guide_->findChild<QTreeWidget*>("contents");
    find_ = guide_->findChild<QLineEdit*>("find");
  }

  QString page() { return reader_->source().fileName(); }
  QString count() { return guide_->findChild<QLabel*>("findCount")->text(); }
  /// The text in the upper part of the page that is visible.
  QString visibleText() {
    QTextCursor cursor = reader_->cursorForPosition({40, 4});
    cursor.setPosition(
        reader_->cursorForPosition({40, reader_->viewport()->height() / 2}).position(),
        QTextCursor::KeepAnchor);
    return cursor.selectedText();
  }

  GuideWindow* guide_ = nullptr;
  GuideReader* reader_ = nullptr;
  QTreeWidget* contents_ = nullptr;
  QLineEdit* find_ = nullptr;
};

TEST_F(Guide, ShowsItsPages) {
  open();
  contents_->setCurrentItem(contents_->topLevelItem(0));
  EXPECT_TRUE(reader_->toPlainText().contains("First touch in five minutes"));
  // Every page of the list opens with its pictures, which fit the page.
  ASSERT_GE(contents_->topLevelItemCount(), 7);
  for (const int width : {1080, 460}) {
    guide_->resize(width, 720);
    for (int i = 0; i < contents_->topLevelItemCount(); ++i) {
      contents_->setCurrentItem(contents_->topLevelItem(i));
      EXPECT_EQ(reader_->source(), contents_->topLevelItem(i)->data(0, Qt::UserRole).toUrl());
      EXPECT_GT(reader_->toPlainText().size(), 1000) << page().toStdString();
      EXPECT_FALSE(reader_->horizontalScrollBar()->isVisible()) << page().toStdString() << width;
      keepPicture(QString("guide-%1-%2").arg(width).arg(i), guide_);
    }
  }
  // A link to a heading of another page scrolls it to the top; Back returns.
  contents_->setCurrentItem(contents_->topLevelItem(0));
  reader_->setSource(QUrl("window.md#nothing-is-lost"));
  EXPECT_EQ(page(), "window.md");
  EXPECT_EQ(contents_->currentItem()->text(0), "The window");
  EXPECT_EQ(reader_->cursorForPosition({40, 20}).block().text().toStdString(), "Nothing is lost");
  QTest::keyClick(guide_, Qt::Key_Left, Qt::AltModifier);
  EXPECT_EQ(page(), "README.md");
  // The page follows the theme.
  reader_->setSource(QUrl("command-line.md"));
  window_->settings().setTheme(Theme::kDark);
  keepPicture("guide-dark", guide_);
  const QImage dark = guide_->grab().toImage();
  EXPECT_LT(dark.pixelColor(dark.width() / 2, dark.height() - 30).lightness(), 128);
}

TEST_F(Guide, FindsInAllPages) {
  open();
  contents_->setCurrentItem(contents_->topLevelItem(0));
  QTest::keyClick(reader_, Qt::Key_F, Qt::ControlModifier);
  ASSERT_TRUE(find_->hasFocus());
  QTest::keyClicks(find_, "CONTROL POINTS");
  ASSERT_TRUE(count().contains(" of ")) << count().toStdString();
  const int all = count().section(' ', 2).toInt();
  ASSERT_GT(all, 8);
  int counted = 0, pages = 0;
  for (int i = 0; i < contents_->topLevelItemCount(); ++i) {
    counted += contents_->topLevelItem(i)->text(1).toInt();
    pages += contents_->topLevelItem(i)->text(1).isEmpty() ? 0 : 1;
  }
  EXPECT_EQ(counted, all);
  ASSERT_GT(pages, 2);
  keepPicture("guide-find", guide_);
  // Enter goes through all matches of all pages and begins again; each is selected and in view.
  std::set<QString> seen;
  const QString first = count();
  for (int i = 0; i < all; ++i) {
    EXPECT_EQ(reader_->textCursor().selectedText().toLower(), "control points");
    EXPECT_TRUE(reader_->viewport()->rect().contains(reader_->cursorRect().center()));
    seen.insert(page());
    QTest::keyClick(find_, Qt::Key_Return);
  }
  EXPECT_EQ(count(), first);
  EXPECT_EQ(static_cast<int>(seen.size()), pages);
  // Backwards from the first match: the last one. All matches of the page are marked.
  QTest::keyClick(find_, Qt::Key_Return, Qt::ShiftModifier);
  EXPECT_EQ(count().section(' ', 0, 0).toInt(), all);
  QTest::keyClick(guide_, Qt::Key_F3);
  EXPECT_EQ(count(), first);
  EXPECT_EQ(reader_->extraSelections().size(), contents_->currentItem()->text(1).toInt());
  // Unknown text is said, and nothing moves.
  const int place = reader_->verticalScrollBar()->value();
  find_->setText("xyzzy");
  EXPECT_EQ(count(), "0 of 0");
  EXPECT_TRUE(find_->property("refused").toBool());
  EXPECT_EQ(reader_->verticalScrollBar()->value(), place);
  find_->clear();
  EXPECT_TRUE(count().isEmpty());
  EXPECT_TRUE(reader_->extraSelections().empty());
}

TEST_F(Guide, OpensWhereTheToolIsDescribed) {
  action("Place load")->trigger();
  open();
  EXPECT_EQ(page(), "supports-and-loads.md");
  EXPECT_TRUE(visibleText().contains("Place load (L)")) << visibleText().toStdString();
  keepPicture("guide-tool", guide_);
  // With the same tool it stays where the reader was.
  reader_->verticalScrollBar()->setValue(reader_->verticalScrollBar()->maximum());
  const int place = reader_->verticalScrollBar()->value();
  guide_->close();
  open();
  EXPECT_EQ(reader_->verticalScrollBar()->value(), place);
  action("Simulate")->trigger();
  action("Ball")->trigger();
  open();
  EXPECT_EQ(page(), "simulate.md");
  EXPECT_TRUE(visibleText().contains("Ball (B)")) << visibleText().toStdString();
}

TEST_F(Guide, LeavesTheViewVisibleAndKeepsItsPlace) {
  const QRect screen = window_->screen()->availableGeometry();
  window_->setGeometry(0, 0, 1280, 800);
  QTest::qWait(50);
  open();
  // There is room beside the window.
  EXPECT_TRUE(guide_->geometry().intersected(window_->geometry()).isEmpty());
  EXPECT_TRUE(screen.contains(guide_->geometry()));
  guide_->setGeometry(333, 111, 555, 444);
  QTest::qWait(50);
  guide_->close();
  restart();
  open();
  EXPECT_EQ(guide_->geometry(), QRect(333, 111, 555, 444));
  // On a full screen it covers the panels and leaves the view.
  window_->settings().setGuideGeometry({});
  restart();
  window_->setGeometry(screen);
  QTest::qWait(50);
  open();
  const QRect view(window_->viewport().mapToGlobal(QPoint(0, 0)), window_->viewport().size());
  const QRect covered = guide_->geometry().intersected(view);
  EXPECT_LT(covered.width() * covered.height(), view.width() * view.height() / 4);
}

}  // namespace
}  // namespace palpa::gui
