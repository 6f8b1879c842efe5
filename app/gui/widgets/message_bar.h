#pragma once

#include <QStringList>
#include <QVBoxLayout>
#include <QWidget>
#include <deque>
#include <functional>
#include <vector>

namespace palpa::gui {

/// Messages over the top of another widget, at most kMaxMessages; further ones wait until one is
/// removed. Errors stay until the user closes them, notes disappear after some seconds.
class MessageBar : public QWidget {
  Q_OBJECT

 public:
  static constexpr int kMaxMessages = 3;

  /// Covers the top of `under` and follows its size, except for `keptFree` px at the right.
  explicit MessageBar(QWidget* under, int keptFree = 0);

  /// A button below a message. It removes the message.
  struct Action {
    QString text, tip;
    std::function<void()> perform;
  };
  void showError(const QString& text, std::vector<Action> actions = {}) {
    add({text, true, std::move(actions)});
  }
  void showNote(const QString& text) { add({text, false}); }

  /// Shown and waiting messages, oldest first.
  QStringList messages() const;
  bool hasErrors() const;
  /// Removes a message; does nothing if it is absent.
  void withdraw(const QString& text);
  void clear();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  bool event(QEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  struct Message {
    QString text;
    bool isError = false;
    std::vector<Action> actions{};
  };
  void add(Message message);
  void showNext();
  QWidget* makeRow(const Message& message);
  void addActions(const std::vector<Action>& actions, QWidget* row, QVBoxLayout& under);
  void leaveLater(QWidget* row);
  void remove(QWidget* row);
  void place();
  static void drawPicture(const QWidget& row);

  const int keptFree_;
  QVBoxLayout* rows_;
  std::deque<Message> waiting_;
};

}  // namespace palpa::gui
