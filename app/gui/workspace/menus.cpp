#include "app/gui/workspace/menus.h"

#include <QMenuBar>

#include "app/gui/base/appearance.h"

namespace palpa::gui {
namespace {

QString tr(const char* text) {
  return QObject::tr(text);
}

}  // namespace

Menus::Menus(QMainWindow& window)
    : file(window.menuBar()->addMenu(tr("&File"))),
      edit(window.menuBar()->addMenu(tr("&Edit"))),
      select(window.menuBar()->addMenu(tr("Sele&ct"))),
      solid(window.menuBar()->addMenu(tr("&Solid"))),
      conditions(window.menuBar()->addMenu(tr("Su&pports && Loads"))),
      simulate(window.menuBar()->addMenu(tr("Si&mulate"))),
      view(window.menuBar()->addMenu(tr("&View"))),
      help(window.menuBar()->addMenu(tr("&Help"))),
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
  for (QMenu* menu : {file, edit, select, solid, conditions, simulate, view, help})
    menu->setToolTipsVisible(true);
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
