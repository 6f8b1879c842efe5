#include "tests/reliability/interrupter.h"

#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QLineEdit>
#include <QMenu>
#include <QMessageBox>
#include <QMouseEvent>
#include <QPushButton>
#include <QTest>
#include <QTimer>
#include <QToolButton>
#include <fstream>

#include "app/core/session/new_project.h"
#include "app/gui/base/background_job.h"
#include "app/gui/base/progress_dialog.h"
#include "app/gui/simulate/recording_actions.h"
#include "modeling/project/project_file.h"
#include "modeling/shapes/primitives.h"
#include "tests/reliability/written_files.h"

namespace palpa::reliability {
namespace {

namespace fs = std::filesystem;

constexpr int kAttendEvery = 15;      // ms
constexpr int kSettleTime = 60;       // ms until a dialog is answered
constexpr int kFileDialogTime = 250;  // ms: it proposes a name once it has read its folder
constexpr int kMaxProgress = 1500;    // ms until work that nobody interrupts is cancelled
constexpr int kMaxTries = 60;         // to get rid of a dialog
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kPatience = 1'000'000;  // ms
#else
constexpr int kPatience = 180'000;  // ms
#endif
constexpr int kWindowUses = 60;                    // of one window
constexpr double kMeshEdge = 10;                   // mm: the mesh body is built as quickly
constexpr std::uint64_t kLongRecording = 200'000;  // steps of a millisecond

/// An example that is built within a second, under sanitizers within ten.
modeling::Project coarseSphere() {
  modeling::Project project = modeling::readProject(PALPA_PROJECTS "/sphere.json");
  project.mesh.accuracy = 0.1;
  return project;
}

QString nameOf(const QObject& object) {
  return QString("%1 %2").arg(object.metaObject()->className(), object.objectName());
}

/// The object name, or the text of an entry or a button.
template <class Object>
QString titleOf(const Object& object) {
  return object.objectName().isEmpty() ? object.text() : object.objectName();
}

/// All entries and buttons of a window by name. Equal names are numbered.
std::map<QString, QPointer<QObject>> targetsOf(gui::MainWindow& window) {
  for (QMenu* menu : window.findChildren<QMenu*>()) Q_EMIT menu->aboutToShow();
  std::map<QString, QPointer<QObject>> found;
  const auto add = [&found](const QString& name, QObject* object) {
    QString unique = name;
    for (int k = 2; found.contains(unique); ++k) unique = QString("%1 #%2").arg(name).arg(k);
    found[unique] = object;
  };
  for (QAction* action : window.findChildren<QAction*>())
    if (!action->isSeparator() && !action->menu() && !titleOf(*action).isEmpty())
      add("entry " + titleOf(*action), action);
  for (auto* button : window.findChildren<QAbstractButton*>()) {
    const auto* tool = qobject_cast<QToolButton*>(button);
    if (tool && (tool->defaultAction() || tool->menu())) continue;
    const QObject* owner = button->parent();
    while (owner->objectName().isEmpty() && owner->parent()) owner = owner->parent();
    add("button " + owner->objectName() + "/" + titleOf(*button), button);
  }
  return found;
}

/// The button that goes on with the work of a dialog; null without one.
QAbstractButton* acceptButton(const QWidget& dialog) {
  for (const auto* box : dialog.findChildren<QDialogButtonBox*>())
    for (QAbstractButton* button : box->buttons()) {
      const auto role = box->buttonRole(button);
      if (button->isEnabled() &&
          (role == QDialogButtonBox::AcceptRole || role == QDialogButtonBox::YesRole))
        return button;
    }
  return nullptr;
}

/// The question whether unsaved edits are to be saved.
QMessageBox* saveQuestion(QWidget& dialog) {
  auto* box = qobject_cast<QMessageBox*>(&dialog);
  return box && box->button(QMessageBox::Discard) ? box : nullptr;
}

void press(QWidget& widget, Qt::Key key) {
  QWidget* focus = widget.focusWidget();
  QTest::keyClick(focus ? focus : &widget, key);
}

}  // namespace

const char* nameOf(Situation situation) {
  switch (situation) {
    case Situation::kNewProject:
      return "new project";
    case Situation::kSolid:
      return "solid";
    case Situation::kMeshBody:
      return "mesh body";
    case Situation::kTouching:
      return "touching";
    case Situation::kRebuilding:
      return "rebuilding";
  }
  return "";
}

const char* nameOf(Interruption interruption) {
  switch (interruption) {
    case Interruption::kEscape:
      return "Escape";
    case Interruption::kReturn:
      return "Return";
    case Interruption::kCloseDialog:
      return "close dialog";
    case Interruption::kCloseWindow:
      return "close window";
  }
  return "";
}

QString nameOf(Situation situation, const QString& target, Interruption interruption) {
  return QString("%1, %2, %3").arg(nameOf(situation), target, nameOf(interruption));
}

Interrupter::Interrupter(Campaign& campaign, QString folder, ActionLog log)
    : campaign_(campaign),
      folder_(std::move(folder)),
      log_(std::move(log)),
      random_(campaign.seed()) {
  QDir().mkdir(folder_ + "/written");
  QTimer::singleShot(kAttendEvery, &attendant_, [this] { attend(); });
}

Interrupter::~Interrupter() = default;

void Interrupter::openWindow() {
  isTouching_ = false;
  window_.reset();
  window_ = std::make_unique<gui::MainWindow>();
  window_->settings().setLastFolder(folder_ + "/written");
  windowUses_ = 0;
  QObject::connect(&editor(), &gui::Editor::projectReplaced, window_.get(),
                   [this] { isReplaced_ = true; });
  QObject::connect(&editor(), &gui::Editor::saved, window_.get(), [this] { isSaved_ = true; });
  window_->show();
  (void)QTest::qWaitForWindowExposed(window_.get());
  QApplication::setActiveWindow(window_.get());
}

void Interrupter::enter(Situation situation) {
  if (!window_ || ++windowUses_ > kWindowUses) openWindow();
  if (!window_->isVisible()) window_->show();  // a new one would take seconds
  if (!QApplication::activeWindow()) QApplication::setActiveWindow(window_.get());
  window_->simulation().setActive(false);
  if (situation == Situation::kNewProject)
    return editor().start(app::makeProject(modeling::makeCylinder(15, 30), "new"));
  const QString file = folder_ + (situation == Situation::kMeshBody ? "/body.obj" : "/case.json");
  QFile::remove(file);
  if (situation == Situation::kMeshBody)
    QFile::copy(folder_ + "/tetrahedron.obj", file);
  else
    modeling::writeProject(coarseSphere(), file.toStdString());
  campaign_.require(window_->openFile(file), "the project is not opened");
  if (situation == Situation::kMeshBody) {
    modeling::MeshSettings coarse = editor().project().mesh;
    coarse.edgeLength = kMeshEdge;
    editor().perform(modeling::SetMesh{coarse});
  }
  const auto isBuilt = [this] {
    return editor().rebuildStatus().state != app::RebuildStatus::State::kBuilding;
  };
  campaign_.require(QTest::qWaitFor(isBuilt, kPatience), "the model is not built");
  editor().perform(modeling::RenameProject{"edited"});
  select();
  if (situation == Situation::kTouching) startTouching();
  if (situation == Situation::kRebuilding) {
    modeling::MeshSettings finer = editor().project().mesh;
    finer.engine = modeling::Engine::kTriangles;
    finer.edgeLength = 2.5;
    editor().perform(modeling::SetMesh{finer});
  }
}

/// Selects something: most panels show what is selected.
void Interrupter::select() {
  using gui::Selection;
  const modeling::Project& project = editor().project();
  switch (pick(random_, 0, 4)) {
    case 0:
      return editor().select(editor().solid() ? Selection::ofPoints({0, 1}) : Selection{});
    case 1:
      return editor().select(Selection::ofPatches({0}));
    case 2:
      return editor().select(editor().solid() ? Selection::ofEdges({0}) : Selection{});
    case 3:
      return editor().select(
          Selection::of(Selection::Kind::kSupport, project.supports.front().name));
    default:
      return editor().select({});
  }
}

void Interrupter::startTouching() {
  window_->simulation().setActive(true);
  const auto isDrawn = [this] { return window_->simulation().drawn() != nullptr; };
  if (!campaign_.require(QTest::qWaitFor(isDrawn, kPatience), "the body is not drawn")) return;
  app::RecordingFile file;
  file.recording.steps = kLongRecording;
  file.recording.entries.push_back({0,
                                    {app::TouchCommand::Kind::kBegin,
                                     1,
                                     {bem::ContactTool::Kind::kGrab, 8, 0},
                                     {0, 0, 25},
                                     {0, 0, -1}}});
  window_->findChild<gui::RecordingActions*>()->recorder().open(std::move(file));
  const QPoint at = view().rect().center() + QPoint(10, 10);
  QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  for (int k = 1; k <= 3; ++k) {
    const QPoint next = at + QPoint(6 * k, -4 * k);
    QMouseEvent event(QEvent::MouseMove, next, view().mapToGlobal(next), Qt::NoButton,
                      Qt::LeftButton, {});
    QApplication::sendEvent(&view(), &event);
    QTest::qWait(10);
  }
  isTouching_ = true;
}

QStringList Interrupter::targets(Situation situation) {
  enter(situation);
  QStringList names;
  for (const auto& [name, object] : targetsOf(*window_)) names << name;
  return names;
}

bool Interrupter::use(const QString& target) {
  const auto all = targetsOf(*window_);
  const auto found = all.find(target);
  if (found == all.end()) return false;  // of another selection
  if (auto* action = qobject_cast<QAction*>(found->second)) {
    if (!action->isEnabled()) return false;
    action->trigger();
    return true;
  }
  auto* button = qobject_cast<QAbstractButton*>(found->second);
  if (!button || !button->isEnabled()) return false;
  button->click();
  return true;
}

bool Interrupter::run(Situation situation, const QString& target, Interruption interruption,
                      int depth) {
  const QString name =
      QString("%1 at dialog %2").arg(nameOf(situation, target, interruption)).arg(depth + 1);
  log_(name);
  enter(situation);
  const Clock::time_point since = Clock::now();
  const fs::file_time_type filesSince = fs::file_time_type::clock::now();
  isModified_ = editor().session().isModified();
  const std::string before = modeling::toJson(editor().project());
  interruption_ = interruption;
  depth_ = depth;
  answered_ = tries_ = 0;
  isInterrupted_ = isAsked_ = isSaved_ = isReplaced_ = false;
  dialog_ = nullptr;
  failure_.clear();
  isAttending_ = true;
  const bool isUsed = use(target);
  const bool isDeep = isInterrupted_;
  ++counts_[isUsed ? "used" : "disabled"];
  if (isUsed && !isInterrupted_) interrupt(nullptr);
  if (std::exchange(isTouching_, false))
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, view().rect().center());
  const auto isQuiet = [] {
    return !QApplication::activeModalWidget() && !QApplication::activePopupWidget() &&
           !gui::isBackgroundJobRunning();
  };
  QTest::qWait(interruption == Interruption::kCloseWindow ? 80 : 5);
  campaign_.require(QTest::qWaitFor(isQuiet, kPatience),
                    name.toStdString() + ": a dialog or a job stays");
  isAttending_ = false;
  QTest::qWait(2 * kAttendEvery);
  if (!failure_.isEmpty()) campaign_.fail((name + ": " + failure_).toStdString());
  const bool isLost = isReplaced_ || !window_->isVisible();
  campaign_.require(!(isModified_ && isLost) || isAsked_ || isSaved_,
                    name.toStdString() + ": edits were lost without a question");
  campaign_.require(!QApplication::overrideCursor(),
                    name.toStdString() + ": the busy pointer stays");
  for (const QString& message : window_->messages().messages())
    campaign_.require(!message.startsWith("Unexpected"), (name + ": " + message).toStdString());
  if (window_->isVisible() && modeling::toJson(editor().project()) != before)
    checkProject(campaign_, editor());
  for (QWidget* other : QApplication::topLevelWidgets())
    if (other != window_.get() && other->isVisible()) other->close();
  for (const std::string& fault : faultsOf(folder_.toStdString(), filesSince))
    campaign_.fail(name.toStdString() + ": " + fault);
  for (const QString& file : QDir(folder_ + "/written").entryList(QDir::Files | QDir::Hidden))
    QFile::remove(folder_ + "/written/" + file);
  if (const std::chrono::duration<double> took = Clock::now() - since; took.count() > 10)
    log_(QString("  took %1 s").arg(took.count()));
  return isUsed && isDeep;
}

