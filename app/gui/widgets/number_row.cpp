#include "app/gui/widgets/number_row.h"

#include <QVBoxLayout>

namespace palpa::gui {

NumberRow::NumberRow(Quantity quantity, const Settings& settings, QWidget* parent)
    : QWidget(parent),
      quantity_(quantity),
      settings_(settings),
      field_(new QuantityEdit(quantity, settings, this)),
      problem_(new QLabel(this)) {
  problem_->setWordWrap(true);
  problem_->setObjectName("refusal");
  problem_->hide();
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  column->addWidget(field_);
  column->addWidget(problem_);
  setFocusProxy(field_);
  connect(field_, &QLineEdit::textChanged, this, [this] {
    problemOfOwner_.clear();
    showProblem();
    Q_EMIT changed();
  });
}

void NumberRow::setRange(double least, double most) {
  least_ = least;
  most_ = most;
  field_->setRange(least, most);
  showProblem();
}

void NumberRow::setValue(double value) {
  field_->setModified(false);
  field_->setValue(value);
}

std::optional<double> NumberRow::value() const {
  if (isEmpty() || !isValid()) return std::nullopt;
  // A field that was not edited keeps all digits of its value.
  if (!field_->isModified()) return field_->value();
  return parsed(field_->text(), quantity_, settings_.units());
}

void NumberRow::setOptional(const QString& placeholder) {
  field_->setOptional(placeholder);
  showProblem();
}

void NumberRow::clear() {
  setValue(std::numeric_limits<double>::quiet_NaN());
}

bool NumberRow::isEmpty() const {
  return field_->isOptional() && field_->text().trimmed().isEmpty();
}

QString NumberRow::ownProblem() const {
  if (isEmpty()) return {};
  const auto value = field_->isModified() ? parsed(field_->text(), quantity_, settings_.units())
                                          : std::optional(field_->value());
  if (!value) return tr("This is not a number");
  if (*value < least_ || *value > most_)
    return tr("Expected %1 … %2")
        .arg(shown(least_, quantity_, settings_.units()),
             shown(most_, quantity_, settings_.units()));
  return {};
}

void NumberRow::setProblem(const QString& problem) {
  problemOfOwner_ = problem;
  showProblem();
}

void NumberRow::showProblem() {
  const QString own = ownProblem();
  const QString& problem = own.isEmpty() ? problemOfOwner_ : own;
  problem_->setText(problem);
  problem_->setVisible(!problem.isEmpty());
  field_->setAccessibleDescription(problem);
}

}  // namespace palpa::gui
