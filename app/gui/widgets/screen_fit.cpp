#include "app/gui/widgets/screen_fit.h"

#include <QDialog>
#include <QEvent>
#include <QScreen>

namespace palpa::gui {
namespace {

constexpr QSize kFrame{8, 40};  // px: frame and title bar of a window, approximately

}  // namespace

bool ScreenFit::eventFilter(QObject* watched, QEvent* event) {
  // Polish comes before the dialog is placed and shown.
  auto* dialog = event->type() == QEvent::Polish ? qobject_cast<QDialog*>(watched) : nullptr;
  if (dialog && dialog->isWindow()) {
    const QSize most = dialog->screen()->availableSize() - kFrame;
    const QSize size = dialog->size();
    if (size.width() > most.width() || size.height() > most.height())
      dialog->resize(size.boundedTo(most));
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace palpa::gui