void Interrupter::attend() {
  // First of all: an answer may open another dialog, and returns when that is closed.
  QTimer::singleShot(kAttendEvery, &attendant_, [this] { attend(); });
  if (!isAttending_) {
    if (QWidget* dialog = QApplication::activeModalWidget()) attendUnexpected(*dialog);
    return;
  }
  if (QWidget* popup = QApplication::activePopupWidget()) {
    popup->close();
    return;
  }
  QWidget* dialog = QApplication::activeModalWidget();
  if (!dialog) return;
  if (dialog != dialog_) {
    dialog_ = dialog;
    dialogSince_ = Clock::now();
    tries_ = 0;
    log_("  " + nameOf(*dialog) + ": " + dialog->windowTitle());
    if (saveQuestion(*dialog)) isAsked_ = true;
    return;
  }
  const auto shown =
      std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - dialogSince_);
  if (shown.count() < (qobject_cast<QFileDialog*>(dialog) ? kFileDialogTime : kSettleTime)) return;
  if (!isInterrupted_ && answered_ == depth_) {
    ++counts_["dialogs interrupted"];
    return interrupt(dialog);
  }
  if (isInterrupted_) return leave(*dialog);
  goOn(*dialog);
}

/// Between two cases only progress may be shown. Any other dialog would wait for ever.
void Interrupter::attendUnexpected(QWidget& dialog) {
  if (qobject_cast<gui::ProgressDialog*>(&dialog) || &dialog == dialog_) return;
  dialog_ = &dialog;
  log_("  after the case: " + nameOf(dialog) + ": " + dialog.windowTitle());
  campaign_.fail(("a dialog comes after its case: " + nameOf(dialog)).toStdString());
  auto* question = saveQuestion(dialog);
  if (question)
    question->button(QMessageBox::Cancel)->click();
  else
    dialog.close();
}

