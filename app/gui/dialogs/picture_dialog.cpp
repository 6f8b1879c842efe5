#include "app/gui/dialogs/picture_dialog.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QPushButton>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>

namespace palpa::gui {

PictureDialog::PictureDialog(const QSize& view, QWidget* parent)
    : QDialog(parent), width_(new QSpinBox(this)), height_(new QSpinBox(this)) {
  setObjectName("picture");
  setWindowTitle(tr("Save picture"));
  for (QSpinBox* field : {width_, height_}) {
    field->setRange(64, 8192);
    field->setSuffix(tr(" pixels"));
    field->setAccelerated(true);
  }
  width_->setObjectName("width");
  height_->setObjectName("height");
  width_->setValue(2 * view.width());
  height_->setValue(2 * view.height());
  auto* keep = new QCheckBox(tr("&Keep the shape of the view"), this);
  keep->setObjectName("keep");
  keep->setChecked(true);
  const auto follow = [keep](QSpinBox* from, QSpinBox* to, double ratio) {
    connect(from, &QSpinBox::valueChanged, to, [keep, to, ratio](int value) {
      if (!keep->isChecked()) return;
      const QSignalBlocker block(to);
      to->setValue(static_cast<int>(std::lround(value * ratio)));
    });
  };
  const double ratio = static_cast<double>(view.height()) / std::max(1, view.width());
  follow(width_, height_, ratio);
  follow(height_, width_, 1.0 / ratio);
  auto* form = new QFormLayout(this);
  form->addRow(tr("&Width:"), width_);
  form->addRow(tr("&Height:"), height_);
  form->addRow(keep);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  buttons->button(QDialogButtonBox::Ok)->setText(tr("Choose &file …"));
  form->addRow(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
}

}  // namespace palpa::gui
