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
#include "app/gui/actions/point_actions.h"
#include "app/gui/actions/primitive_actions.h"
#include "app/gui/actions/proposal_actions.h"
#include "app/gui/actions/select_actions.h"
#include "app/gui/actions/solid_actions.h"
#include "app/gui/actions/view_actions.h"
#include "app/gui/base/appearance.h"
#include "app/gui/base/application.h"
#include "app/gui/base/background_job.h"
#include "app/gui/dialogs/material_dialog.h"
#include "app/gui/dialogs/preferences_dialog.h"
#include "app/gui/dialogs/recovery_dialog.h"
#include "app/gui/docks/comparison_dock.h"
#include "app/gui/docks/forces_dock.h"
#include "app/gui/docks/history_dock.h"
#include "app/gui/docks/model_dock.h"
#include "app/gui/docks/properties_dock.h"
#include "app/gui/docks/rebuild_dock.h"
#include "app/gui/docks/samples_dock.h"
#include "app/gui/docks/targets_dock.h"
#include "app/gui/document/accuracy_words.h"
#include "app/gui/document/rebuild_words.h"
#include "app/gui/simulate/displaced_dimensions.h"
#include "app/gui/simulate/simulate_actions.h"
#include "app/gui/tools/point_tools.h"
#include "app/gui/tools/support_tool.h"
#include "app/gui/tools/surface_tools.h"
#include "app/gui/widgets/elided_label.h"
#include "app/gui/widgets/screen_fit.h"
#include "app/gui/widgets/wheel_guard.h"
#include "app/gui/window/failure_notice.h"
#include "app/gui/window/keyboard_focus.h"
#include "app/view/camera/view_cube.h"

