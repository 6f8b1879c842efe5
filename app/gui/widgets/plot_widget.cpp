#include "app/gui/widgets/plot_widget.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "app/gui/base/appearance.h"

namespace palpa::gui {
namespace {

constexpr int kSpare = 16;  // pixels around the text

}  // namespace

PlotWidget::PlotWidget(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setMinimumHeight(96);
  if (canvas_.isValid()) plot_ = std::make_unique<view::ForcePlot>(canvas_.window());
}

PlotWidget::~PlotWidget() {
  canvas_.makeCurrent();
  plot_.reset();
}

void PlotWidget::setPlaceholder(const QString& words) {
  placeholder_ = words;
  setAccessibleDescription(words);
  update();
}

void PlotWidget::setHorizontalTitle(const QString& title) {
  if (plot_) plot_->setHorizontalTitle(title.toStdString());
}

void PlotWidget::setFitted(bool isFitted) {
  if (plot_) plot_->setFitted(isFitted);
}

void PlotWidget::setCounting(bool isCounting) {
  if (plot_) plot_->setCounting(isCounting);
}

void PlotWidget::setLegendShown(bool shown) {
  if (plot_) plot_->setLegendShown(shown);
}

void PlotWidget::setCurves(const std::vector<view::ForcePlot::Curve>& curves, double begin,
                           double end, const std::string& unit) {
  if (!plot_) return;
  hasCurves_ = std::any_of(curves.begin(), curves.end(),
                           [](const auto& curve) { return curve.times.size() > 1; });
  canvas_.makeCurrent();
  plot_->setCurves(curves, begin, end, unit);
  update();
}

void PlotWidget::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (!plot_ || !hasCurves_) {
    painter.fillRect(rect(), palette().window());
    painter.setPen(palette().color(QPalette::PlaceholderText));
    painter.drawText(rect().adjusted(kSpare, kSpare, -kSpare, -kSpare),
                     Qt::AlignCenter | Qt::TextWordWrap,
                     plot_ ? placeholder_ : tr("Curves cannot be drawn without OpenGL 3.2."));
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
