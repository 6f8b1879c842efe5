#pragma once

#include <QPointer>
#include <QString>
#include <QStringList>
#include <functional>
#include <map>
#include <memory>

#include "app/gui/window/main_window.h"
#include "tests/reliability/campaign.h"

class QAbstractItemView;
class QFileDialog;

namespace palpa::reliability {

/// Sends random input to a window of the program, and random answers to dialogs. All files lie in
/// one folder. Each action is logged in one line before it is performed. With the same seed the
/// choices are the same, as long as the window responds in the same order.
class WindowUser {
 public:
  WindowUser(std::uint64_t seed, QString folder, std::function<void(const QString&)> log);
  ~WindowUser();

  gui::MainWindow& window() { return *window_; }
  Random& random() { return random_; }

  /// Performs one action; returns when the dialogs that it opened are closed.
  void act();
  /// Releases buttons, closes dialogs, and waits until the rebuild has settled or stopped.
  void rest();
  /// Number of actions of each kind.
  const std::map<std::string, long>& counts() const { return counts_; }

 private:
  void openWindow();
  void note(const char* kind, const QString& what = {});
  gui::ViewportWidget& view() { return window_->viewport(); }
  QPoint placeIn(const QWidget& widget);
  Qt::KeyboardModifiers modifiers();
  QString number();
  QString file(bool isNew);

  void press();
  void move();
  void release();
  void wheel();
  void key();
  void trigger();
  void useWidget(QWidget& root);
  void use(QWidget& widget);
  void useItem(QAbstractItemView& items);
  void dropFile();
  /// Begins, stops, accepts or discards a search for a shape.
  void search();
  void resize();

  // Dialogs and popups block act() until they are closed; timers call these functions meanwhile.
  void attend();
  void answer(QWidget& dialog);
  void answerFileDialog(QFileDialog& dialog);
  void answerPopup(QWidget& popup);

  Random random_;
  const QString folder_;
  const std::function<void(const QString&)> log_;
  std::unique_ptr<gui::MainWindow> window_;
  Qt::MouseButton pressed_ = Qt::NoButton;
  QPoint pointer_;
  QPointer<QWidget> answered_;  // the dialog that was answered last
  int answers_ = 0;             // number of its answers
  int files_ = 0;
  std::map<std::string, long> counts_;
};

}  // namespace palpa::reliability
