#pragma once

#include <QDialog>
#include <QSpinBox>

namespace palpa::gui {

/// The size of a picture of the view, in pixels; the shape of the view is kept unless the person
/// lets it go.
class PictureDialog : public QDialog {
  Q_OBJECT

 public:
  explicit PictureDialog(const QSize& view, QWidget* parent);

  QSize pictureSize() const { return {width_->value(), height_->value()}; }

 private:
  QSpinBox* width_;
  QSpinBox* height_;
};

}  // namespace palpa::gui
