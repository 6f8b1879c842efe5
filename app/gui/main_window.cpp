#include "app/gui/main_window.h"

#include <QActionGroup>
#include <QApplication>
#include <QCloseEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QStatusBar>
#include <QToolBar>

#include "app/core/new_project.h"
#include "app/gui/appearance.h"
#include "app/gui/rebuild_dock.h"
#include "modeling/shapes/make_primitive.h"

namespace palpa::gui {
namespace {

using view::StandardView;

}  // namespace

MainWindow::MainWindow()
    : viewport_(new ViewportWidget(this)),
      scene_(editor_, *viewport_),
      selectTool_(editor_, scene_, *viewport_) {
  setCentralWidget(viewport_);
  setAcceptDrops(true);
  viewport_->setTool(&selectTool_);
  viewport_->viewport().setTheme(viewportTheme(currentTheme()));
  addDockWidget(Qt::RightDockWidgetArea, new RebuildDock(editor_, this));

  auto* bar = addToolBar(tr("Main"));
  bar->setObjectName("main");
  bar->setMovable(false);
  bar->setIconSize({22, 22});
  makeFileMenu();
  makeEditMenu();
  makeViewMenu();
  makeHelpMenu();

  hint_ = new QLabel(selectTool_.hint(), this);
  rebuild_ = new QLabel(this);
  frame_ = new QLabel(this);
  statusBar()->addWidget(hint_, 1);
  statusBar()->addPermanentWidget(rebuild_);
  statusBar()->addPermanentWidget(frame_);
  connect(&editor_, &Editor::fileChanged, this, &MainWindow::updateTitle);
  connect(&editor_, &Editor::projectReplaced, this, &MainWindow::updateActions);
  connect(&editor_, &Editor::projectChanged, this, &MainWindow::updateActions);
  connect(&editor_, &Editor::rebuildChanged, this, &MainWindow::updateStatus);
  connect(&editor_, &Editor::refused, this,
          [this](const QString& message) { statusBar()->showMessage(message, 15000); });
  connect(viewport_, &ViewportWidget::framePainted, this, [this] {
    frame_->setText(tr("%1 ms/frame").arg(viewport_->lastFrameMilliseconds(), 0, 'f', 0));
  });
  resize(1280, 800);
  updateTitle();
  updateActions();
  updateStatus();
}

void MainWindow::makeFileMenu() {
  QMenu* menu = menuBar()->addMenu(tr("&File"));
  QMenu* fresh = menu->addMenu(icon("new"), tr("&New"));
  const std::vector<std::pair<QString, modeling::Primitive>> shapes{
      {tr("Box"), {modeling::BoxShape{}}},
      {tr("Sphere"), {modeling::SphereShape{}}},
      {tr("Ellipsoid"), {modeling::EllipsoidShape{}}},
      {tr("Cylinder"), {modeling::CylinderShape{}}},
      {tr("Cone"), {modeling::ConeShape{}}},
      {tr("Capsule"), {modeling::CapsuleShape{}}},
      {tr("Torus"), {modeling::TorusShape{}}}};
  for (const auto& [name, primitive] : shapes)
    fresh->addAction(name, this, [this, name = name, primitive = primitive] {
      if (!mayDiscard()) return;
      modeling::Project project =
          app::makeProject(modeling::makePrimitive(primitive), name.toStdString());
      project.primitive = primitive;
      project.material = editor_.project().material;
      editor_.start(std::move(project));
    });
  auto* bar = findChild<QToolBar*>("main");
  const auto add = [&](const char* picture, const QString& text, QKeySequence keys,
                       const auto& what) {
    QAction* action = menu->addAction(icon(picture), text, this, what);
    action->setShortcut(keys);
    action->setToolTip(text.split('&').join("") + " (" + keys.toString() + ")");
    bar->addAction(action);
    return action;
  };
  add("open", tr("&Open …"), QKeySequence::Open, [this] {
    if (!mayDiscard()) return;
    const QString file = QFileDialog::getOpenFileName(
        this, tr("Open"), QString(),
        tr("Projects (*.json);;CAD and meshes (*.step *.stp *.iges *.igs *.brep *.stl *.obj "
           "*.ply);;All files (*)"));
    if (!file.isEmpty()) openFile(file);
  });
  add("save", tr("&Save"), QKeySequence::Save, [this] { save(); });
  add("save-as", tr("Save &as …"), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_S),
      [this] { saveAs(); });
  menu->addSeparator();
  menu->addAction(tr("&Quit"), QKeySequence::Quit, this, &QWidget::close);
  bar->addSeparator();
}

void MainWindow::makeEditMenu() {
  QMenu* menu = menuBar()->addMenu(tr("&Edit"));
  undo_ = menu->addAction(icon("undo"), tr("&Undo"), QKeySequence::Undo, &editor_, &Editor::undo);
  redo_ = menu->addAction(icon("redo"), tr("&Redo"), QKeySequence::Redo, &editor_, &Editor::redo);
  menu->addSeparator();
  menu->addAction(tr("Select &all points"), QKeySequence::SelectAll, this, [this] {
    if (!editor_.solid()) return;
    std::set<int> all;
    for (std::size_t i = 0; i < editor_.solid()->controlPoints().size(); ++i)
      all.insert(static_cast<int>(i));
    editor_.select(std::move(all));
  });
  auto* bar = findChild<QToolBar*>("main");
  bar->addAction(undo_);
  bar->addAction(redo_);
  bar->addSeparator();
}

