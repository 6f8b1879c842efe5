#include "app/gui/widgets/quantity_edit.h"

#include <QKeyEvent>
#include <QStyle>
#include <QWheelEvent>
#include <cmath>

namespace palpa::gui {
namespace {

constexpr int kDigits = 10;    // shown; enough for any typed number
constexpr int kFewDigits = 5;  // where three fields share a line

}  // namespace

QuantityEdit::QuantityEdit(Quantity quantity, const Settings& settings, QWidget* parent)
    : QLineEdit(parent), quantity_(quantity), settings_(settings) {
  setAlignment(Qt::AlignRight);
  setMinimumWidth(72);
  connect(this, &QLineEdit::editingFinished, this, &QuantityEdit::commit);
  connect(&settings, &Settings::changed, this, &QuantityEdit::showValue);
  showValue();
}

void QuantityEdit::setValue(double value) {
  value_ = value;
  // A refresh must not overwrite unfinished input.
  if (!hasFocus() || !isModified()) showValue();
}

void QuantityEdit::setRange(double least, double most) {
  least_ = least;
  most_ = most;
}

void QuantityEdit::showValue() {
  const bool isShort = isNarrow_ && !hasFocus();
  const QString text = std::isnan(value_) ? QString()
                                          : shown(value_, quantity_, settings_.units(),
                                                  isShort ? kFewDigits : kDigits);
  if (text != this->text()) {
    setText(text);
    setCursorPosition(0);
  }
  setModified(false);
  setToolTip({});
  setRefused(false);
}

void QuantityEdit::commit() {
  if (!isModified()) return;
  if (isOptional_ && text().trimmed().isEmpty()) {
    accept(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  const auto value = parsed(text(), quantity_, settings_.units());
  if (!value) {
    refuse(tr("This is not a number"));
  } else if (!(*value >= least_)) {
    refuse(tr("At least %1").arg(shown(least_, quantity_, settings_.units())));
  } else if (!(*value <= most_)) {
    refuse(tr("At most %1").arg(shown(most_, quantity_, settings_.units())));
  } else {
    accept(*value);
  }
}

void QuantityEdit::accept(double value) {
  const bool differs = value != value_ && !(std::isnan(value) && std::isnan(value_));
  value_ = value;
  showValue();
  if (differs) Q_EMIT edited(value);
}

void QuantityEdit::refuse(const QString& why) {
  setToolTip(why);
  setRefused(true);
}

void QuantityEdit::setRefused(bool isRefused) {
  if (property("refused").toBool() == isRefused) return;
  setProperty("refused", isRefused);
  style()->polish(this);  // costs almost a millisecond, so only on a change
}

void QuantityEdit::setOptional(const QString& placeholder) {
  isOptional_ = true;
  setPlaceholderText(placeholder);
}

void QuantityEdit::stepBy(double steps) {
  if (std::isnan(value_)) return;
  const double factor = settings_.units().of(quantity_).factor;
  const double number = value_ / factor;
  const double step =
      step_ > 0
          ? step_ / factor
          : std::pow(10.0, number == 0.0 ? -1.0 : std::floor(std::log10(std::abs(number))) - 1);
  // Round to multiples of the step to keep the number of digits small.
  const double next = std::round((number + steps * step) / step) * step * factor;
  accept(std::clamp(next, least_, most_));
}

void QuantityEdit::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Up || event->key() == Qt::Key_Down) {
    commit();
    const double steps = event->key() == Qt::Key_Up ? 1 : -1;
    stepBy((event->modifiers() & Qt::ShiftModifier) != 0 ? 10 * steps : steps);
  } else {
    QLineEdit::keyPressEvent(event);
  }
}

void QuantityEdit::wheelEvent(QWheelEvent* event) {
  // Without focus the wheel scrolls the panel and must not change numbers.
  if (!hasFocus()) {
    event->ignore();
    return;
  }
  stepBy(event->angleDelta().y() > 0 ? 1 : -1);
  event->accept();
}

void QuantityEdit::setNarrow() {
  isNarrow_ = true;
  showValue();
}

void QuantityEdit::focusOutEvent(QFocusEvent* event) {
  QLineEdit::focusOutEvent(event);
  if (!isModified()) showValue();
}

void QuantityEdit::focusInEvent(QFocusEvent* event) {
  QLineEdit::focusInEvent(event);
  if (!isModified()) showValue();
  selectAll();
}

}  // namespace palpa::gui
