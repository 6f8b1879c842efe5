#include "app/gui/dialogs/welcome_dialog.h"

#include <QCommandLinkButton>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/gui/base/appearance.h"
#include "app/gui/document/examples.h"

namespace palpa::gui {
namespace {

QCommandLinkButton* makeLink(const QString& name, const QString& text, const QString& what,
                             const QString& picture, QWidget* parent) {
  auto* link = new QCommandLinkButton(text, what, parent);
  link->setObjectName(name);
  link->setIcon(icon(picture));
  link->setIconSize({20, 20});
  return link;
}

}  // namespace

WelcomeDialog::WelcomeDialog(QWidget* parent) : QDialog(parent) {
  setObjectName("welcome");
  setWindowTitle(tr("Welcome to Palpa"));
  auto* title = new QLabel(tr("Model a solid and touch it"), this);
  QFont font = title->font();
  font.setPointSizeF(1.5 * font.pointSizeF());
  font.setBold(true);
  title->setFont(font);
  auto* how = new QLabel(
      tr("1.  Drag control points to shape the solid.\n"
         "2.  The middle button, or Alt with the left button, orbits the view; the right button "
         "pans; the wheel zooms.\n"
         "3.  Place supports and loads (menu Supports & Loads).\n"
         "4.  Press Simulate (F5) and drag the surface: arrows and the Forces panel show the "
         "forces."),
      this);
  how->setWordWrap(true);

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
  auto* close = new QPushButton(tr("&Close"), this);
  close->setObjectName("close");
  connect(close, &QPushButton::clicked, this, &QDialog::reject);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(20, 18, 20, 14);
  column->setSpacing(12);
  column->addWidget(title);
  column->addWidget(how);
  column->addLayout(grid);
  column->addWidget(close, 0, Qt::AlignRight);
  resize(820, 460);
  fresh->setFocus(Qt::TabFocusReason);  // this reason draws the focus frame
}

void WelcomeDialog::choose(Choice choice, const QString& example) {
  choice_ = choice;
  example_ = example;
  accept();
}

}  // namespace palpa::gui
