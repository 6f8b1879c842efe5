#pragma once

#include <QWidget>
#include <memory>

#include "app/gui/base/canvas.h"
#include "app/view/force_plot.h"

namespace palpa::gui {

/// A ForcePlot as a widget, in the colours of the theme.
class PlotWidget : public QWidget {
  Q_OBJECT

 public:
  explicit PlotWidget(QWidget* parent = nullptr);
  ~PlotWidget() override;

  /// Words that stand there as long as there are no curves.
  void setPlaceholder(const QString& words);
  /// ForcePlot::setCurves(). Curves of fewer than two points are none.
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
