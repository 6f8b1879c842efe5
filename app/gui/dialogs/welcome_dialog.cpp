#include "app/gui/dialogs/welcome_dialog.h"

#include <QCheckBox>
#include <QCommandLinkButton>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QScreen>
#include <QScrollArea>
#include <QVBoxLayout>

#include "app/gui/base/appearance.h"
#include "app/gui/dialogs/recent_list.h"
#include "app/gui/document/examples.h"

namespace palpa::gui {
namespace {

constexpr int kDialogWidth = 860;  // px
constexpr int kAround = 130;       // px: title, last line and margins
constexpr int kFrame = 36;         // px: title bar of the window, approximately

QCommandLinkButton* makeLink(const QString& name, const QString& text, const QString& what,
                             const QString& picture, QWidget* parent) {
  auto* link = new QCommandLinkButton(text, what, parent);
  link->setObjectName(name);
  link->setIcon(icon(picture));
  link->setIconSize({20, 20});
  return link;
}

}  // namespace

WelcomeDialog::WelcomeDialog(Settings& settings, QWidget* parent) : QDialog(parent) {
  setObjectName("welcome");
  setWindowTitle(tr("Welcome to Palpa"));
  auto* title = new QLabel(tr("Model a solid and touch it"), this);
  QFont font = title->font();
  font.setPointSizeF(1.5 * font.pointSizeF());
  font.setBold(true);
  title->setFont(font);
  auto* content = new QWidget(this);
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(12);
  RecentList* recent = nullptr;
  if (!settings.recentFiles().isEmpty()) {
    recent = new RecentList(settings, content);
    connect(recent, &RecentList::fileChosen, this,
            [this](const QString& file) { choose(Choice::kRecent, file); });
    column->addWidget(new QLabel(tr("Recent files"), content));
    column->addWidget(recent);
  } else {
    auto* how = new QLabel(
        tr("1.  Drag control points to shape the solid.\n"
           "2.  The middle button, or Alt with the left button, orbits the view; the right button "
           "pans; the wheel zooms.\n"
           "3.  Place supports and loads (menu Supports & Loads).\n"
           "4.  Press Simulate (F5) and drag the surface: arrows and the Forces panel show the "
           "forces."),
        content);
    how->setWordWrap(true);
    column->addWidget(how);
  }
  column->addLayout(makeGrid());
  column->addStretch(1);
  // Small screens scroll.
  auto* scroll = new QScrollArea(this);
  scroll->setWidget(content);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  auto* again = new QCheckBox(tr("Show when the program starts"), this);
  again->setObjectName("showAtStart");
  again->setChecked(settings.welcomesAtStart());
  connect(again, &QCheckBox::toggled, &settings, &Settings::setWelcomesAtStart);
  auto* close = new QPushButton(tr("&Close"), this);
  close->setObjectName("close");
  connect(close, &QPushButton::clicked, this, &QDialog::reject);
  auto* last = new QHBoxLayout;
  last->addWidget(again);
  last->addStretch(1);
  last->addWidget(close);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(20, 18, 20, 14);
  all->setSpacing(12);
  all->addWidget(title);
  all->addWidget(scroll, 1);
  all->addLayout(last);
  const QSize wanted(kDialogWidth, content->sizeHint().height() + kAround);
  resize(wanted.boundedTo(parent->screen()->availableSize() - QSize(0, kFrame)));
  // This reason draws the focus frame.
  if (recent)
    recent->setFocus(Qt::TabFocusReason);
  else
    findChild<QWidget*>("new")->setFocus(Qt::TabFocusReason);
}

QLayout* WelcomeDialog::makeGrid() {
  auto* grid = new QGridLayout;
  grid->addWidget(new QLabel(tr("Begin with"), this), 0, 0);
  grid->addWidget(new QLabel(tr("Examples"), this), 0, 1, 1, 2);
  auto* fresh = makeLink("new", tr("&New solid …"), tr("From a shape"), "new", this);
  auto* open = makeLink("open", tr("&Open …"), tr("Project, CAD file or mesh"), "open", this);
  connect(fresh, &QAbstractButton::clicked, this, [this] { choose(Choice::kNewSolid); });
  connect(open, &QAbstractButton::clicked, this, [this] { choose(Choice::kOpen); });
  grid->addWidget(fresh, 1, 0);
  grid->addWidget(open, 2, 0);
  int place = 0;
  for (const Example& example : examples()) {
    auto* link = makeLink(example.name, example.title, example.description, "solid", this);
    connect(link, &QAbstractButton::clicked, this,
            [this, name = example.name] { choose(Choice::kExample, name); });
    grid->addWidget(link, 1 + place / 2, 1 + place % 2);
    ++place;
  }
  return grid;
}

void WelcomeDialog::choose(Choice choice, const QString& chosen) {
  choice_ = choice;
  chosen_ = chosen;
  accept();
}

}  // namespace palpa::gui
