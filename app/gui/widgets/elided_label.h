#pragma once

#include <QLabel>

namespace palpa::gui {

/// Line of text that becomes shorter, with "…", where the window is narrow; then the tool tip shows
/// all of it.
class ElidedLabel : public QLabel {
  Q_OBJECT

 public:
  using QLabel::QLabel;

  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;
};

}  // namespace palpa::gui
