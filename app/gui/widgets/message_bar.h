#pragma once

#include <QStringList>
#include <QVBoxLayout>
#include <QWidget>
#include <deque>

namespace palpa::gui {

/// Messages over the top of another widget, at most kMaxMessages; further ones wait until one is
/// removed. Errors stay until the user closes them, notes disappear after some seconds.
class MessageBar : public QWidget {
  Q_OBJECT

 public:
  static constexpr int kMaxMessages = 3;

  /// Covers the top of `under` and follows its size.
  explicit MessageBar(QWidget* under);

  void showError(const QString& text) { add({text, true}); }
  void showNote(const QString& text) { add({text, false}); }

  /// Shown and waiting messages, oldest first.
  QStringList messages() const;
  /// Removes a message; does nothing if it is absent.
  void withdraw(const QString& text);
  void clear();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  bool event(QEvent* event) override;

 private:
  struct Message {
    QString text;
    bool isError = false;
  };
  void add(Message message);
  void showNext();
  QWidget* makeRow(const Message& message);
  void leaveLater(QWidget* row);
  void remove(QWidget* row);
  void place();

  QVBoxLayout* rows_;
  std::deque<Message> waiting_;
};

}  // namespace palpa::gui
