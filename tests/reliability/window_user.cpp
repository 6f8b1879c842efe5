#include "tests/reliability/window_user.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDir>
#include <QDropEvent>
#include <QFileDialog>
#include <QLineEdit>
#include <QMenu>
#include <QMessageBox>
#include <QMimeData>
#include <QMouseEvent>
#include <QPushButton>
#include <QTabBar>
#include <QTest>
#include <QTimer>
#include <QWheelEvent>
#include <algorithm>
#include <array>

#include "app/gui/base/background_job.h"
#include "app/gui/widgets/quantity_edit.h"

namespace palpa::reliability {
namespace {

constexpr int kAttendEvery = 15;     // ms
constexpr int kMaxAnswers = 30;      // to one dialog; then it is closed
constexpr double kMemoryGiB = 0.25;  // of a model: fine meshes are refused, not built for minutes

template <class List>
auto& oneOf(Random& random, List& list) {
  return list[static_cast<std::size_t>(pick(random, 0, static_cast<int>(std::size(list)) - 1))];
}

QString nameOf(const QObject& object) {
  return QString("%1 %2").arg(object.metaObject()->className(), object.objectName());
}

bool isUsable(const QWidget& widget) {
  return widget.isVisible() && widget.isEnabled() &&
         (qobject_cast<const QAbstractButton*>(&widget) ||
          qobject_cast<const QAbstractSpinBox*>(&widget) ||
          qobject_cast<const QLineEdit*>(&widget) || qobject_cast<const QComboBox*>(&widget) ||
          qobject_cast<const QAbstractItemView*>(&widget) ||
          qobject_cast<const QAbstractSlider*>(&widget) || qobject_cast<const QTabBar*>(&widget));
}

}  // namespace

WindowUser::WindowUser(std::uint64_t seed, QString folder, std::function<void(const QString&)> log)
    : random_(seed), folder_(std::move(folder)), log_(std::move(log)) {
  openWindow();
  QTimer::singleShot(kAttendEvery, qApp, [this] { attend(); });
}

WindowUser::~WindowUser() = default;

void WindowUser::openWindow() {
  window_.reset();
  window_ = std::make_unique<gui::MainWindow>();
  window_->settings().setMemoryLimitGiB(kMemoryGiB);
  window_->settings().setAutosaveSeconds(5);
  window_->show();
  (void)QTest::qWaitForWindowExposed(window_.get());
  QApplication::setActiveWindow(window_.get());
  window_->begin({});
}

void WindowUser::note(const char* kind, const QString& what) {
  ++counts_[kind];
  log_(QString("%1 %2").arg(kind, what));
}

QPoint WindowUser::placeIn(const QWidget& widget) {
  // Mostly where the body is drawn.
  const double spread = oneIn(random_, 4) ? 0.5 : 0.22;
  return {static_cast<int>(widget.width() * (0.5 + pickReal(random_, -spread, spread))),
          static_cast<int>(widget.height() * (0.5 + pickReal(random_, -spread, spread)))};
}

Qt::KeyboardModifiers WindowUser::modifiers() {
  Qt::KeyboardModifiers chosen;
  if (oneIn(random_, 4)) chosen |= Qt::ShiftModifier;
  if (oneIn(random_, 4)) chosen |= Qt::ControlModifier;
  if (oneIn(random_, 12)) chosen |= Qt::AltModifier;
  return chosen;
}

QString WindowUser::number() {
  static const QStringList kOdd{"",    "0",   "-1",    "1e9",  "1e-300", "abc",  "-0.0001",
                                "0,5", "nan", "1e400", "3 mm", "0.7 N",  "12 in"};
  if (oneIn(random_, 4)) return oneOf(random_, kOdd);
  return QString::number(pickReal(random_, oneIn(random_, 3) ? -20 : 0, 30), 'g', 3);
}

QString WindowUser::file(bool isNew) {
  static const QStringList kEndings{"json", "step", "iges", "brep", "stl", "obj",
                                    "ply",  "csv",  "png",  "xyz",  ""};
  const QStringList all = QDir(folder_).entryList(QDir::Files);
  if (!isNew || (oneIn(random_, 3) && !all.isEmpty()))
    return folder_ + "/" + (all.isEmpty() ? "none.json" : oneOf(random_, all));
  return folder_ + QString("/new%1.%2").arg(files_++ % 40).arg(oneOf(random_, kEndings));
}

void WindowUser::act() {
  if (QApplication::activeModalWidget() || QApplication::activePopupWidget() ||
      gui::isBackgroundJobRunning())
    return;  // attend() is busy with it
  if (!window_->isVisible()) {
    note("restart");
    pressed_ = Qt::NoButton;
    openWindow();
    return;
  }
  if (!QApplication::activeWindow()) QApplication::setActiveWindow(window_.get());
  switch (pick(random_, 0, 39)) {
    case 0:
    case 1:
    case 2:
      return wheel();
    case 3:
    case 4:
    case 5:
    case 6:
    case 7:
      return key();
    case 8:
    case 9:
    case 10:
    case 11:
    case 12:
      return trigger();
    case 13:
    case 14:
    case 15:
    case 16:
      return useWidget(*window_);
    case 17:
      if (oneIn(random_, 5)) return dropFile();
      if (oneIn(random_, 2)) return search();
      return move();
    case 18:
      if (oneIn(random_, 5)) return resize();
      return move();
    case 19:
      if (oneIn(random_, 40)) {
        note("close");
        window_->close();
      }
      return;
    case 20:
    case 21:
    case 22:
    case 23:
    case 24:
      return press();
    case 25:
    case 26:
    case 27:
      return release();
    default:
      return move();
  }
}

void WindowUser::rest() {
  release();
  for (int i = 0; i < 4000; ++i) {
    const auto state = window_->editor().rebuildStatus().state;
    if (!QApplication::activeModalWidget() && !QApplication::activePopupWidget() &&
        !gui::isBackgroundJobRunning() && state != app::RebuildStatus::State::kBuilding)
      break;
    if (i == 3000) window_->editor().cancelRebuild();
    QTest::qWait(10);
  }
  if (!window_->isVisible()) openWindow();
}

void WindowUser::press() {
  if (pressed_ != Qt::NoButton) return move();
  constexpr std::array kButtons{Qt::LeftButton, Qt::LeftButton, Qt::LeftButton, Qt::RightButton,
                                Qt::MiddleButton};
  const Qt::MouseButton button = oneOf(random_, kButtons);
  pointer_ = placeIn(view());
  const Qt::KeyboardModifiers with = modifiers();
  if (oneIn(random_, 10)) {
    note("double click", QString("%1,%2").arg(pointer_.x()).arg(pointer_.y()));
    QTest::mouseDClick(&view(), button, with, pointer_);
    return;
  }
  pressed_ = button;
  note("press", QString("%1 at %2,%3 with %4")
                    .arg(button)
                    .arg(pointer_.x())
                    .arg(pointer_.y())
                    .arg(int(with)));
  QTest::mousePress(&view(), button, with, pointer_);
}

void WindowUser::move() {
  pointer_ = pressed_ == Qt::NoButton || oneIn(random_, 15)
                 ? placeIn(view())
                 : pointer_ + QPoint(pick(random_, -25, 25), pick(random_, -25, 25));
  note("move", QString("to %1,%2").arg(pointer_.x()).arg(pointer_.y()));
  QMouseEvent event(QEvent::MouseMove, pointer_, view().mapToGlobal(pointer_), Qt::NoButton,
                    pressed_, modifiers());
  QApplication::sendEvent(&view(), &event);
}

void WindowUser::release() {
  if (pressed_ == Qt::NoButton) return;
  note("release");
  const Qt::MouseButton button = std::exchange(pressed_, Qt::NoButton);
  QTest::mouseRelease(&view(), button, modifiers(), pointer_);
}

void WindowUser::wheel() {
  const QPoint at = placeIn(view());
  const int notches = pick(random_, 0, 1) ? 1 : -1;
  note("wheel", QString::number(notches));
  QWheelEvent event(at, view().mapToGlobal(at), {}, {0, 120 * notches}, pressed_, modifiers(),
                    Qt::NoScrollPhase, false);
  QApplication::sendEvent(&view(), &event);
}

void WindowUser::key() {
  constexpr std::array kKeys{Qt::Key_Escape, Qt::Key_Delete, Qt::Key_Return,   Qt::Key_Tab,
                             Qt::Key_Space,  Qt::Key_Up,     Qt::Key_Down,     Qt::Key_Left,
                             Qt::Key_Right,  Qt::Key_F2,     Qt::Key_Home,     Qt::Key_Plus,
                             Qt::Key_Minus,  Qt::Key_Period, Qt::Key_Backspace};
  const int letter = pick(random_, 0, 1) ? pick(random_, Qt::Key_A, Qt::Key_Z)
                                         : pick(random_, Qt::Key_0, Qt::Key_9);
  const auto key = oneIn(random_, 2) ? oneOf(random_, kKeys) : static_cast<Qt::Key>(letter);
  QWidget* target = window_->focusWidget();
  if (!target || oneIn(random_, 2)) target = &view();
  const Qt::KeyboardModifiers with = modifiers();
  note("key", QString("%1 with %2 to %3").arg(key).arg(int(with)).arg(nameOf(*target)));
  QTest::keyClick(target, key, with);
}

void WindowUser::trigger() {
  QList<QAction*> actions = window_->findChildren<QAction*>();
  actions.removeIf([](const QAction* action) {
    return !action->isEnabled() || action->isSeparator() || action->menu() ||
           action->objectName() == "Quit";
  });
  if (actions.isEmpty()) return;
  const QPointer<QAction> action = oneOf(random_, actions);
  note("action", action->objectName().isEmpty() ? action->text() : action->objectName());
  action->trigger();
}

void WindowUser::useWidget(QWidget& root) {
  QList<QWidget*> widgets = root.findChildren<QWidget*>();
  widgets.removeIf([](const QWidget* widget) { return !isUsable(*widget); });
  if (!widgets.isEmpty()) use(*oneOf(random_, widgets));
}

void WindowUser::use(QWidget& widget) {
  const QPointer<QWidget> guard(&widget);
  note("widget", nameOf(widget));
  if (auto* items = qobject_cast<QAbstractItemView*>(&widget)) return useItem(*items);
  if (auto* box = qobject_cast<QComboBox*>(&widget)) {
    QTest::keyClick(box, oneIn(random_, 2) ? Qt::Key_Up : Qt::Key_Down);
  } else if (auto* slider = qobject_cast<QAbstractSlider*>(&widget)) {
    slider->setValue(
        pick(random_, slider->minimum(), std::max(slider->minimum(), slider->maximum())));
  } else if (auto* tabs = qobject_cast<QTabBar*>(&widget)) {
    if (tabs->count() > 0) tabs->setCurrentIndex(pick(random_, 0, tabs->count() - 1));
  } else if (qobject_cast<QAbstractButton*>(&widget)) {
    QTest::mouseClick(&widget, Qt::LeftButton);
  } else {
    widget.setFocus();
    QTest::keyClick(&widget, Qt::Key_A, Qt::ControlModifier);
    const QString text = number();
    log_("  types \"" + text + "\"");
    for (const QChar c : text)
      if (guard) QTest::keyClick(guard, c.toLatin1());
    constexpr std::array kEnds{Qt::Key_Return, Qt::Key_Return, Qt::Key_Tab, Qt::Key_Escape};
    if (guard) QTest::keyClick(guard, oneOf(random_, kEnds));
  }
}

void WindowUser::useItem(QAbstractItemView& items) {
  const QAbstractItemModel* model = items.model();
  if (!model || model->rowCount() == 0) return;
  QModelIndex index = model->index(pick(random_, 0, model->rowCount() - 1), 0);
  while (model->rowCount(index) > 0 && !oneIn(random_, 3))
    index = model->index(pick(random_, 0, model->rowCount(index) - 1), 0, index);
  items.scrollTo(index);
  const QPointer<QAbstractItemView> guard(&items);
  const QPoint at = items.visualRect(index).center();
  QTest::mouseClick(items.viewport(), Qt::LeftButton, modifiers(), at);
  if (guard && oneIn(random_, 4)) QTest::mouseDClick(guard->viewport(), Qt::LeftButton, {}, at);
  constexpr std::array kKeys{Qt::Key_F2, Qt::Key_Delete, Qt::Key_Space, Qt::Key_Return,
                             Qt::Key_Down};
  if (guard && oneIn(random_, 3)) QTest::keyClick(guard, oneOf(random_, kKeys));
}

void WindowUser::dropFile() {
  const QString name = file(false);
  note("drop", name);
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(name)});
  QDropEvent event(QPointF(10, 10), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(window_.get(), &event);
}

