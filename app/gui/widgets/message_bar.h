#pragma once

#include <QStringList>
#include <QVBoxLayout>
#include <QWidget>
#include <deque>

namespace palpa::gui {

/// Messages over the top of another widget, at most three at a time; more wait until one goes.
/// Errors stay until they are closed, notes go after a while.
class MessageBar : public QWidget {
  Q_OBJECT

 public:
  static constexpr int kMaxMessages = 3;

  /// Lies over `under` and follows its size.
  explicit MessageBar(QWidget* under);

  void showError(const QString& text) { add({text, true}); }
  void showNote(const QString& text) { add({text, false}); }

  /// What is shown and what waits, oldest first.
  QStringList messages() const;
  /// Takes one away; nothing when it is not there (any more).
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
