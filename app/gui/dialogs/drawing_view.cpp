#include "app/gui/dialogs/drawing_view.h"

#include <QLineF>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>

#include "modeling/shapes/profile_sketch.h"

namespace palpa::gui {

using Eigen::Vector2d;

DrawingView::DrawingView(QWidget* parent) : QWidget(parent) {
  setObjectName("drawing");
  setAccessibleName(tr("Drawing"));
  setMinimumSize(340, 300);
}

void DrawingView::setPaths(const std::vector<modeling::DrawnPath>& paths) {
  constexpr int kPerPiece = 8;
  lines_.clear();
  bool any = false;
  for (const modeling::DrawnPath& path : paths) {
    QPolygonF& line = lines_.emplace_back();
    const auto add = [&](const Vector2d& p) {
      line << QPointF(p.x(), p.y());
      low_ = any ? Vector2d(low_.cwiseMin(p)) : p;
      high_ = any ? Vector2d(high_.cwiseMax(p)) : p;
      any = true;
    };
    add(path.start());
    for (const modeling::DrawnPiece& piece : path.pieces)
      for (int k = piece.isStraight ? kPerPiece : 1; k <= kPerPiece; ++k)
        add(piece.at(static_cast<double>(k) / kPerPiece));
  }
  setChosen(-1, std::nullopt);
}

void DrawingView::setChosen(int path, const std::optional<modeling::ProfileCurve>& fitted) {
  chosen_ = path;
  fitted_.clear();
  if (fitted)
    for (const modeling::SketchPlace& place : modeling::ProfileSketch(*fitted).samples())
      fitted_ << QPointF(place.at.x(), place.at.y());
  update();
}

QPointF DrawingView::pixelOf(const Vector2d& at) const {
  const Vector2d extent = (high_ - low_).cwiseMax(1e-9);
  const double scale = 0.88 * std::min(width() / extent.x(), height() / extent.y());
  const Vector2d offset = scale * (at - 0.5 * (low_ + high_));
  return {0.5 * width() + offset.x(), 0.5 * height() - offset.y()};
}

void DrawingView::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  painter.setRenderHint(QPainter::Antialiasing);
  QColor faint = palette().color(QPalette::Text);
  faint.setAlphaF(0.4F);
  const auto draw = [&](const QPolygonF& line) {
    QPolygonF pixels;
    for (const QPointF& p : line) pixels << pixelOf({p.x(), p.y()});
    painter.drawPolyline(pixels);
  };
  for (int i = 0; i < static_cast<int>(lines_.size()); ++i) {
    painter.setPen(QPen(faint, i == chosen_ ? 5 : 1.3));
    draw(lines_[static_cast<std::size_t>(i)]);
  }
  painter.setPen(QPen(palette().color(QPalette::Highlight), 2));
  draw(fitted_);
}

void DrawingView::mousePressEvent(QMouseEvent* event) {
  constexpr double kReach = 12.0;
  double best = kReach;
  int nearest = -1;
  for (std::size_t i = 0; i < lines_.size(); ++i)
    for (qsizetype k = 1; k < lines_[i].size(); ++k) {
      const QPointF a = pixelOf({lines_[i][k - 1].x(), lines_[i][k - 1].y()});
      const QPointF b = pixelOf({lines_[i][k].x(), lines_[i][k].y()});
      const QPointF along = b - a, to = event->position() - a;
      const double length = QPointF::dotProduct(along, along);
      const double t =
          length > 0 ? std::clamp(QPointF::dotProduct(along, to) / length, 0.0, 1.0) : 0.0;
      const double distance = QLineF(event->position(), a + t * along).length();
      if (distance >= best) continue;
      best = distance;
      nearest = static_cast<int>(i);
    }
  if (nearest >= 0) Q_EMIT picked(nearest);
}

}  // namespace palpa::gui
