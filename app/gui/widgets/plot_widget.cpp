#include "app/gui/widgets/plot_widget.h"

#include <QPainter>
#include <cmath>

#include "app/gui/appearance.h"

namespace palpa::gui {

PlotWidget::PlotWidget(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setMinimumHeight(120);
  if (canvas_.isValid()) plot_ = std::make_unique<view::ForcePlot>(canvas_.window());
}

PlotWidget::~PlotWidget() {
  canvas_.makeCurrent();
  plot_.reset();
}

void PlotWidget::setCurves(const std::vector<view::ForcePlot::Curve>& curves, double begin,
                           double end, const std::string& unit) {
  if (!plot_) return;
  canvas_.makeCurrent();
  plot_->setCurves(curves, begin, end, unit);
  update();
}

void PlotWidget::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (!plot_) {
    painter.fillRect(rect(), palette().window());
    return;
  }
  const double ratio = devicePixelRatioF();
  canvas_.makeCurrent();
  canvas_.resize({static_cast<int>(std::lround(width() * ratio)),
                  static_cast<int>(std::lround(height() * ratio))});
  plot_->setTheme(viewportTheme(currentTheme()));
  plot_->setPixelRatio(ratio);
  plot_->render();
  QImage image = canvas_.image();
  image.setDevicePixelRatio(ratio);
  painter.drawImage(0, 0, image);
}

}  // namespace palpa::gui
