#include "app/gui/dialogs/guide_reader.h"

#include <QAbstractTextDocumentLayout>
#include <QDesktopServices>
#include <QFile>
#include <QFileInfo>
#include <QImage>
#include <QRegularExpression>
#include <QScrollBar>
#include <QTextBlock>
#include <QTextDocument>
#include <QTextFrame>
#include <QTextTable>
#include <algorithm>
#include <utility>

namespace palpa::gui {
namespace {

constexpr int kPageMargin = 24;            // beside the text
constexpr int kMaxImageWidth = 900;        // logical pixels
constexpr int kLineHeight = 125;           // per cent
constexpr int kFaint = 60, kStrong = 150;  // opacity of marks, of 255

/// Anchor of a heading, as on the web: lower case, words joined by "-".
QString anchorOf(QString heading) {
  static const QRegularExpression kPunctuation("[^\\w\\- ]",
                                               QRegularExpression::UseUnicodePropertiesOption);
  return heading.toLower().remove(kPunctuation).replace(' ', '-');
}

/// Makes tables as wide as the page, with lines between their cells.
void layOutTables(QTextFrame* frame) {
  for (QTextFrame* child : frame->childFrames()) layOutTables(child);
  auto* table = qobject_cast<QTextTable*>(frame);
  if (!table) return;
  QTextTableFormat format = table->format();
  format.setWidth(QTextLength(QTextLength::PercentageLength, 100));
  format.setCellPadding(5);
  format.setCellSpacing(0);
  format.setBorder(1);
  format.setBorderCollapse(true);
  table->setFormat(format);
}

/// Adds anchors to headings, background and wrapping to code, and space to lines and headings.
void layOutText(QTextDocument& document, const QBrush& behindCode) {
  for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
    QTextCursor cursor(block);
    QTextBlockFormat format = block.blockFormat();
    const bool hasPicture = block.text().contains(QChar::ObjectReplacementCharacter);
    if (format.hasProperty(QTextFormat::BlockCodeFence)) {
      format.setBackground(behindCode);
      format.setNonBreakableLines(false);
    } else if (!hasPicture) {
      format.setLineHeight(kLineHeight, QTextBlockFormat::ProportionalHeight);
    }
    if (format.headingLevel() > 1) format.setTopMargin(kPageMargin);
    cursor.setBlockFormat(format);
    if (format.headingLevel() == 0) continue;
    QTextCharFormat place;
    place.setAnchor(true);
    place.setAnchorNames({anchorOf(block.text())});
    cursor.movePosition(QTextCursor::EndOfBlock, QTextCursor::KeepAnchor);
    cursor.mergeCharFormat(place);
  }
}

/// Colours links again: the Markdown reader uses the theme at the start of the program.
void colourLinks(QTextDocument& document, const QBrush& colour) {
  std::vector<std::pair<int, int>> links;  // from, to
  for (QTextBlock block = document.begin(); block.isValid(); block = block.next())
    for (auto it = block.begin(); !it.atEnd(); ++it)
      if (const QTextFragment part = it.fragment(); !part.charFormat().anchorHref().isEmpty())
        links.emplace_back(part.position(), part.position() + part.length());
  QTextCharFormat format;
  format.setForeground(colour);
  QTextCursor cursor(&document);
  for (const auto& [from, to] : links) {
    cursor.setPosition(from);
    cursor.setPosition(to, QTextCursor::KeepAnchor);
    cursor.mergeCharFormat(format);
  }
}

}  // namespace

GuideReader::GuideReader(QWidget* parent) : QTextBrowser(parent) {
  setObjectName("guideReader");
  document()->setDocumentMargin(kPageMargin);
  setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOn);  // keeps the width of pictures constant
  // Tables are up to a pixel wider than the page, which is no reason for a scroll bar.
  connect(document()->documentLayout(), &QAbstractTextDocumentLayout::documentSizeChanged, this,
          [this](const QSizeF& size) {
            setHorizontalScrollBarPolicy(size.width() < viewport()->width() + 2
                                             ? Qt::ScrollBarAlwaysOff
                                             : Qt::ScrollBarAsNeeded);
          });
}

