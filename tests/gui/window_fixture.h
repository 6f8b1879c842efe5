#pragma once

#include <gtest/gtest.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QFileDialog>
#include <QPointer>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <functional>
#include <memory>
#include <string>

#include "app/gui/window/main_window.h"

namespace palpa::gui {

/// The window on a display, with settings and snapshots in a temporary folder. Models that
/// another test stored are read, not computed again.
class WindowTest : public testing::Test {
 protected:
  static inline const QString kSphere = PALPA_PROJECTS "/sphere.json";

  WindowTest();
  ~WindowTest() override;

  /// A new window, as after a restart of the program.
  void restart();

  /// A new window that finds no stored models and stores them in `folder_`.
  void useEmptyCache();

  /// Waits until the model belongs to the newest edit.
  void waitForModel();

  ViewportWidget& view() { return window_->viewport(); }
  Editor& editor() { return window_->editor(); }
  /// The project as it would be saved.
  std::string text();
  /// The action of a menu by its text without "&" and "…"; fails when there is none.
  QAction* action(const QString& name);
  /// The visible widget of type T with an object name; null when there is none.
  template <class T>
  T* find(const QString& name) {
    return window_->findChild<T*>(name);
  }

  /// Position in logical pixels of the view.
  QPoint pixelOf(const Eigen::Vector3d& place);
  QPoint pixelOfPoint(int point) { return pixelOf(editor().solid()->controlPoints()[point]); }
  /// A control point that is visible and pickable at its drawn position.
  int visiblePoint();

  void moveTo(QPoint at, Qt::MouseButtons buttons = Qt::NoButton,
              Qt::KeyboardModifiers modifiers = Qt::NoModifier);
  void drag(QPoint from, QPoint to, Qt::KeyboardModifiers modifiers = Qt::NoModifier);

  /// Enters a file name into a file dialog as a whole (typing would change the folder) and accepts.
  static void chooseFile(QFileDialog& dialog, const QString& file);

  /// Writes a picture of the window or a dialog to the folder named by PALPA_PICTURES, if set, for
  /// inspection.
  void keepPicture(const QString& name, QWidget* of = nullptr);

  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;
};

/// Runs `act` on the modal dialog of type T opened by `open`. Fails if no dialog opens, if `act`
/// leaves it open, or if another dialog stays open for half a minute; then closes the dialogs, so
/// that `open` returns.
template <class T>
void withDialog(const std::function<void()>& open, const std::function<void(T&)>& act) {
  constexpr int kPatience = 30000;  // ms; a busy machine reads a file in 10 s
  const QPointer<QWidget> active = QApplication::activeWindow();
  bool isDone = false;
  QTimer poll;
  QElapsedTimer waited;
  waited.start();
  QObject::connect(&poll, &QTimer::timeout, [&] {
    QWidget* modal = QApplication::activeModalWidget();
    auto* dialog = qobject_cast<T*>(modal);
    if (dialog && dialog->isVisible() && !isDone) {
      isDone = true;
      const QPointer<T> guard(dialog);
      act(*dialog);
      if (guard && guard->isVisible()) {
        ADD_FAILURE() << "the dialog is still open: " << guard->windowTitle().toStdString();
        guard->close();
      }
      waited.restart();
    } else if (waited.elapsed() > kPatience && modal) {
      ADD_FAILURE() << "nobody closed the " << modal->metaObject()->className() << " \""
                    << modal->windowTitle().toStdString() << '"';
      modal->close();
      waited.restart();
    }
  });
  poll.start(20);
  open();
  EXPECT_TRUE(isDone) << "no dialog came up";
  if (active) QApplication::setActiveWindow(active);  // there is no window manager to do it
}

}  // namespace palpa::gui
