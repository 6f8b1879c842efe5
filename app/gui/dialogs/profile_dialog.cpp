#include "app/gui/dialogs/profile_dialog.h"

#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QMenu>
#include <QMessageBox>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>

#include "app/gui/base/appearance.h"
#include "app/gui/dialogs/import_profile_dialog.h"
#include "app/gui/document/editor.h"
#include "app/gui/widgets/form_row.h"
#include "modeling/exchange/profile_import.h"
#include "modeling/shapes/make_primitive.h"
#include "modeling/shapes/shape_parameters.h"

namespace palpa::gui {
namespace {

using Eigen::Vector2d;
using modeling::ProfileSketch;
using modeling::SketchPointKind;
using modeling::SketchUse;

}  // namespace

ProfileDialog::ProfileDialog(Settings& settings, const modeling::Primitive& primitive,
                             QWidget* parent)
    : QDialog(parent),
      settings_(settings),
      primitive_(primitive),
      editor_(primitive, this),
      tools_(new QToolBar(this)),
      canvas_(new ProfileCanvas(editor_, settings, this)),
      preview_(new ShapePreview(
          tr("This curve gives no solid.\nThe picture shows the last that did."), this)),
      selected_(new QLabel(this)),
      corner_(new QCheckBox(tr("&Corner"), this)),
      pointer_(new QLabel(this)),
      problem_(new QLabel(this)) {
  setObjectName("profile");
  setWindowTitle(editor_.use() == SketchUse::kLoft ? tr("Edit sections") : tr("Edit profile"));
  preview_->setMinimumSize(280, 200);
  preview_->hideNet();
  problem_->setObjectName("problem");
  problem_->setWordWrap(true);
  addTools();
  auto* side = new QVBoxLayout;
  if (editor_.use() == SketchUse::kLoft) side->addWidget(makeSections());
  side->addWidget(makeNumbers());
  side->addWidget(preview_, 1);
  auto* row = new QHBoxLayout;
  row->addWidget(canvas_, 1);
  row->addLayout(side);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  ok_ = buttons->button(QDialogButtonBox::Ok);
  ok_->setText(tr("&Use profile"));
  ok_->setToolTip(tr("Ctrl+Enter"));
  for (QAbstractButton* button : buttons->buttons())
    if (auto* push = qobject_cast<QPushButton*>(button)) push->setAutoDefault(false);
  connect(buttons, &QDialogButtonBox::accepted, this, &ProfileDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &ProfileDialog::reject);
  auto* below = new QHBoxLayout;
  pointer_->setObjectName("pointer");
  pointer_->setMinimumWidth(150);
  below->addWidget(pointer_);
  below->addWidget(problem_, 1);
  below->addWidget(buttons);
  auto* column = new QVBoxLayout(this);
  column->addWidget(tools_);
  column->addLayout(row, 1);
  column->addLayout(below);
  connect(&editor_, &SketchEditor::changed, this, &ProfileDialog::refresh);
  connect(&editor_, &SketchEditor::selectionChanged, this, &ProfileDialog::refreshNumbers);
  connect(canvas_, &ProfileCanvas::modeChanged, this, &ProfileDialog::refresh);
  connect(canvas_, &ProfileCanvas::pointed, this,
          [this] { pointer_->setText(canvas_->pointerText()); });
  connect(preview_, &ShapePreview::answered, this, &ProfileDialog::showProblem);
  resize(1120, 700);
  canvas_->setFocus();
  refresh();
}

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

QWidget* ProfileDialog::makeSections() {
  auto* box = new QWidget(this);
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(0, 0, 0, 0);
  sections_ = new QTableWidget(0, 2, box);
  sections_->setObjectName("sections");
  sections_->setAccessibleName(tr("Sections"));
  sections_->setHorizontalHeaderLabels({tr("Section"), tr("Height")});
  sections_->verticalHeader()->hide();
  sections_->horizontalHeader()->setStretchLastSection(true);
  sections_->setSelectionBehavior(QAbstractItemView::SelectRows);
  sections_->setSelectionMode(QAbstractItemView::SingleSelection);
  sections_->setTabKeyNavigation(false);
  sections_->setMinimumHeight(120);
  sections_->setMaximumHeight(170);
  layout->addWidget(sections_);
  auto* row = new QHBoxLayout;
  auto* add = new QPushButton(tr("&Add section"), box);
  removeSection_ = new QPushButton(tr("&Remove section"), box);
  add->setObjectName("addSection");
  removeSection_->setObjectName("removeSection");
  for (QPushButton* button : {add, removeSection_}) {
    button->setAutoDefault(false);
    row->addWidget(button);
  }
  layout->addLayout(row);
  connect(add, &QPushButton::clicked, this, [this] { editor_.addSection(); });
  connect(removeSection_, &QPushButton::clicked, this, [this] { editor_.removeSection(); });
  connect(sections_, &QTableWidget::currentCellChanged, this, [this](int section) {
    if (!isRefreshing_ && section >= 0) editor_.setSection(section);
  });
  connect(sections_, &QTableWidget::itemChanged, this, [this](QTableWidgetItem* item) {
    if (isRefreshing_ || item->column() != 1) return;
    const auto height = parsed(item->text(), Quantity::kLength, settings_.units());
    if (height && std::abs(*height) <= modeling::kMaxLength)
      editor_.setHeight(item->row(), *height);
    else
      refreshSections();
  });
  return box;
}

QWidget* ProfileDialog::makeNumbers() {
  const bool isRevolve = editor_.use() == SketchUse::kRevolve;
  auto* box = new QWidget(this);
  auto* form = new QFormLayout(box);
  form->setContentsMargins(0, 0, 0, 0);
  selected_->setObjectName("selected");
  form->addRow(selected_);
  const std::array<QString, 2> names{isRevolve ? tr("r:") : tr("x:"),
                                     isRevolve ? tr("z:") : tr("y:")};
  for (int axis : {0, 1}) {
    coordinates_[axis] = new QuantityEdit(Quantity::kLength, settings_, box);
    coordinates_[axis]->setRange(-modeling::kMaxLength, modeling::kMaxLength);
    addFormRow(form, names[axis], coordinates_[axis], axis == 0 ? "x" : "y",
               tr("Coordinate of the selected points"));
    connect(coordinates_[axis], &QuantityEdit::edited, this,
            [this, axis](double value) { setCoordinate(axis, value); });
  }
  corner_->setObjectName("corner");
  corner_->setToolTip(
      tr("The curve passes through a corner and may bend there (C); a smooth point "
         "attracts it. A double click on a point changes it."));
  form->addRow(QString(), corner_);
  connect(corner_, &QCheckBox::clicked, this, [this] { editor_.toggleCorners(); });
  auto* toggle = new QAction(this);
  toggle->setShortcut(Qt::Key_C);
  connect(toggle, &QAction::triggered, this, [this] { editor_.toggleCorners(); });
  addAction(toggle);
  const std::array<QString, 2> sizes{isRevolve ? tr("Outer radius:") : tr("Curve width:"),
                                     isRevolve ? tr("Height:") : tr("Curve depth:")};
  for (int axis : {0, 1}) {
    extents_[axis] = new QuantityEdit(Quantity::kLength, settings_, box);
    extents_[axis]->setRange(modeling::kMinLength, modeling::kMaxLength);
    extents_[axis]->setNarrow();
    addFormRow(form, sizes[axis], extents_[axis], axis == 0 ? "width" : "depth",
               tr("Size of the whole curve; a new one stretches it"));
    connect(extents_[axis], &QuantityEdit::edited, this,
            [this, axis](double value) { editor_.setExtent(axis, value); });
  }
  box->setMaximumWidth(340);
  return box;
}

void ProfileDialog::setCoordinate(int axis, double value) {
  editor_.edit(tr("Move points"), [&](ProfileSketch& sketch) {
    for (int point : editor_.selection()) {
      Vector2d by = Vector2d::Zero();
      by[axis] = value - sketch.points()[point].at[axis];
      sketch.move({point}, by);
    }
  });
}

void ProfileDialog::refresh() {
  refreshSections();
  refreshNumbers();
  try {
    if (editor_.problem()) {
      preview_->forget();
      const auto& problem = *editor_.problem();
      const bool isElsewhere =
          editor_.use() == SketchUse::kLoft && problem.section != editor_.sectionIndex();
      // An open end is no error yet while the curve is drawn.
      const bool isDrawn =
          canvas_->mode() == ProfileCanvas::Mode::kDraw && !editor_.sketch().isClosed();
      const QString text = isElsewhere
                               ? tr("Section %1: %2").arg(problem.section + 1).arg(problem.text)
                               : problem.text;
      problem_->setText(isDrawn ? QString() : text);
      ok_->setEnabled(false);
      preview_->setStale(true);
      return;
    }
    problem_->clear();
    ok_->setEnabled(true);
    preview_->ask(editor_.primitive());
  } catch (const std::exception& error) {
    showProblem(QString::fromStdString(error.what()));
  }
}

void ProfileDialog::showProblem(const QString& problem) {
  if (problem.isEmpty()) {
    problem_->clear();
    ok_->setEnabled(true);
    preview_->setStale(false);
    return;
  }
  problem_->setText(sketchSentence(problem));
  ok_->setEnabled(false);
  preview_->setStale(true);
}

void ProfileDialog::refreshSections() {
  if (!sections_) return;
  isRefreshing_ = true;
  const auto& sections = editor_.sections();
  sections_->setRowCount(static_cast<int>(sections.size()));
  for (int i = 0; i < sections_->rowCount(); ++i) {
    const QString name = tr("Section %1").arg(i + 1);
    const QString height =
        shown(sections[static_cast<std::size_t>(i)].z, Quantity::kLength, settings_.units(), 8);
    for (int column : {0, 1}) {
      QTableWidgetItem* item = sections_->item(i, column);
      if (!item) {
        item = new QTableWidgetItem;
        if (column == 0) item->setFlags(item->flags() & ~Qt::ItemIsEditable);
        sections_->setItem(i, column, item);
      }
      item->setText(column == 0 ? name : height);
    }
  }
  if (sections_->currentRow() != editor_.sectionIndex())
    sections_->setCurrentCell(editor_.sectionIndex(), std::max(0, sections_->currentColumn()));
  removeSection_->setEnabled(sections.size() > 2);
  isRefreshing_ = false;
}

void ProfileDialog::refreshNumbers() {
  const ProfileSketch& sketch = editor_.sketch();
  const std::vector<int>& selection = editor_.selection();
  const auto count = static_cast<int>(selection.size());
  selected_->setText(count == 0 ? tr("No point is selected")
                     : count == 1
                         ? tr("Point %1 of %2").arg(selection[0] + 1).arg(sketch.pointCount())
                         : tr("%1 of %2 points").arg(count).arg(sketch.pointCount()));
  for (int axis : {0, 1}) {
    coordinates_[axis]->setEnabled(count > 0);
    if (count > 0) coordinates_[axis]->setValue(sketch.points()[selection[0]].at[axis]);
  }
  corner_->setEnabled(count > 0);
  const QSignalBlocker block(corner_);
  corner_->setChecked(count > 0 && sketch.points()[selection[0]].kind == SketchPointKind::kCorner);
  const auto [low, high] = sketch.box();
  const bool isRevolve = editor_.use() == SketchUse::kRevolve;
  extents_[0]->setValue(isRevolve ? high.x() : high.x() - low.x());
  extents_[1]->setValue(high.y() - low.y());
  for (QuantityEdit* extent : extents_) extent->setEnabled(sketch.isCurve());
  const bool isDrawing = canvas_->mode() == ProfileCanvas::Mode::kDraw;
  draw_->setChecked(isDrawing);
  delete_->setEnabled(count > 0);
  insert_->setEnabled(count > 0 && sketch.isCurve());
  close_->setText(sketch.isClosed() ? tr("Open") : tr("Close"));
  close_->setToolTip(sketch.isClosed() ? tr("Open the curve at its first point")
                                       : tr("Join the last point to the first"));
  close_->setEnabled(sketch.pointCount() >= 3);
  undo_->setEnabled(editor_.canUndo());
  redo_->setEnabled(editor_.canRedo());
  undo_->setToolTip(tr("Undo: %1").arg(editor_.undoName()));
  redo_->setToolTip(tr("Redo: %1").arg(editor_.redoName()));
}

void ProfileDialog::import() {
  std::vector<modeling::SketchSection> all;
  try {
    auto sections = importSections(settings_, editor_.use(), *this);
    if (!sections) return;
    all = std::move(*sections);
  } catch (const std::exception& error) {
    problem_->setText(QString::fromStdString(error.what()));
    return;
  }
  // A loft gets the curve as its present section.
  if (editor_.use() == SketchUse::kLoft && all.size() == 1) {
    const auto section = static_cast<std::size_t>(editor_.sectionIndex());
    modeling::ProfileSketch curve = std::move(all.front().profile);
    all = editor_.sections();
    all[section].profile = std::move(curve);
  }
  editor_.replace(tr("Import"), std::move(all));
  canvas_->fit();
  preview_->lookAgain();
}

void ProfileDialog::exportSvg() {
  if (!editor_.sketch().isCurve()) return;
  QFileDialog dialog(this, tr("Export"), settings_.lastFolder(), tr("Drawings (*.svg)"));
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setDefaultSuffix("svg");
  if (dialog.exec() != QDialog::Accepted) return;
  const QString file = dialog.selectedFiles().value(0);
  settings_.setLastFolder(QFileInfo(file).absolutePath());
  try {
    modeling::writeProfileSvg(editor_.sketch().curve(), file.toStdString());
  } catch (const std::exception& error) {
    problem_->setText(QString::fromStdString(error.what()));
  }
}

void ProfileDialog::accept() {
  try {
    // The picture may be older than the last edit.
    const modeling::Primitive made = editor_.primitive();
    modeling::makePrimitive(made);
    primitive_ = made;
    QDialog::accept();
  } catch (const std::exception& error) {
    showProblem(QString::fromStdString(error.what()));
  }
}

void ProfileDialog::reject() {
  if (editor_.isModified()) {
    const auto answer =
        QMessageBox::question(this, windowTitle(), tr("Discard the changes to the profile?"),
                              QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Cancel);
    if (answer != QMessageBox::Discard) return;
  }
  QDialog::reject();
}

void ProfileDialog::keyPressEvent(QKeyEvent* event) {
  const bool isEnter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
  if (isEnter && (event->modifiers() & Qt::ControlModifier) != 0) {
    if (ok_->isEnabled()) accept();
  } else if (isEnter) {
    if (auto* button = qobject_cast<QPushButton*>(focusWidget())) button->click();
  } else {
    QDialog::keyPressEvent(event);
  }
}

void editProfileOfProject(const Workspace& workspace) {
  const auto& present = workspace.editor.project().primitive;
  if (!present || !modeling::hasProfile(*present)) return;
  ProfileDialog dialog(workspace.settings, *present, &workspace.window);
  if (dialog.exec() == QDialog::Accepted &&
      dialog.primitive() != workspace.editor.project().primitive)
    workspace.editor.perform(modeling::MakePrimitive{dialog.primitive()});
}

}  // namespace palpa::gui
