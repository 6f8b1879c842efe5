#pragma once

#include <QWidget>
#include <memory>

#include "app/gui/base/canvas.h"
#include "app/view/charts/force_plot.h"

namespace palpa::gui {

/// Widget with a ForcePlot in the colours of the theme.
class PlotWidget : public QWidget {
  Q_OBJECT

 public:
  explicit PlotWidget(QWidget* parent = nullptr);
  ~PlotWidget() override;

  /// Text shown while there are no curves.
  void setPlaceholder(const QString& words);
  /// As the functions of ForcePlot.
  void setHorizontalTitle(const QString& title);
  void setFitted(bool isFitted);
  void setCounting(bool isCounting);
  void setLegendShown(bool shown);
  /// As ForcePlot::setCurves(). Curves with fewer than two points are not drawn.
  void setCurves(const std::vector<view::ForcePlot::Curve>& curves, double begin, double end,
                 const std::string& unit);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  Canvas canvas_;
  std::unique_ptr<view::ForcePlot> plot_;
  QString placeholder_;
  bool hasCurves_ = false;
};

}  // namespace palpa::gui
