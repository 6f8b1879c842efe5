#include "app/gui/window/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QFileInfo>
#include <QMimeData>
#include <QScreen>
#include <QStatusBar>
#include <QTimer>
#include <QUrl>
#include <algorithm>

#include "app/gui/actions/delete_action.h"
#include "app/gui/actions/edit_actions.h"
#include "app/gui/actions/help_actions.h"
#include "app/gui/actions/solid_actions.h"
#include "app/gui/actions/view_actions.h"
#include "app/gui/base/appearance.h"
#include "app/gui/base/background_job.h"
#include "app/gui/dialogs/material_dialog.h"
#include "app/gui/dialogs/preferences_dialog.h"
#include "app/gui/dialogs/recovery_dialog.h"
#include "app/gui/dialogs/welcome_dialog.h"
#include "app/gui/docks/forces_dock.h"
#include "app/gui/docks/history_dock.h"
#include "app/gui/docks/model_dock.h"
#include "app/gui/docks/properties_dock.h"
#include "app/gui/docks/rebuild_dock.h"
#include "app/gui/simulate/simulate_actions.h"
#include "app/gui/tools/point_tools.h"
#include "app/gui/tools/surface_tools.h"

namespace palpa::gui {
namespace {

constexpr int kWidth = 1280, kHeight = 800;  // of the first window, where the screen has room
constexpr int kTitleBar = 36;                // about what frames of windows take
constexpr int kUntilCloseAgain = 50;         // ms until a window that was busy tries again to close
constexpr int kDockWidth = 340;  // leaves the view nearly three quarters of a window of 1280
constexpr int kUntilFailureIsSaid = 1000;  // ms: passing through a bad shape is no event
constexpr int kSavedTime = 5000;           // ms
constexpr int kRoom = 8;                   // px beside words of the status bar
constexpr int kRateInterval = 250;         // ms between two looks at the rate of touching
constexpr int kLayoutVersion = 3;  // of what saveState() writes; another one is not restored

}  // namespace

MainWindow::MainWindow()
    : editor_(settings_),
      simulation_(editor_),
      viewport_(new ViewportWidget(this)),
      scene_(editor_, settings_, *viewport_),
      pictures_(new SimulationView(simulation_, settings_, scene_, *viewport_)),
      warnings_(editor_, *viewport_),
      menus_(*this),
      tools_(menus_, *viewport_),
      workspace_{*this, settings_, editor_, *viewport_, scene_, menus_, tools_},
      messages_(new MessageBar(viewport_)),
      hint_(new QLabel(this)),
      rebuild_(new QPushButton(this)),
      rate_(new QLabel(this)),
      frame_(new QLabel(this)) {
  setCentralWidget(viewport_);
  setAcceptDrops(true);
  editor_.setRunner([this](const QString& title, const BackgroundWork& work) {
    return runWorkInBackground(*this, title, work);
  });
  files_ = new FileActions(workspace_);
  new EditActions(workspace_);
  addDeleteAction(workspace_);
  new ViewActions(workspace_);
  addTools();
  new SolidActions(workspace_);
  new SimulateActions(workspace_, simulation_, *pictures_);
  addDocks();
  addDialogs();
  addHelpActions(workspace_);
  addStatusBar();
  connect(&editor_, &Editor::aboutToReplace, &tools_, &ToolBox::restart);
  connect(&editor_, &Editor::fileChanged, this, &MainWindow::updateTitle);
  connect(&settings_, &Settings::changed, this, &MainWindow::applySettings);
  resize(QSize(kWidth, kHeight).boundedTo(screen()->availableSize() - QSize(0, kTitleBar)));
  layOutDocks();
  restoreGeometry(settings_.windowGeometry());
  restoreState(settings_.windowState(), kLayoutVersion);
  applySettings();
  updateTitle();
  updateStatus();
}

MainWindow::~MainWindow() {
  // A replay has a thread that talks to the touch loop, which goes before what started it.
  simulation_.setActive(false);
  // Qt would delete the panels last of all, after the editor that their fields write to.
  for (QDockWidget* dock : docks_) delete dock;
}

void MainWindow::addTools() {
  addPointTools(workspace_);
  addSurfaceTools(workspace_);
}

void MainWindow::addDocks() {
  docks_ = {new ModelDock(workspace_), new HistoryDock(editor_, this),
            new PropertiesDock(workspace_), new RebuildDock(editor_, this),
            new ForcesDock(simulation_, editor_, settings_, this)};
  connect(&simulation_, &Simulation::activeChanged, this, [this](bool active) {
    if (active) docks_[4]->show();
    docks_[active ? 4 : 0]->raise();
  });
  setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
  for (QDockWidget* dock : docks_) menus_.view->addAction(dock->toggleViewAction());
  menus_.add(menus_.view,
             {nullptr, tr("Reset &layout"), {}, tr("Put all panels and tool bars back in place")},
             this, &MainWindow::layOutDocks);
}

void MainWindow::layOutDocks() {
  const auto [model, history, properties, rebuild, forces] = docks_;
  for (QDockWidget* dock : docks_) {
    removeDockWidget(dock);
    dock->setFloating(false);
  }
  addToolBar(Qt::TopToolBarArea, menus_.bar);
  addToolBar(Qt::LeftToolBarArea, menus_.tools);
  menus_.bar->show();
  menus_.tools->show();
  for (QDockWidget* dock : {model, properties}) addDockWidget(Qt::RightDockWidgetArea, dock);
  tabifyDockWidget(model, history);
  tabifyDockWidget(history, forces);
  tabifyDockWidget(properties, rebuild);
  for (QDockWidget* dock : docks_) dock->show();
  model->raise();
  properties->raise();
  // Supports, loads and touches show without scrolling in a window of 1280 x 800.
  resizeDocks({model, properties}, {height() * 44 / 100, height() * 56 / 100}, Qt::Vertical);
  resizeDocks({model}, {kDockWidth}, Qt::Horizontal);
}

void MainWindow::addDialogs() {
  menus_.add(menus_.conditions,
             {"material", tr("&Material …"), {}, tr("What the solid is made of")}, this, [this] {
               MaterialDialog dialog(settings_, editor_.project().material, this);
               if (dialog.exec() == QDialog::Accepted)
                 editor_.perform(modeling::SetMaterial{dialog.material()});
             });
  menus_.edit->addSeparator();
  menus_.add(menus_.edit,
             {"preferences", tr("Pre&ferences …"), QKeySequence(Qt::CTRL | Qt::Key_Comma),
              tr("Theme, units and limits")},
             this, [this] { PreferencesDialog(settings_, this).exec(); });
}

void MainWindow::addStatusBar() {
  statusBar()->addWidget(hint_, 1);
  rebuild_->setObjectName("rebuildStatus");
  rebuild_->setFlat(true);
  rebuild_->setToolTip(tr("Show the stages of the rebuild and the facts of the model"));
  connect(rebuild_, &QPushButton::clicked, this, [this] {
    QDockWidget* dock = docks_[3];
    dock->show();
    dock->raise();
  });
  statusBar()->addPermanentWidget(rebuild_);
  statusBar()->addPermanentWidget(rate_);
  statusBar()->addPermanentWidget(frame_);
  rate_->setObjectName("touchRate");
  rate_->setToolTip(tr("How often a second forces are found"));
  auto* rateTimer = new QTimer(this);
  connect(rateTimer, &QTimer::timeout, this, &MainWindow::updateRate);
  rateTimer->start(kRateInterval);
  connect(&simulation_, &Simulation::activeChanged, this, &MainWindow::updateRate);
  const auto showHint = [this] { hint_->setText(tools_.active().hint()); };
  connect(&tools_, &ToolBox::changed, this, showHint);
  showHint();
  connect(&editor_, &Editor::rebuildChanged, this, &MainWindow::updateStatus);
  connect(&editor_, &Editor::saved, this, [this](const QString& file) {
    statusBar()->showMessage(tr("Saved %1").arg(QFileInfo(file).fileName()), kSavedTime);
  });
  connect(&editor_, &Editor::refused, messages_, &MessageBar::showError);
  connect(&editor_, &Editor::said, messages_, &MessageBar::showNote);
  failureTimer_.setSingleShot(true);
  failureTimer_.setInterval(kUntilFailureIsSaid);
  connect(&failureTimer_, &QTimer::timeout, this, &MainWindow::sayFailure);
  connect(viewport_, &ViewportWidget::escaped, messages_, &MessageBar::clear);
  frame_->setToolTip(
      tr("Pictures a second that the view could draw, from the time of the last one"));
  connect(viewport_, &ViewportWidget::framePainted, this, [this] {
    const double rate = 1000 / std::max(1.0, viewport_->lastFrameMilliseconds());
    frame_->setText(tr("%1 frames/s").arg(rate, 0, 'f', rate < 10 ? 1 : 0));
  });
  // Wide enough for usual numbers, so that nothing jumps as digits come and go.
  for (const auto& [label, widest] :
       {std::pair{rate_, tr("%L1 Hz").arg(2000)}, std::pair{frame_, tr("%1 frames/s").arg(1000)}}) {
    label->setMinimumWidth(label->fontMetrics().horizontalAdvance(widest) + kRoom);
    label->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  }
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
  const app::RebuildStatus status = editor_.rebuildStatus();
  rebuild_->setText(rebuildText(status));
  rebuild_->setIcon(status.state == app::RebuildStatus::State::kFailed ? icon("warning") : QIcon());
  if (status.state == app::RebuildStatus::State::kFailed) {
    if (!failureTimer_.isActive()) failureTimer_.start();
  } else {
    failureTimer_.stop();
    if (status.state == app::RebuildStatus::State::kUpToDate) messages_->withdraw(failure_);
  }
  viewport_->setComputing(status.state == app::RebuildStatus::State::kBuilding);
}

void MainWindow::sayFailure() {
  const app::RebuildStatus status = editor_.rebuildStatus();
  if (status.state != app::RebuildStatus::State::kFailed) return;
  const QString text = tr("The model cannot be built. %1").arg(failureText(status));
  if (text == failure_ && messages_->messages().contains(text)) return;
  messages_->withdraw(failure_);
  failure_ = text;
  messages_->showError(text);
}

void MainWindow::updateRate() {
  QString text;
  if (simulation_.isActive() && simulation_.drawn()) {
    text = tr("%L1 Hz").arg(simulation_.snapshot().rate, 0, 'f', 0);
    const auto residual = editor_.rebuildStatus().residual;
    if (simulation_.isBehind())
      text = tr("Touching the previous model · %1").arg(text);
    else if (residual)
      text = tr("Solved to %L1 · %2").arg(*residual, 0, 'e', 0).arg(text);
  }
  if (rate_->text() != text) rate_->setText(text);
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (isBackgroundJobRunning()) {
    // It stops soon; until then its thread uses what closing would take away.
    cancelBackgroundJob();
    event->ignore();
    QTimer::singleShot(kUntilCloseAgain, this, &QWidget::close);
    return;
  }
  // What is being typed counts, and belongs to the question whether to save.
  if (QWidget* field = focusWidget()) field->clearFocus();
  event->setAccepted(files_->mayDiscard());
  if (event->isAccepted()) settings_.setWindow(saveGeometry(), saveState(kLayoutVersion));
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  if (isBackgroundJobRunning()) {
    messages_->showNote(tr("Wait until the present file is done, then drop this one again"));
    return;
  }
  QStringList files;
  for (const QUrl& url : event->mimeData()->urls())
    if (url.isLocalFile()) files << url.toLocalFile();
  // Later, so that the other program need not wait for questions and reading.
  QTimer::singleShot(0, this, [this, files] { files_->openDropped(files); });
}

void MainWindow::begin(const QStringList& files) {
  if (!files.isEmpty()) openFile(files.front());
  if (files.size() > 1)
    messages_->showNote(tr("Of the %1 files given, the first was opened").arg(files.size()));
  const bool isWelcome = files.isEmpty() && settings_.isFirstRun();
  const auto mayReplace = [this] { return files_->mayDiscard(); };
  offerRecovery(editor_, *this, mayReplace, [this, isWelcome](bool any) {
    if (isWelcome && !any) showWelcome();
  });
}

void MainWindow::showWelcome() {
  WelcomeDialog dialog(this);
  dialog.exec();
  using Choice = WelcomeDialog::Choice;
  if (dialog.choice() == Choice::kNewSolid) files_->newSolid();
  if (dialog.choice() == Choice::kOpen) files_->open();
  if (dialog.choice() == Choice::kExample && files_->mayDiscard())
    files_->openExample(dialog.example());
}

}  // namespace palpa::gui