void MainWindow::makeViewMenu() {
  QMenu* menu = menuBar()->addMenu(tr("&View"));
  auto* bar = findChild<QToolBar*>("main");
  const auto look = [&](const char* picture, const QString& text, QKeySequence keys,
                        StandardView from) {
    QAction* action = menu->addAction(icon(picture), text, keys, this, [this, from] {
      viewport_->viewport().lookFrom(from);
      viewport_->viewport().fit();
      viewport_->update();
    });
    bar->addAction(action);
  };
  QAction* fit = menu->addAction(icon("fit"), tr("&Fit"), QKeySequence(Qt::Key_F), this, [this] {
    viewport_->viewport().fit();
    viewport_->update();
  });
  bar->addAction(fit);
  look("view-isometric", tr("&Isometric"), QKeySequence(Qt::Key_0), StandardView::kIsometric);
  look("view-front", tr("F&ront"), QKeySequence(Qt::Key_1), StandardView::kFront);
  look("view-right", tr("R&ight"), QKeySequence(Qt::Key_3), StandardView::kRight);
  look("view-top", tr("&Top"), QKeySequence(Qt::Key_7), StandardView::kTop);
  menu->addSeparator();
  const auto toggle = [&](const char* picture, const QString& text, QKeySequence keys, bool isOn,
                          const auto& what) {
    QAction* action = menu->addAction(icon(picture), text);
    action->setShortcut(keys);
    action->setCheckable(true);
    action->setChecked(isOn);
    connect(action, &QAction::toggled, this, [this, what](bool on) {
      what(on);
      viewport_->update();
    });
    bar->addAction(action);
  };
  toggle("perspective", tr("&Parallel projection"), QKeySequence(Qt::Key_5), false,
         [this](bool on) { viewport_->viewport().setParallelProjection(on); });
  toggle("net", tr("&Control net"), QKeySequence(Qt::Key_N), true,
         [this](bool on) { viewport_->viewport().setControlNetVisible(on); });
  toggle("grid", tr("&Grid"), QKeySequence(Qt::Key_G), true,
         [this](bool on) { viewport_->viewport().setGridVisible(on); });
  toggle("shaded", tr("&Dark theme"), QKeySequence(), currentTheme() == Theme::kDark,
         [this](bool on) { setDark(on); });
}

void MainWindow::makeHelpMenu() {
  QMenu* menu = menuBar()->addMenu(tr("&Help"));
  menu->addAction(tr("&About Palpa"), this, [this] {
    QMessageBox::about(this, tr("About Palpa"),
                       tr("<b>Palpa</b> %1<p>Model a solid and touch it: boundary elements give "
                          "the exact displacement and force.<p>GPL-3.0-or-later")
                           .arg(QApplication::applicationVersion()));
  });
}

void MainWindow::setDark(bool dark) {
  const Theme theme = dark ? Theme::kDark : Theme::kLight;
  applyTheme(*qApp, theme);
  viewport_->viewport().setTheme(viewportTheme(theme));
}

bool MainWindow::openFile(const QString& file) {
  return file.endsWith(".json", Qt::CaseInsensitive) ? editor_.open(file)
                                                     : editor_.importFile(file);
}

bool MainWindow::save() {
  return editor_.fileName().isEmpty() ? saveAs() : editor_.save();
}

bool MainWindow::saveAs() {
  QString file = QFileDialog::getSaveFileName(this, tr("Save as"), editor_.fileName(),
                                              tr("Projects (*.json)"));
  if (file.isEmpty()) return false;
  if (!file.endsWith(".json", Qt::CaseInsensitive)) file += ".json";
  return editor_.saveAs(file);
}

bool MainWindow::mayDiscard() {
  if (!editor_.session().isModified()) return true;
  const auto answer = QMessageBox::question(
      this, tr("Unsaved changes"), tr("Save the changes to \"%1\"?").arg(windowTitle()),
      QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Save);
  if (answer == QMessageBox::Save) return save();
  return answer == QMessageBox::Discard;
}

void MainWindow::updateTitle() {
  const QString file = editor_.fileName();
  const QString name =
      file.isEmpty() ? QString::fromStdString(editor_.project().name) : QFileInfo(file).fileName();
  setWindowTitle(name + "[*] – Palpa");
  setWindowModified(editor_.session().isModified());
}

void MainWindow::updateActions() {
  const modeling::Document& document = editor_.session().document();
  const auto show = [](QAction* action, const QString& verb, bool can, const std::string& label) {
    action->setEnabled(can);
    action->setText(can ? verb + " " + QString::fromStdString(label) : verb);
  };
  show(undo_, tr("&Undo"), document.canUndo(), document.undoLabel());
  show(redo_, tr("&Redo"), document.canRedo(), document.redoLabel());
}

void MainWindow::updateStatus() {
  rebuild_->setText(rebuildText(editor_.rebuildStatus()));
}

void MainWindow::closeEvent(QCloseEvent* event) {
  event->setAccepted(mayDiscard());
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  const auto urls = event->mimeData()->urls();
  if (!urls.isEmpty() && mayDiscard()) openFile(urls.front().toLocalFile());
}

}  // namespace palpa::gui
