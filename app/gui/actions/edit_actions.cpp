#include "app/gui/actions/edit_actions.h"

#include "app/gui/document/editor.h"
#include "app/gui/workspace/menus.h"

namespace palpa::gui {

EditActions::EditActions(const Workspace& workspace)
    : QObject(&workspace.window), workspace_(workspace) {
  Menus& menus = workspace_.menus;
  Editor& editor = workspace_.editor;
  undo_ = menus.add(menus.edit, {"undo", tr("&Undo"), QKeySequence::Undo}, &editor, &Editor::undo);
  redo_ = menus.add(menus.edit, {"redo", tr("&Redo"), QKeySequence::Redo}, &editor, &Editor::redo);
  menus.bar->addAction(undo_);
  menus.bar->addAction(redo_);
  menus.bar->addSeparator();
  // The first items of the bar stay visible in a narrow window.
  menus.views = menus.bar->addSeparator();
  menus.edit->addSeparator();
  connect(&editor, &Editor::fileChanged, this, &EditActions::update);
  update();
}

void EditActions::update() {
  const modeling::Document& document = workspace_.editor.session().document();
  const auto show = [](QAction* action, const QString& verb, bool can, const std::string& label) {
    action->setEnabled(can);
    const QString name = QString::fromStdString(label);
    action->setText(can ? verb + " " + QString(name).replace('&', "&&") : verb);
    const QString tip = can ? QString(verb).remove('&') + ": " + name : QString(verb).remove('&');
    action->setToolTip(tip + " (" + action->shortcut().toString(QKeySequence::NativeText) + ")");
  };
  show(undo_, tr("&Undo"), document.canUndo(), document.undoLabel());
  show(redo_, tr("&Redo"), document.canRedo(), document.redoLabel());
}

}  // namespace palpa::gui
