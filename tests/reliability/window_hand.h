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

/// Gives a window of the program random input, and dialogs random answers. Files that are named to
/// it lie in one folder. What it does is told to a log line by line, before it is done. With the
/// same seed it makes the same choices as long as the window answers in the same order.
class WindowHand {
 public:
  WindowHand(std::uint64_t seed, QString folder, std::function<void(const QString&)> log);
  ~WindowHand();

  gui::MainWindow& window() { return *window_; }
  Random& random() { return random_; }

  /// One action; returns when dialogs that it brought up are closed again.
  void act();
  /// Lets go of buttons, closes what is open, and waits until the rebuild has settled or stopped.
  void rest();
  /// How often what was done.
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
  void resize();

  // Dialogs and popups stop act() until they are closed; these run meanwhile, from timers.
  void attend();
  void answer(QWidget& dialog);
  void answerFileDialog(QFileDialog& dialog);
  void answerPopup(QWidget& popup);

  Random random_;
  const QString folder_;
  const std::function<void(const QString&)> log_;
  std::unique_ptr<gui::MainWindow> window_;
  Qt::MouseButton held_ = Qt::NoButton;
  QPoint pointer_;
  QPointer<QWidget> answered_;  // the dialog that was answered last
  int answers_ = 0;             // how often
  int files_ = 0;
  std::map<std::string, long> counts_;
};

}  // namespace palpa::reliability
