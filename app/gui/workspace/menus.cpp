#include "app/gui/workspace/menus.h"

#include <QMenuBar>

#include "app/gui/base/appearance.h"
#include "app/gui/base/translate.h"

namespace palpa::gui {
void setPossible(QAction* action, const QString& obstacle) {
  action->setEnabled(obstacle.isEmpty());
  action->setToolTip(obstacle.isEmpty() ? action->statusTip() : obstacle);
}

Menus::Menus(QMainWindow& window)
    : file(addMenu(window, tr("&File"))),
      edit(addMenu(window, tr("&Edit"))),
      select(addMenu(window, tr("Sele&ct"))),
      solid(addMenu(window, tr("&Solid"))),
      conditions(addMenu(window, tr("Su&pports && Loads"))),
      simulate(addMenu(window, tr("Si&mulate"))),
      view(addMenu(window, tr("&View"))),
      help(addMenu(window, tr("&Help"))),
      bar(new QToolBar(tr("Main"), &window)),
      tools(new QToolBar(tr("Tools"), &window)) {
  bar->setObjectName("main");
  tools->setObjectName("tools");
  for (QToolBar* each : {bar, tools}) {
    each->setMovable(false);
    each->setIconSize({22, 22});
  }
  window.addToolBar(Qt::TopToolBarArea, bar);
  window.addToolBar(Qt::LeftToolBarArea, tools);
}

QMenu* Menus::addMenu(QMainWindow& window, const QString& title) {
  QMenu* menu = window.menuBar()->addMenu(title);
  menu->setToolTipsVisible(true);
  all.push_back(menu);
  return menu;
}

QAction* Menus::make(QMenu* menu, const Item& item) {
  auto* action = new QAction(item.text, menu);
  if (item.icon) action->setIcon(icon(item.icon));
  QString name = item.text;
  name.remove('&').remove(QStringLiteral(" …"));
  action->setObjectName(name);
  action->setShortcut(item.keys);
  const QString tip = item.tip.isEmpty() ? name : item.tip;
  action->setToolTip(
      item.keys.isEmpty() ? tip : tip + " (" + item.keys.toString(QKeySequence::NativeText) + ")");
  action->setStatusTip(tip);
  menu->addAction(action);
  return action;
}

}  // namespace palpa::gui