void WindowUser::search() {
  using State = gui::ShapeFinder::State;
  gui::ShapeFinder& finder = window_->shapeFinder();
  const auto click = [&](const char* name) {
    auto* button = window_->findChild<QPushButton*>(name);
    if (!button || !button->isEnabled()) return;
    note("search", name);
    button->click();
  };
  if (finder.state() == State::kIdle) {
    const auto& design = window_->editor().project().design;
    if (!design || design->targets.empty() || oneIn(random_, 6)) click("addTarget");
    if (auto* value = window_->findChild<gui::QuantityEdit*>("targetValue")) {
      const QString wanted = QString::number(value->value() * pickReal(random_, 0.7, 1.4), 'g', 4);
      note("search", "wanted " + wanted);
      value->setFocus();
      value->selectAll();
      QTest::keyClicks(value, wanted);
      QTest::keyClick(value, Qt::Key_Return);
    }
    click("findShape");
  } else if (finder.state() == State::kSearching) {
    // Mostly it goes on, while other actions edit the project.
    if (oneIn(random_, 3)) click("searchStop");
  } else if (finder.state() == State::kFound) {
    click(oneIn(random_, 3) ? "searchDiscard" : "searchAccept");
  }
}

void WindowUser::resize() {
  const QSize size(pick(random_, 300, 1900), pick(random_, 200, 1180));
  note("resize", QString("%1 x %2").arg(size.width()).arg(size.height()));
  window_->resize(size);
}

