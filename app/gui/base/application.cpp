#include "app/gui/base/application.h"

#include <clocale>

#include "base/unexpected.h"

namespace palpa::gui {

Application::Application(int& argc, char** argv) : QApplication(argc, argv) {
  // Qt has set the user's locale; numbers have a point everywhere in the window, as QString has it.
  std::setlocale(LC_NUMERIC, "C");
  setUnexpectedHandler([this](const std::string& what) {
    const QString message =
        tr("Unexpected error: %1. The last action may not be complete; save the project under a "
           "new name and start Palpa again.")
            .arg(QString::fromStdString(what));
    // Later: the thread may be another one, and the slot that failed is still being left.
    QMetaObject::invokeMethod(
        this, [this, message] { Q_EMIT failed(message); }, Qt::QueuedConnection);
  });
}

Application::~Application() {
  setUnexpectedHandler({});
}

bool Application::notify(QObject* receiver, QEvent* event) {
  try {
    return QApplication::notify(receiver, event);
  } catch (...) {
    reportUnexpected();
    return false;
  }
}

}  // namespace palpa::gui
