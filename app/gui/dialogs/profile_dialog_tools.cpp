#include <QMenu>
#include <QToolButton>

#include "app/gui/base/appearance.h"
#include "app/gui/dialogs/profile_dialog.h"

// The tool bar of ProfileDialog.

namespace palpa::gui {

using modeling::ProfileSketch;
using modeling::SketchUse;

QAction* ProfileDialog::addTool(const QString& picture, const QString& text,
                                const QKeySequence& keys, const QString& tip,
                                const std::function<void()>& work) {
  auto* action = new QAction(text, this);
  if (!picture.isEmpty()) action->setIcon(icon(picture));
  action->setShortcut(keys);
  const QString key =
      keys.isEmpty() ? QString() : " (" + keys.toString(QKeySequence::NativeText) + ")";
  action->setToolTip((tip.isEmpty() ? text : tip) + key);
  connect(action, &QAction::triggered, this, work);
  tools_->addAction(action);
  return action;
}

void ProfileDialog::showIconOnly(QAction* action) {
  if (auto* button = qobject_cast<QToolButton*>(tools_->widgetForAction(action)))
    button->setToolButtonStyle(Qt::ToolButtonIconOnly);
}

void ProfileDialog::addTools() {
  tools_->setIconSize({18, 18});
  tools_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  draw_ = addTool("add", tr("Draw"), Qt::Key_D,
                  tr("Click points of a new curve, or continue an open one; click the first point "
                     "to close it, Enter ends"),
                  [this] {
                    canvas_->setMode(draw_->isChecked() ? ProfileCanvas::Mode::kDraw
                                                        : ProfileCanvas::Mode::kSelect);
                    canvas_->setFocus();
                  });
  draw_->setCheckable(true);
  drawsCorners_ = addTool({}, tr("Corners"), Qt::Key_K,
                          tr("New points are corners joined by straight lines; Shift reverses it"),
                          [this] { canvas_->setDrawsCorners(drawsCorners_->isChecked()); });
  drawsCorners_->setCheckable(true);
  insert_ =
      addTool("insert-knot", tr("Insert"), Qt::Key_Insert,
              tr("Insert a point after each selected one; a double click on the curve inserts "
                 "one there"),
              [this] { editor_.insertAfterSelected(); });
  delete_ = addTool("delete", tr("Delete"), {}, tr("Delete the selected points (Del)"),
                    [this] { editor_.removeSelected(); });
  close_ = addTool({}, tr("Close"), {}, {}, [this] {
    const bool opens = editor_.sketch().isClosed();
    editor_.edit(opens ? tr("Open") : tr("Close"), [opens](ProfileSketch& sketch) {
      if (opens)
        sketch.open();
      else
        sketch.close();
    });
  });
  auto* mirror = new QMenu(this);
  mirror->addAction(tr("Flip &left to right"), this, [this] { editor_.flip(0); })
      ->setEnabled(editor_.use() != SketchUse::kRevolve);
  mirror->addAction(tr("Flip &upside down"), this, [this] { editor_.flip(1); });
  mirror->addSeparator();
  for (int axis : {0, 1}) {
    if (axis == 0 && editor_.use() == SketchUse::kRevolve) continue;
    const QString line = axis == 0                              ? "x = 0"
                         : editor_.use() == SketchUse::kRevolve ? "z = 0"
                                                                : "y = 0";
    mirror->addAction(tr("Complete by the mirror image across %1").arg(line), this, [this, axis] {
      if (!editor_.addMirrorImage(axis))
        showProblem(
            tr("The mirror image needs an open curve with an end on the "
               "line; move one end there"));
    });
  }
  QAction* flips = addTool("mirror", tr("Mirror"), {}, {}, [] {});
  flips->setMenu(mirror);
  if (auto* button = qobject_cast<QToolButton*>(tools_->widgetForAction(flips)))
    button->setPopupMode(QToolButton::InstantPopup);
  tools_->addSeparator();
  undo_ = addTool("undo", tr("Undo"), QKeySequence::Undo, {}, [this] { editor_.undo(); });
  redo_ = addTool("redo", tr("Redo"), QKeySequence::Redo, {}, [this] { editor_.redo(); });
  QAction* fit =
      addTool("fit", tr("Fit"), Qt::Key_F, tr("Show the whole curve"), [this] { canvas_->fit(); });
  for (QAction* action : {undo_, redo_, fit}) showIconOnly(action);
  addSnapping();
  tools_->addSeparator();
  addTool("import", tr("Import …"), {}, tr("Take the curve of an SVG, DXF or profile file"),
          [this] { import(); });
  addTool("export", tr("Export …"), {}, tr("Write the curve to an SVG file"),
          [this] { exportSvg(); });
  auto* all = new QAction(this);
  all->setShortcut(QKeySequence::SelectAll);
  connect(all, &QAction::triggered, this, [this] { editor_.selectAll(); });
  addAction(all);
  for (QAction* action : tools_->actions())
    if (auto* button = tools_->widgetForAction(action)) {
      button->setFocusPolicy(Qt::TabFocus);
      button->setObjectName(action->text());
    }
}

void ProfileDialog::addSnapping() {
  auto* grid = addTool("grid", tr("Snap to grid"), Qt::Key_G,
                       tr("Snap to the grid; Alt while dragging: not"), [] {});
  auto* points =
      addTool("point", tr("Snap to points"), Qt::Key_O,
              tr("Snap to the axes and to other points; Alt while dragging: not"), [] {});
  for (QAction* action : {grid, points}) {
    action->setCheckable(true);
    action->setChecked(true);
    showIconOnly(action);
    connect(action, &QAction::toggled, this,
            [this, grid, points] { canvas_->setSnap(grid->isChecked(), points->isChecked()); });
  }
}

}  // namespace palpa::gui
