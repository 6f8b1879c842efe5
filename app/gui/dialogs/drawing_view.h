#pragma once

#include <QPolygonF>
#include <QWidget>
#include <optional>
#include <vector>

#include "modeling/exchange/drawing.h"
#include "modeling/shapes/primitive.h"

namespace palpa::gui {

/// The paths of a drawing, one of which is chosen.
class DrawingView : public QWidget {
  Q_OBJECT

 public:
  explicit DrawingView(QWidget* parent);

  void setPaths(const std::vector<modeling::DrawnPath>& paths);
  void setChosen(int path, const std::optional<modeling::ProfileCurve>& fitted);

 Q_SIGNALS:
  void picked(int path);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;

 private:
  QPointF pixelOf(const Eigen::Vector2d& at) const;

  std::vector<QPolygonF> lines_;  // mm
  QPolygonF fitted_;
  int chosen_ = -1;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero(), high_ = Eigen::Vector2d::Zero();
};

}  // namespace palpa::gui
