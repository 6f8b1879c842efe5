#include "app/gui/dialogs/colour_range_dialog.h"

#include <QFormLayout>
#include <QPushButton>
#include <QVBoxLayout>

namespace palpa::gui {

ColourRangeDialog::ColourRangeDialog(Quantity quantity, const std::array<double, 2>& range,
                                     const Settings& settings, QWidget* parent)
    : QDialog(parent),
      low_(new NumberRow(quantity, settings, this)),
      high_(new NumberRow(quantity, settings, this)),
      buttons_(new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this)) {
  setWindowTitle(tr("Colour range"));
  auto* layout = new QVBoxLayout(this);
  auto* form = new QFormLayout;
  low_->setObjectName("lowestColour");
  high_->setObjectName("highestColour");
  low_->setValue(range[0]);
  high_->setValue(range[1]);
  form->addRow(tr("&Lowest:"), low_);
  form->addRow(tr("&Highest:"), high_);
  layout->addLayout(form);
  layout->addWidget(buttons_);
  connect(buttons_, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons_, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(low_, &NumberRow::changed, this, &ColourRangeDialog::check);
  connect(high_, &NumberRow::changed, this, &ColourRangeDialog::check);
  setMinimumWidth(280);
  low_->field().setFocus();
  low_->field().selectAll();
  check();
}

std::array<double, 2> ColourRangeDialog::range() const {
  return {low_->value().value_or(0), high_->value().value_or(1)};
}

void ColourRangeDialog::check() {
  const auto low = low_->value(), high = high_->value();
  const bool isReversed = low && high && !(*low < *high);
  high_->setProblem(isReversed ? tr("must be larger than the lowest value") : QString());
  buttons_->button(QDialogButtonBox::Ok)->setEnabled(low && high && !isReversed);
}

}  // namespace palpa::gui