namespace palpa::gui {
namespace {

constexpr int kFirstWidth = 1280,
              kFirstHeight = 800;   // of the first window, if the screen is large enough
constexpr int kTitleBar = 36;       // height of the window's frame, approximately
constexpr int kSavedTime = 5000;    // ms
constexpr int kRoom = 8;            // px beside texts of the status bar
constexpr int kRateInterval = 250;  // ms between two updates of the rate
constexpr int kLayoutVersion = 4;   // of saveState(); other versions are not restored

}  // namespace

MainWindow::MainWindow()
    : editor_(settings_),
      simulation_(editor_),
      comparison_(editor_, simulation_, settings_, nullptr),
      finder_(new ShapeFinder(editor_)),
      viewport_(new ViewportWidget(this)),
      scene_(editor_, settings_, *viewport_),
      pictures_(new SimulationView(editor_, simulation_, settings_, scene_, *viewport_)),
      section_(new SectionView(simulation_, settings_, *viewport_)),
      samples_(new Samples(simulation_, *section_, settings_, *viewport_)),
      gradientView_(new GradientView(editor_, simulation_, settings_, *viewport_)),
      comparisonView_(
          new ComparisonView(comparison_, simulation_, *pictures_, settings_, *viewport_)),
      foundShape_(new FoundShapeView(*finder_, comparison_, *viewport_)),
      warnings_(editor_, *viewport_),
      menus_(*this),
      tools_(menus_, *viewport_),
      workspace_{*this, *statusBar(), settings_, editor_, *viewport_, scene_, menus_, tools_},
      messages_(new MessageBar(viewport_, static_cast<int>(view::kViewCubeSide))),
      hint_(new ElidedLabel(this)),
      rebuild_(new QPushButton(this)),
      rate_(new QLabel(this)),
      frame_(new QLabel(this)),
      docks_(*this, *menus_.view) {
  qApp->installEventFilter(new WheelGuard(this));
  qApp->installEventFilter(new ScreenFit(this));
  setCentralWidget(viewport_);
  setAcceptDrops(true);
  editor_.setRunner([this](const QString& title, const BackgroundWork& work) {
    return runWorkInBackground(*this, title, work);
  });
  files_ = new FileActions(workspace_);
  addPrimitiveActions(workspace_);
  comparisonActions_ = new ComparisonActions(workspace_, comparison_);
  new EditActions(workspace_);
  addDeleteAction(workspace_);
  new ViewActions(workspace_);
  addTools();
  new SolidActions(workspace_);
  new ProposalActions(workspace_);
  new DisplacedDimensions(simulation_, scene_.dimensions());
  new SimulateActions(workspace_, simulation_, *pictures_, *section_, *samples_);
  addDocks();
  addDialogs();
  addHelpActions(workspace_, *files_);
  addStatusBar();
  keyboard_ = std::make_unique<KeyboardFocus>(*this, *viewport_);
  connect(&editor_, &Editor::aboutToReplace, &tools_, &ToolBox::restart);
  connect(&editor_, &Editor::projectReplaced, viewport_, qOverload<>(&QWidget::setFocus));
  connect(&editor_, &Editor::fileChanged, this, &MainWindow::updateTitle);
  connect(&settings_, &Settings::changed, this, &MainWindow::applySettings);
  resize(
      QSize(kFirstWidth, kFirstHeight).boundedTo(screen()->availableSize() - QSize(0, kTitleBar)));
  resetLayout();
  restoreGeometry(settings_.windowGeometry());
  restoreState(settings_.windowState(), kLayoutVersion);
  applySettings();
  updateTitle();
  updateStatus();
}

MainWindow::~MainWindow() {
  // Ends the thread of a replay, which uses the touch loop.
  simulation_.setActive(false);
}

void MainWindow::addTools() {
  auto* options = new PointOptions(this);
  addPointTools(workspace_, *options);
  new SelectActions(workspace_, *options);
  new PointActions(workspace_, *options);
  addSurfaceTools(workspace_);
}

void MainWindow::addDocks() {
  using enum DockList::Stack;
  auto* model = docks_.add(new ModelDock(workspace_), kUpper);
  docks_.add(new HistoryDock(editor_, this), kUpper);
  auto* properties = docks_.add(new PropertiesDock(workspace_), kLower);
  auto* rebuild = docks_.add(new RebuildDock(editor_, this), kLower);
  auto* forces = docks_.add(new ForcesDock(simulation_, editor_, settings_, this), kUpper);
  docks_.add(new SamplesDock(*samples_, *section_, settings_, this), kLower);
  auto* comparison = docks_.add(
      new ComparisonDock(workspace_, comparison_, *comparisonView_, *comparisonActions_, this),
      kUpper);
  auto* targets = docks_.add(new TargetsDock(workspace_, *finder_, this), kLower);
  menus_.conditions->addSeparator();
  menus_.add(menus_.conditions,
             {"find-shape",
              tr("&Find a shape …"),
              {},
              tr("Say what touches should feel like, and search for such a shape")},
             this, [targets] {
               bringToFront(*targets);
               targets->takeKeys();
             });
  connect(comparisonActions_, &ComparisonActions::begun, comparison,
          [comparison] { bringToFront(*comparison); });
  connect(&simulation_, &Simulation::activeChanged, this, [this, model, forces](bool active) {
    docks_.exchangeHeights(active);
    if (comparison_.isActive()) return;  // its table lists the forces, too
    if (active)
      bringToFront(*forces);
    else
      model->raise();
  });
  connect(model, &ModelDock::rowChosen, this, [properties](const QString& section) {
    if (!properties->toggleViewAction()->isChecked()) return;  // closed by the user
    bringToFront(*properties);
    properties->showSection(section);
  });
  connect(rebuild_, &QPushButton::clicked, this, [rebuild] { bringToFront(*rebuild); });
  menus_.add(menus_.view,
             {nullptr, tr("Reset &layout"), {}, tr("Put all panels and tool bars back in place")},
             this, &MainWindow::resetLayout);
}

void MainWindow::resetLayout() {
  addToolBar(Qt::TopToolBarArea, menus_.bar);
  addToolBar(Qt::LeftToolBarArea, menus_.tools);
  menus_.bar->show();
  menus_.tools->show();
  docks_.layOut();
}

void MainWindow::addDialogs() {
  menus_.add(menus_.conditions,
             {"material", tr("&Material …"), {}, tr("Choose the material of the solid")}, this,
             [this] { editMaterial(workspace_); });
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
  statusBar()->addPermanentWidget(rebuild_);
  statusBar()->addPermanentWidget(rate_);
  statusBar()->addPermanentWidget(frame_);
  rate_->setObjectName("touchRate");
  rate_->setToolTip(tr("Computed forces per second"));
  auto* rateTimer = new QTimer(this);
  connect(rateTimer, &QTimer::timeout, this, &MainWindow::updateRate);
  rateTimer->start(kRateInterval);
  connect(&simulation_, &Simulation::activeChanged, this, &MainWindow::updateRate);
  const auto showHint = [this] { hint_->setText(tools_.active().hint()); };
  connect(&tools_, &ToolBox::changed, this, showHint);
  connect(&tools_, &ToolBox::explained, messages_, &MessageBar::showNote);
  showHint();
  connect(&editor_, &Editor::rebuildChanged, this, &MainWindow::updateStatus);
  connect(&editor_, &Editor::saved, this, [this](const QString& file) {
    statusBar()->showMessage(tr("Saved %1").arg(QFileInfo(file).fileName()), kSavedTime);
  });
  connect(&editor_, &Editor::refused, messages_,
          [this](const QString& message) { messages_->showError(message); });
  connect(&editor_, &Editor::said, messages_, &MessageBar::showNote);
  if (auto* application = qobject_cast<Application*>(qApp))
    connect(application, &Application::failed, messages_,
            [this](const QString& message) { messages_->showError(message); });
  const auto paintSupport = [this] {
    simulation_.setActive(false);
    const QString name = SupportTool::tr("&Paint support").remove('&');
    if (auto* tool = menus_.conditions->findChild<QAction*>(name)) tool->trigger();
  };
  const auto enterDensity = [this] { editMaterial(workspace_, true); };
  new FailureNotice(editor_, simulation_, *messages_, {paintSupport, enterDensity}, this);
  connect(viewport_, &ViewportWidget::escaped, this, [this] {
    if (finder_->state() == ShapeFinder::State::kSearching) {
      finder_->cancel();
      return;
    }
    const bool wasError = messages_->hasErrors();
    messages_->clear();
    if (!wasError) editor_.select({});
  });
  frame_->setToolTip(tr("Frames per second, from the drawing time of the last one"));
  connect(viewport_, &ViewportWidget::framePainted, this, [this] {
    const double rate = 1000 / std::max(1.0, viewport_->lastFrameMilliseconds());
    frame_->setText(tr("%1 frames/s").arg(rate, 0, 'f', rate < 10 ? 1 : 0));
  });
  // Constant width for usual numbers, so that the layout does not jump.
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
  // The accuracy appears here only where it is not the requested one.
  const QString reason = accuracyReason(status);
  rebuild_->setText(
      reason.isEmpty() || status.state != app::RebuildStatus::State::kUpToDate
          ? rebuildText(status)
          : tr("%1 · accuracy %2").arg(rebuildText(status), percentText(status.touchError)));
  QStringList tip{tr("Show the stages of the rebuild and the facts of the model")};
  if (status.modelRevision > 0) tip << accuracyText(status, editor_.project().mesh.accuracy);
  if (!reason.isEmpty()) tip << reason;
  rebuild_->setToolTip(tip.join('\n'));
  rebuild_->setIcon(status.state == app::RebuildStatus::State::kFailed ? icon("warning") : QIcon());
  viewport_->setComputing(status.state == app::RebuildStatus::State::kBuilding);
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
    // Its thread uses the parts of the window.
    closeAfterBackgroundJob(*this);
    event->ignore();
    return;
  }
  event->setAccepted(files_->mayDiscard());
  if (!event->isAccepted()) return;
  files_->storeThumbnail();
  // The stored layout is the one of Model mode, in which the window opens.
  if (simulation_.isActive()) docks_.exchangeHeights(false);
  settings_.setWindow(saveGeometry(), saveState(kLayoutVersion));
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
  // Later, so that the other program does not wait for questions and reading.
  QTimer::singleShot(0, this, [this, files] { files_->openDropped(files); });
}

void MainWindow::begin(const QStringList& files) {
  if (!files.isEmpty()) openFile(files.front());
  if (files.size() > 1)
    messages_->showNote(tr("Of the %1 files given, the first was opened").arg(files.size()));
  const bool hasChoice = settings_.isFirstRun() || !settings_.recentFiles().isEmpty();
  const bool isWelcome = files.isEmpty() && hasChoice && settings_.welcomesAtStart();
  const auto mayReplace = [this] { return files_->mayDiscard(); };
  offerRecovery(editor_, *this, mayReplace, [this, isWelcome](bool any) {
    if (isWelcome && !any) files_->showWelcome();
  });
}

}  // namespace palpa::gui
