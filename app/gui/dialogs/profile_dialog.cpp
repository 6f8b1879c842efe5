#include "app/gui/dialogs/profile_dialog.h"

#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QMessageBox>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "app/gui/dialogs/import_profile_dialog.h"
#include "app/gui/document/editor.h"
#include "modeling/exchange/profile_import.h"
#include "modeling/shapes/make_primitive.h"

namespace palpa::gui {
namespace {

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
