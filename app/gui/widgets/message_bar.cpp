#include "app/gui/widgets/message_bar.h"

#include <QEvent>
#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QTimer>
#include <QToolButton>
#include <algorithm>

#include "app/gui/base/appearance.h"

namespace palpa::gui {
namespace {

constexpr int kNoteTime = 12000;      // ms until a note disappears
constexpr int kMaxShownLength = 240;  // characters shown without "Details"
constexpr int kMargin = 10;           // px to the widget below
constexpr int kMaxWidth = 720;        // px
constexpr int kMinBarWidth = 260;     // px

/// The first line of a message, shortened after a word.
QString beginning(const QString& text) {
  QString first = text.section('\n', 0, 0);
  if (first.size() > kMaxShownLength)
    first = first.left(kMaxShownLength).section(' ', 0, -2) + QStringLiteral(" …");
  return first;
}

QToolButton* makeButton(QWidget* row, const QString& name, const QString& text) {
  auto* button = new QToolButton(row);
  button->setObjectName(name);
  button->setText(text);
  button->setToolTip(text);
  button->setAccessibleName(text);
  button->setFocusPolicy(Qt::StrongFocus);
  return button;
}

}  // namespace

MessageBar::MessageBar(QWidget* under, int keptFree)
    : QWidget(under), keptFree_(keptFree), rows_(new QVBoxLayout(this)) {
  setObjectName("messages");
  setStyleSheet(
      "QFrame#message { background: palette(base); border: 1px solid palette(mid);"
      " border-left: 4px solid palette(highlight); border-radius: 5px; }"
      "QFrame#message[error=\"true\"] { border-left-color: #d0462b; }");
  rows_->setContentsMargins(0, 0, 0, 0);
  rows_->setSpacing(6);
  under->installEventFilter(this);
  hide();
}

QStringList MessageBar::messages() const {
  QStringList texts;
  for (int i = 0; i < rows_->count(); ++i)
    texts << rows_->itemAt(i)->widget()->property("text").toString();
  for (const Message& message : waiting_) texts << message.text;
  return texts;
}

bool MessageBar::hasErrors() const {
  for (int i = 0; i < rows_->count(); ++i)
    if (rows_->itemAt(i)->widget()->property("error").toBool()) return true;
  return std::any_of(waiting_.begin(), waiting_.end(),
                     [](const Message& message) { return message.isError; });
}

void MessageBar::clear() {
  waiting_.clear();
  while (rows_->count() > 0) remove(rows_->itemAt(0)->widget());
}

void MessageBar::withdraw(const QString& text) {
  std::erase_if(waiting_, [&](const Message& message) { return message.text == text; });
  for (int i = rows_->count() - 1; i >= 0; --i) {
    QWidget* row = rows_->itemAt(i)->widget();
    if (row->property("text").toString() == text) remove(row);
  }
}

void MessageBar::add(Message message) {
  if (messages().contains(message.text)) return;
  waiting_.push_back(std::move(message));
  showNext();
}

void MessageBar::showNext() {
  while (!waiting_.empty() && rows_->count() < kMaxMessages) {
    QWidget* row = makeRow(waiting_.front());
    if (!waiting_.front().isError) leaveLater(row);
    waiting_.pop_front();
    rows_->addWidget(row);
    row->show();
  }
  setVisible(rows_->count() > 0);
  raise();
  place();
}

void MessageBar::leaveLater(QWidget* row) {
  auto* timer = new QTimer(row);
  connect(timer, &QTimer::timeout, this, [this, row] {
    if (!row->underMouse()) remove(row);  // under the pointer, it is probably being read
  });
  timer->start(kNoteTime);
}

QWidget* MessageBar::makeRow(const Message& message) {
  auto* row = new QFrame(this);
  row->setObjectName("message");
  row->setProperty("error", message.isError);
  row->setProperty("text", message.text);
  auto* picture = new QLabel(row);
  picture->setObjectName("picture");
  drawPicture(*row);
  const QString shortText = beginning(message.text);
  auto* text = new QLabel(shortText, row);
  text->setObjectName("text");
  text->setTextFormat(Qt::PlainText);
  text->setWordWrap(true);
  text->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  text->setAccessibleName(message.isError ? tr("Error") : tr("Note"));
  auto* line = new QHBoxLayout(row);
  line->setContentsMargins(8, 6, 6, 6);
  line->addWidget(picture, 0, Qt::AlignTop);
  auto* column = new QVBoxLayout;
  column->addWidget(text);
  if (!message.actions.empty()) addActions(message.actions, row, *column);
  line->addLayout(column, 1);
  if (shortText != message.text) {
    QToolButton* details = makeButton(row, "details", tr("Details"));
    details->setCheckable(true);
    line->addWidget(details, 0, Qt::AlignTop);
    connect(details, &QToolButton::toggled, text,
            [this, text, shortText, whole = message.text](bool on) {
              text->setText(on ? whole : shortText);
              place();
            });
  }
  QToolButton* close = makeButton(row, "close", tr("Close"));
  close->setIcon(icon("cancel"));
  close->setIconSize({14, 14});
  line->addWidget(close, 0, Qt::AlignTop);
  connect(close, &QToolButton::clicked, this, [this, row] { remove(row); });
  return row;
}

/// A pixmap keeps the colours of the theme in which it was drawn.
void MessageBar::drawPicture(const QWidget& row) {
  row.findChild<QLabel*>("picture")->setPixmap(
      icon(row.property("error").toBool() ? "warning" : "help").pixmap(20, 20));
}

void MessageBar::addActions(const std::vector<Action>& actions, QWidget* row, QVBoxLayout& under) {
  auto* line = new QHBoxLayout;
  for (const Action& action : actions) {
    auto* button = new QPushButton(action.text, row);
    button->setObjectName("remedy");
    button->setToolTip(action.tip);
    line->addWidget(button);
    connect(button, &QPushButton::clicked, this, [this, row, perform = action.perform] {
      remove(row);
      perform();
    });
  }
  line->addStretch();
  under.addLayout(line);
}

void MessageBar::remove(QWidget* row) {
  if (row->isAncestorOf(focusWidget())) parentWidget()->setFocus();
  rows_->removeWidget(row);
  row->hide();
  row->deleteLater();
  showNext();
}

void MessageBar::place() {
  const int whole = parentWidget()->width(), free = whole - keptFree_ - 2 * kMargin;
  const int width = std::min(kMaxWidth, free < kMinBarWidth ? whole - 2 * kMargin : free);
  // In the middle if there is room, otherwise left of the strip that is kept free.
  const int left = std::max(kMargin, std::min((whole - width) / 2, kMargin + free - width));
  const int height =
      rows_->hasHeightForWidth() ? rows_->heightForWidth(width) : rows_->sizeHint().height();
  setGeometry(left, kMargin, width, std::min(height, parentWidget()->height() - 2 * kMargin));
}

bool MessageBar::eventFilter(QObject* watched, QEvent* event) {
  if (watched == parentWidget() && event->type() == QEvent::Resize) place();
  return QWidget::eventFilter(watched, event);
}

void MessageBar::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange)
    for (int i = 0; i < rows_->count(); ++i) drawPicture(*rows_->itemAt(i)->widget());
  QWidget::changeEvent(event);
}

bool MessageBar::event(QEvent* event) {
  // The layout is up to date. Invalidating it here would send the next LayoutRequest: an endless
  // loop.
  if (event->type() == QEvent::LayoutRequest) place();
  return QWidget::event(event);
}

}  // namespace palpa::gui