void Interrupter::interrupt(QWidget* dialog) {
  isInterrupted_ = true;
  QWidget& at = dialog ? *dialog : *window_;
  switch (interruption_) {
    case Interruption::kEscape:
      return press(at, Qt::Key_Escape);
    case Interruption::kReturn:
      return press(at, Qt::Key_Return);
    case Interruption::kCloseDialog:
      if (dialog) dialog->close();
      return;
    case Interruption::kCloseWindow:
      // Undo may have led back to the saved state.
      if (!isReplaced_) isModified_ = editor().session().isModified();
      window_->close();
      return;
  }
}

/// Answers a dialog so that its work goes on.
void Interrupter::goOn(QWidget& dialog) {
  if (qobject_cast<gui::ProgressDialog*>(&dialog)) {
    if (Clock::now() - dialogSince_ < std::chrono::milliseconds(kMaxProgress)) return;
    isInterrupted_ = true;  // the work is as good as done
    return press(dialog, Qt::Key_Escape);
  }
  if (++tries_ > 3) {  // it needs input that it does not get here
    isInterrupted_ = true;
    return;
  }
  if (tries_ == 1) ++answered_;
  if (auto* files = qobject_cast<QFileDialog*>(&dialog)) return goOn(*files);
  if (auto* question = saveQuestion(dialog)) return question->button(QMessageBox::Discard)->click();
  if (QAbstractButton* button = acceptButton(dialog))
    button->click();
  else
    press(dialog, Qt::Key_Return);
}