void WindowUser::attend() {
  // First of all: what follows may bring up a dialog that needs answers, too.
  QTimer::singleShot(kAttendEvery, qApp, [this] { attend(); });
  if (QWidget* popup = QApplication::activePopupWidget())
    answerPopup(*popup);
  else if (QWidget* modal = QApplication::activeModalWidget())
    answer(*modal);
  else if (gui::isBackgroundJobRunning() && oneIn(random_, 100))
    gui::cancelBackgroundJob();
}

void WindowUser::answerPopup(QWidget& popup) {
  auto* menu = qobject_cast<QMenu*>(&popup);
  if (!menu || oneIn(random_, 3)) {
    note("popup closed");
    QTest::keyClick(&popup, oneIn(random_, 2) ? Qt::Key_Escape : Qt::Key_Return);
    if (QApplication::activePopupWidget() == &popup) popup.close();
    return;
  }
  QList<QAction*> actions = menu->actions();
  actions.removeIf([](const QAction* action) {
    return !action->isEnabled() || action->isSeparator() || action->menu();
  });
  if (actions.isEmpty()) {
    menu->close();
    return;
  }
  QAction* action = oneOf(random_, actions);
  note("popup", action->text());
  menu->setActiveAction(action);
  QTest::keyClick(menu, Qt::Key_Return);
}

