#include "app/gui/dialogs/guide_window.h"

#include <QDir>
#include <QFile>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QRegularExpression>
#include <QScreen>
#include <QShortcut>
#include <QSplitter>
#include <QStyle>
#include <QTextCursor>
#include <QToolButton>
#include <QTreeWidget>
#include <QUrl>
#include <QVBoxLayout>
#include <algorithm>

#include "app/gui/dialogs/guide_reader.h"

namespace palpa::gui {
namespace {

constexpr int kWidth = 760, kNarrowWidth = 460;  // px: beside the window, over its panels
constexpr int kMinBeside = 420;                  // px of free screen beside the window
constexpr int kWindowFrame = 36;                 // px: title bar of a window, approximately
constexpr int kColumns = 700;                    // px: wider windows show the list beside the page
constexpr int kListWidth = 210;
constexpr int kListHeight = 150;  // shows the seven pages without scrolling

QToolButton* makeButton(QWidget* parent, const QString& name, const QString& text,
                        Qt::ArrowType arrow) {
  auto* button = new QToolButton(parent);
  button->setObjectName(name);
  button->setArrowType(arrow);
  button->setToolTip(text);
  button->setAccessibleName(text);
  return button;
}

}  // namespace

GuideWindow::GuideWindow(const QString& folder, Settings& settings, QWidget* parent)
    : QDialog(parent), settings_(settings) {
  setObjectName("guide");
  setWindowTitle(tr("User guide"));
  setWindowFlag(Qt::WindowMaximizeButtonHint);
  QToolButton* back = makeButton(this, "back", tr("Back (Alt+Left)"), Qt::LeftArrow);
  QToolButton* forward = makeButton(this, "forward", tr("Forward (Alt+Right)"), Qt::RightArrow);
  for (QToolButton* button : {back, forward}) button->setEnabled(false);
  searchText_ = new QLineEdit(this);
  searchText_->setObjectName("find");
  searchText_->setPlaceholderText(tr("Find in all pages (Ctrl+F)"));
  searchText_->setAccessibleName(tr("Find in all pages"));
  searchText_->setClearButtonEnabled(true);
  count_ = new QLabel(this);
  count_->setObjectName("findCount");
  QToolButton* previous =
      makeButton(this, "findPrevious", tr("Previous match (Shift+Enter, Shift+F3)"), Qt::UpArrow);
  QToolButton* next = makeButton(this, "findNext", tr("Next match (Enter, F3)"), Qt::DownArrow);
  contents_ = new QTreeWidget(this);
  contents_->setObjectName("contents");
  contents_->setAccessibleName(tr("Contents"));
  contents_->setHeaderHidden(true);
  contents_->setRootIsDecorated(false);
  contents_->setColumnCount(2);
  contents_->header()->setStretchLastSection(false);
  contents_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  contents_->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  reader_ = new GuideReader(this);
  reader_->setAccessibleName(windowTitle());

  auto* line = new QHBoxLayout;
  line->addWidget(back);
  line->addWidget(forward);
  line->addWidget(searchText_, 1);
  line->addWidget(count_);
  line->addWidget(previous);
  line->addWidget(next);
  splitter_ = new QSplitter(this);
  splitter_->addWidget(contents_);
  splitter_->addWidget(reader_);
  splitter_->setStretchFactor(1, 1);
  splitter_->setChildrenCollapsible(false);
  auto* column = new QVBoxLayout(this);
  column->addLayout(line);
  column->addWidget(splitter_, 1);
  if (!restoreGeometry(settings_.guideGeometry())) placeBeside(*parent->window());
  ensurePolished();
  column->activate();  // pictures need the width of the page

  connect(back, &QToolButton::clicked, reader_, &GuideReader::backward);
  connect(forward, &QToolButton::clicked, reader_, &GuideReader::forward);
  connect(reader_, &GuideReader::backwardAvailable, back, &QToolButton::setEnabled);
  connect(reader_, &GuideReader::forwardAvailable, forward, &QToolButton::setEnabled);
  connect(reader_, &GuideReader::sourceChanged, this, &GuideWindow::chooseShown);
  connect(searchText_, &QLineEdit::textChanged, this, &GuideWindow::search);
  connect(previous, &QToolButton::clicked, this, [this] { step(false); });
  connect(next, &QToolButton::clicked, this, [this] { step(true); });
  connect(contents_, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    if (item) reader_->setSource(pageOfRow(contents_->indexOfTopLevelItem(item)));
  });
  addShortcuts();
  fillContents(folder);
  contents_->setCurrentItem(contents_->topLevelItem(0));
  search({});
  reader_->setFocus();
}

void GuideWindow::addShortcuts() {
  const auto add = [this](const QKeySequence& keys, auto work) {
    connect(new QShortcut(keys, this), &QShortcut::activated, this, work);
  };
  add(QKeySequence::Find, [this] {
    searchText_->setFocus();
    searchText_->selectAll();
  });
  add(Qt::Key_F3, [this] { step(true); });
  add(Qt::SHIFT | Qt::Key_F3, [this] { step(false); });
  add(Qt::ALT | Qt::Key_Left, [this] { reader_->backward(); });
  add(Qt::ALT | Qt::Key_Right, [this] { reader_->forward(); });
  for (const Qt::Key key : {Qt::Key_Return, Qt::Key_Enter}) {
    for (const bool forwards : {true, false}) {
      auto* enter =
          new QShortcut(forwards ? QKeySequence(key) : QKeySequence(Qt::SHIFT | key), searchText_);
      enter->setContext(Qt::WidgetShortcut);
      connect(enter, &QShortcut::activated, this, [this, forwards] { step(forwards); });
    }
  }
}

