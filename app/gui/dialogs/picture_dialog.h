#pragma once

#include <QDialog>
#include <QSpinBox>

namespace palpa::gui {

/// Size of a picture of the view, in pixels. Keeps the aspect ratio of the view unless unchecked.
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
