#include "app/gui/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QFileInfo>
#include <QMimeData>
#include <QStatusBar>

#include "app/gui/actions/delete_action.h"
#include "app/gui/actions/edit_actions.h"
#include "app/gui/actions/help_actions.h"
#include "app/gui/actions/view_actions.h"
#include "app/gui/appearance.h"
#include "app/gui/docks/history_dock.h"
#include "app/gui/docks/model_dock.h"
#include "app/gui/docks/properties_dock.h"
#include "app/gui/docks/rebuild_dock.h"
#include "app/gui/tools/select_tool.h"

namespace palpa::gui {
namespace {

constexpr int kDockWidth = 320;    // leaves the view three quarters of a window of 1280
constexpr int kLayoutVersion = 1;  // of what saveState() writes; another one is not restored

}  // namespace

MainWindow::MainWindow()
    : editor_(settings_),
      viewport_(new ViewportWidget(this)),
      scene_(editor_, *viewport_),
      menus_(*this),
      tools_(menus_, *viewport_),
      workspace_{*this, settings_, editor_, *viewport_, scene_, menus_, tools_},
      hint_(new QLabel(this)),
      rebuild_(new QLabel(this)),
      frame_(new QLabel(this)) {
  setCentralWidget(viewport_);
  setAcceptDrops(true);
  files_ = new FileActions(workspace_);
  new EditActions(workspace_);
  addDeleteAction(workspace_);
  new ViewActions(workspace_);
  addTools();
  addDocks();
  addHelpActions(workspace_);
  addStatusBar();
  connect(&editor_, &Editor::fileChanged, this, &MainWindow::updateTitle);
  connect(&settings_, &Settings::changed, this, &MainWindow::applySettings);
  resize(1280, 800);
  layOutDocks();
  restoreGeometry(settings_.windowGeometry());
  restoreState(settings_.windowState(), kLayoutVersion);
  applySettings();
  updateTitle();
  updateStatus();
}

void MainWindow::addTools() {
  tools_.add(std::make_unique<SelectTool>(editor_, scene_, *viewport_), menus_.select,
             {"select", tr("&Select and move"), QKeySequence(Qt::Key_S),
              tr("Select control points and drag them")});
}

void MainWindow::addDocks() {
  docks_ = {new ModelDock(workspace_), new HistoryDock(editor_, this),
            new PropertiesDock(workspace_), new RebuildDock(editor_, this)};
  setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
  for (QDockWidget* dock : docks_) menus_.view->addAction(dock->toggleViewAction());
  menus_.add(menus_.view,
             {nullptr, tr("Reset &layout"), {}, tr("Put all panels and tool bars back in place")},
             this, &MainWindow::layOutDocks);
}

void MainWindow::layOutDocks() {
  const auto [model, history, properties, rebuild] = docks_;
  for (QDockWidget* dock : docks_) {
    removeDockWidget(dock);
    dock->setFloating(false);
  }
  addToolBar(Qt::TopToolBarArea, menus_.bar);
  addToolBar(Qt::LeftToolBarArea, menus_.tools);
  menus_.bar->show();
  menus_.tools->show();
  for (QDockWidget* dock : {model, properties, rebuild})
    addDockWidget(Qt::RightDockWidgetArea, dock);
  tabifyDockWidget(model, history);
  for (QDockWidget* dock : docks_) dock->show();
  model->raise();
  const int rebuildHeight = rebuild->sizeHint().height();
  const int rest = height() - menus_.bar->height() - rebuildHeight;
  resizeDocks({model, properties, rebuild}, {rest * 2 / 5, rest * 3 / 5, rebuildHeight},
              Qt::Vertical);
  resizeDocks({model}, {kDockWidth}, Qt::Horizontal);
}

void MainWindow::addStatusBar() {
  statusBar()->addWidget(hint_, 1);
  statusBar()->addPermanentWidget(rebuild_);
  statusBar()->addPermanentWidget(frame_);
  const auto showHint = [this] { hint_->setText(tools_.active().hint()); };
  connect(&tools_, &ToolBox::changed, this, showHint);
  showHint();
  connect(&editor_, &Editor::rebuildChanged, this, &MainWindow::updateStatus);
  const auto say = [this](const QString& message) { statusBar()->showMessage(message, 15000); };
  connect(&editor_, &Editor::refused, this, say);
  connect(&editor_, &Editor::said, this, say);
  connect(viewport_, &ViewportWidget::framePainted, this, [this] {
    frame_->setText(tr("%1 ms/frame").arg(viewport_->lastFrameMilliseconds(), 0, 'f', 0));
  });
}

void MainWindow::applySettings() {
  if (settings_.theme() != currentTheme()) applyTheme(*qApp, settings_.theme());
  viewport_->viewport().setTheme(viewportTheme(currentTheme()));
  viewport_->update();
}

void MainWindow::updateTitle() {
  const QString file = editor_.fileName();
  const QString name =
      file.isEmpty() ? QString::fromStdString(editor_.project().name) : QFileInfo(file).fileName();
  setWindowTitle(name + "[*] – Palpa");
  setWindowModified(editor_.session().isModified());
}

void MainWindow::updateStatus() {
  rebuild_->setText(rebuildText(editor_.rebuildStatus()));
}

void MainWindow::closeEvent(QCloseEvent* event) {
  event->setAccepted(files_->mayDiscard());
  if (event->isAccepted()) settings_.setWindow(saveGeometry(), saveState(kLayoutVersion));
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  const auto urls = event->mimeData()->urls();
  if (!urls.isEmpty() && files_->mayDiscard()) openFile(urls.front().toLocalFile());
}

}  // namespace palpa::gui