void WindowUser::answer(QWidget& dialog) {
  answers_ = answered_ == &dialog ? answers_ + 1 : 0;
  answered_ = &dialog;
  if (auto* files = qobject_cast<QFileDialog*>(&dialog)) return answerFileDialog(*files);
  if (answers_ > kMaxAnswers || oneIn(random_, 10)) {
    note("dialog closed", nameOf(dialog));
    QTest::keyClick(&dialog, Qt::Key_Escape);
    return;
  }
  const QList<QDialogButtonBox*> boxes = dialog.findChildren<QDialogButtonBox*>();
  if (!boxes.isEmpty() && oneIn(random_, 5)) {
    QList<QAbstractButton*> buttons = boxes.front()->buttons();
    buttons.removeIf([](const QAbstractButton* button) { return !button->isEnabled(); });
    if (buttons.isEmpty()) return;
    QAbstractButton* button = oneOf(random_, buttons);
    note("answer", nameOf(dialog) + ": " + button->text());
    QTest::mouseClick(button, Qt::LeftButton);
    return;
  }
  useWidget(dialog);
}

void WindowUser::answerFileDialog(QFileDialog& dialog) {
  // Only names in the folder: nothing else of the dialog is touched.
  if (answers_ == 0) return;  // it proposes a name once it has read its folder
  auto* name = dialog.findChild<QLineEdit*>("fileNameEdit");
  auto* buttons = dialog.findChild<QDialogButtonBox*>("buttonBox");
  const bool isSaving = dialog.acceptMode() == QFileDialog::AcceptSave;
  QPushButton* button =
      buttons ? buttons->button(isSaving ? QDialogButtonBox::Save : QDialogButtonBox::Open)
              : nullptr;
  if (!name || !button || answers_ > 4 || oneIn(random_, 5)) {
    note("file dialog closed", dialog.windowTitle());
    dialog.reject();
    return;
  }
  const QString file = this->file(isSaving);
  note("file", dialog.windowTitle() + ": " + file);
  name->setText(file);
  QTest::mouseClick(button, Qt::LeftButton);
}

}  // namespace palpa::reliability
