#pragma once

#include <QApplication>

namespace palpa::gui {

/// The application of the window: an exception that escapes from a slot, an event handler or a
/// thread of the libraries becomes the signal `failed` instead of the end of the program.
class Application : public QApplication {
  Q_OBJECT

 public:
  /// References as QApplication takes them.
  Application(int& argc, char** argv);
  ~Application() override;

  bool notify(QObject* receiver, QEvent* event) override;

 Q_SIGNALS:
  /// `message`: a sentence for the user.
  void failed(const QString& message);
};

}  // namespace palpa::gui
