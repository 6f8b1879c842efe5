#include "tests/gui/window_fixture.h"

#include <QAction>
#include <QApplication>
#include <QDialogButtonBox>
#include <QLineEdit>
#include <QMouseEvent>
#include <QPushButton>

#include "modeling/project/project_file.h"

namespace palpa::gui {

WindowTest::WindowTest() {
  static const QByteArray sharedCache = qgetenv("XDG_CACHE_HOME");
  qputenv("XDG_CACHE_HOME", sharedCache);
  qputenv("XDG_STATE_HOME", folder_.path().toUtf8());
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_.path());
  restart();
}

WindowTest::~WindowTest() = default;

void WindowTest::restart() {
  window_.reset();
  window_ = std::make_unique<MainWindow>();
  window_->show();
  EXPECT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
  // Without a window manager no window becomes active, and shortcuts need an active window.
  QApplication::setActiveWindow(window_.get());
}

void WindowTest::useEmptyCache() {
  qputenv("XDG_CACHE_HOME", folder_.path().toUtf8());
  restart();
}

void WindowTest::waitForModel() {
  ASSERT_TRUE(QTest::qWaitFor(
      [this] { return editor().rebuildStatus().state == app::RebuildStatus::State::kUpToDate; },
      60000))
      << editor().rebuildStatus().error;
  QTest::qWait(50);
}

std::string WindowTest::text() {
  return modeling::toJson(editor().project());
}

QAction* WindowTest::action(const QString& name) {
  auto* found = window_->findChild<QAction*>(name);
  if (!found) ADD_FAILURE() << "no action " << name.toStdString();
  return found;
}

QPoint WindowTest::pixelOf(const Eigen::Vector3d& place) {
  const Eigen::Vector2d pixel = view().viewport().toPixel(place) / view().devicePixelRatioF();
  return {static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y()))};
}

int WindowTest::visiblePoint() {
  for (int i = 0; i < static_cast<int>(editor().solid()->controlPoints().size()); ++i) {
    const QPoint at = pixelOfPoint(i);
    if (view().rect().adjusted(50, 50, -50, -50).contains(at) &&
        view().viewport().controlPointAt({at.x(), at.y()}) == i)
      return i;
  }
  return -1;
}

void WindowTest::moveTo(QPoint at, Qt::MouseButtons buttons, Qt::KeyboardModifiers modifiers) {
  QMouseEvent event(QEvent::MouseMove, at, view().mapToGlobal(at), Qt::NoButton, buttons,
                    modifiers);
  QApplication::sendEvent(&view(), &event);
}

void WindowTest::drag(QPoint from, QPoint to, Qt::KeyboardModifiers modifiers) {
  QTest::mousePress(&view(), Qt::LeftButton, modifiers, from);
  for (int i = 1; i <= 5; ++i) moveTo(from + (to - from) * i / 5, Qt::LeftButton, modifiers);
  QTest::mouseRelease(&view(), Qt::LeftButton, modifiers, to);
}

void WindowTest::chooseFile(QFileDialog& dialog, const QString& file) {
  auto* name = dialog.findChild<QLineEdit*>("fileNameEdit");
  auto* buttons = dialog.findChild<QDialogButtonBox*>("buttonBox");
  // The dialog proposes its file after reading the folder.
  QTest::qWait(300);
  name->setText(file);
  QTest::mouseClick(
      buttons->button(dialog.acceptMode() == QFileDialog::AcceptSave ? QDialogButtonBox::Save
                                                                     : QDialogButtonBox::Open),
      Qt::LeftButton);
}

void WindowTest::keepPicture(const QString& name, QWidget* of) {
  const QString folder = qEnvironmentVariable("PALPA_PICTURES");
  if (folder.isEmpty()) return;
  QTest::qWait(400);  // until the fine picture is drawn
  (of ? of : window_.get())->grab().save(folder + "/" + name + ".png");
}

}  // namespace palpa::gui