void GuideWindow::fillContents(const QString& folder) {
  const QString first = QDir(folder).filePath("README.md");
  const auto add = [&](const QString& title, const QUrl& page) {
    auto* item = new QTreeWidgetItem(contents_, {title});
    item->setData(0, Qt::UserRole, page);
    item->setTextAlignment(1, Qt::AlignRight | Qt::AlignVCenter);
    search_.addPage(page);
  };
  const QUrl base = QUrl::fromLocalFile(first);
  add(tr("Begin here"), base);
  QFile file(first);
  if (!file.open(QIODevice::ReadOnly)) return;
  // Each page is a line of the list of contents: "- [Title](page.md): description".
  static const QRegularExpression kEntry("^- \\[([^\\]]+)\\]\\(([^)#]+\\.md)\\)",
                                         QRegularExpression::MultilineOption);
  const QString text = QString::fromUtf8(file.readAll());
  for (auto entries = kEntry.globalMatch(text); entries.hasNext();) {
    const QRegularExpressionMatch entry = entries.next();
    add(entry.captured(1), base.resolved(QUrl(entry.captured(2))));
  }
}

QUrl GuideWindow::pageOfRow(int row) const {
  return contents_->topLevelItem(row)->data(0, Qt::UserRole).toUrl();
}

void GuideWindow::placeBeside(const QWidget& window) {
  const QRect screen = window.screen()->availableGeometry();
  const QRect taken = window.frameGeometry().intersected(screen);
  const int right = screen.right() - taken.right(), left = taken.left() - screen.left();
  const int height = std::min(screen.height(), taken.height()) - kWindowFrame;
  int width = std::min(kWidth, std::max(right, left));
  int x = right >= left ? taken.right() + 1 : taken.left() - width;
  if (std::max(right, left) < kMinBeside) {
    width = std::min(kNarrowWidth, screen.width() / 2);
    x = taken.right() + 1 - width;
  }
  setGeometry(x, taken.top() + kWindowFrame, width, height);
}

void GuideWindow::storePlace() {
  if (isVisible()) settings_.setGuideGeometry(saveGeometry());
}

void GuideWindow::resizeEvent(QResizeEvent* event) {
  QDialog::resizeEvent(event);
  const Qt::Orientation wanted = width() >= kColumns ? Qt::Horizontal : Qt::Vertical;
  if (splitter_->orientation() != wanted || event->oldSize().isEmpty()) {
    splitter_->setOrientation(wanted);
    splitter_->setSizes(wanted == Qt::Horizontal
                            ? QList<int>{kListWidth, width() - kListWidth}
                            : QList<int>{std::min(kListHeight, height() / 4), height()});
  }
  storePlace();
}

void GuideWindow::moveEvent(QMoveEvent* event) {
  QDialog::moveEvent(event);
  storePlace();
}

void GuideWindow::showTopic(const QString& text) {
  if (text == topic_) return;
  topic_ = text;
  const auto place = search_.placeOf(text);
  if (!place) return;
  reader_->setSource(search_.page(place->page));
  reader_->goTo(place->position);
  mark();
}

void GuideWindow::chooseShown(const QUrl& place) {
  const QUrl page = place.adjusted(QUrl::RemoveFragment);
  const QSignalBlocker blocker(contents_);
  contents_->setCurrentItem(nullptr);
  for (int i = 0; i < contents_->topLevelItemCount(); ++i)
    if (pageOfRow(i) == page) contents_->setCurrentItem(contents_->topLevelItem(i));
  mark();
}

void GuideWindow::search(const QString& text) {
  search_.find(text);
  for (int i = 0; i < contents_->topLevelItemCount(); ++i) {
    const int count = search_.countIn(i);
    contents_->topLevelItem(i)->setText(1, count > 0 ? QString::number(count) : QString());
  }
  const int page = search_.indexOf(reader_->source()).value_or(0);
  showMatch(search_.nextFrom(page, reader_->textCursor().selectionStart()));
}

void GuideWindow::step(bool forwards) {
  const int page = search_.indexOf(reader_->source()).value_or(0);
  const int position = reader_->textCursor().selectionStart();
  showMatch(forwards ? search_.nextFrom(page, position + 1) : search_.previousFrom(page, position));
}

void GuideWindow::showMatch(std::optional<int> match) {
  match_ = match;
  const QString text = searchText_->text();
  const bool isMissing = !text.isEmpty() && !match;
  count_->setText(text.isEmpty() ? QString()
                  : isMissing    ? tr("0 of 0")
                                 : tr("%1 of %2").arg(*match + 1).arg(search_.matches().size()));
  if (searchText_->property("refused").toBool() != isMissing) {
    searchText_->setProperty("refused", isMissing);
    style()->polish(searchText_);
  }
  for (const char* name : {"findPrevious", "findNext"})
    findChild<QToolButton*>(name)->setEnabled(match.has_value());
  if (match) {
    const GuideSearch::Match& found = search_.matches()[*match];
    if (search_.indexOf(reader_->source()) != found.page)
      reader_->setSource(search_.page(found.page));
    reader_->goTo(found.position, found.length);
  }
  mark();
}

void GuideWindow::mark() {
  std::vector<GuideReader::Mark> marks;
  const auto page = search_.indexOf(reader_->source());
  for (std::size_t i = 0; page && i < search_.matches().size(); ++i)
    if (const GuideSearch::Match& match = search_.matches()[i]; match.page == *page)
      marks.push_back({match.position, match.length, static_cast<int>(i) == match_});
  reader_->setMarks(marks);
}

}  // namespace palpa::gui