void Interrupter::goOn(QFileDialog& dialog) {
  auto* name = dialog.findChild<QLineEdit*>("fileNameEdit");
  auto* buttons = dialog.findChild<QDialogButtonBox*>("buttonBox");
  const bool isSaving = dialog.acceptMode() == QFileDialog::AcceptSave;
  QPushButton* button = buttons->button(isSaving ? QDialogButtonBox::Save : QDialogButtonBox::Open);
  QString file = folder_ + "/written/new";
  if (!isSaving && dialog.fileMode() != QFileDialog::Directory) {
    const QStringList all = QDir(folder_).entryList(QDir::Files);
    file = folder_ + "/" + all[pick(random_, 0, static_cast<int>(all.size()) - 1)];
  } else if (!isSaving) {
    file = folder_ + "/written";
  }
  log_("    " + file);
  name->setText(file);
  button->click();
}

/// Gets rid of a dialog after the interruption.
void Interrupter::leave(QWidget& dialog) {
  ++tries_;
  const bool isProgress = qobject_cast<gui::ProgressDialog*>(&dialog) != nullptr;
  if (tries_ % 10 != 1) return;
  log_(QString("  leaves %1").arg(nameOf(dialog)));
  if (auto* question = saveQuestion(dialog); question && oneIn(random_, 2))
    return question->button(QMessageBox::Discard)->click();
  if (tries_ < kMaxTries || (isProgress && Clock::now() - dialogSince_ < std::chrono::minutes(1)))
    return press(dialog, Qt::Key_Escape);
  failure_ = "no way out of " + nameOf(dialog) + " with Escape";
  dialog.close();
  dialog.hide();
}

}  // namespace palpa::reliability