void GuideReader::goTo(int position, int length) {
  QTextCursor cursor(document());
  cursor.setPosition(std::min(position, document()->characterCount() - 1));
  line_ = length == 0 ? cursor.position() : -1;
  setTextCursor(cursor);
  // Below the top, so that the text before it gives the context.
  const int above = cursorRect(cursor).top() - viewport()->height() / 5;
  verticalScrollBar()->setValue(verticalScrollBar()->value() + above);
  cursor.setPosition(std::min(position + length, document()->characterCount() - 1),
                     QTextCursor::KeepAnchor);
  setTextCursor(cursor);
}

void GuideReader::setMarks(const std::vector<Mark>& marks) {
  QList<QTextEdit::ExtraSelection> selections;
  const auto add = [&](int position, int length, int alpha) -> QTextEdit::ExtraSelection& {
    QTextEdit::ExtraSelection& selection = selections.emplace_back();
    selection.cursor = QTextCursor(document());
    selection.cursor.setPosition(position);
    selection.cursor.setPosition(position + length, QTextCursor::KeepAnchor);
    QColor colour = palette().color(QPalette::Highlight);
    colour.setAlpha(alpha);
    selection.format.setBackground(colour);
    return selection;
  };
  const int end = document()->characterCount() - 1;
  if (line_ >= 0 && line_ <= end)
    add(line_, 0, kFaint).format.setProperty(QTextFormat::FullWidthSelection, true);
  for (const Mark& mark : marks)
    if (mark.position + mark.length <= end)
      add(mark.position, mark.length, mark.isPresent ? kStrong : kFaint);
  setExtraSelections(selections);
}

QVariant GuideReader::loadResource(int type, const QUrl& name) {
  const QVariant found = QTextBrowser::loadResource(type, name);
  if (type != QTextDocument::ImageResource) return found;
  QImage picture = found.value<QImage>();
  if (picture.isNull()) picture = QImage::fromData(found.toByteArray());
  const int most = std::min(kMaxImageWidth, viewport()->width() - 2 * kPageMargin - 4);
  if (picture.isNull() || picture.width() <= most) return found;
  const double ratio = devicePixelRatioF();
  picture = picture.scaledToWidth(static_cast<int>(most * ratio), Qt::SmoothTransformation);
  picture.setDevicePixelRatio(ratio);
  return picture;
}

void GuideReader::doSetSource(const QUrl& name, QTextDocument::ResourceType type) {
  const QUrl target = source().resolved(name);
  const bool isPage = target.isLocalFile() && target.path().endsWith(".md");
  if (!isPage) {
    QDesktopServices::openUrl(target);
    return;
  }
  if (target.adjusted(QUrl::RemoveFragment) != source().adjusted(QUrl::RemoveFragment)) {
    line_ = -1;
    QTextBrowser::doSetSource(target, type);
    layOut();
  }
  verticalScrollBar()->setValue(0);
  if (!target.hasFragment()) return;
  scrollToAnchor(target.fragment());
  verticalScrollBar()->setValue(verticalScrollBar()->value() - kPageMargin / 2);
}

// The background of code has the colour of the theme at reading: read the page again.
void GuideReader::changeEvent(QEvent* event) {
  QTextBrowser::changeEvent(event);
  if (event->type() != QEvent::PaletteChange || source().isEmpty()) return;
  const int place = verticalScrollBar()->value();
  reload();
  layOut();
  verticalScrollBar()->setValue(place);
}

void GuideReader::layOut() {
  layOutTables(document()->rootFrame());
  layOutText(*document(), palette().alternateBase());
  colourLinks(*document(), palette().link());
}

}  // namespace palpa::gui
