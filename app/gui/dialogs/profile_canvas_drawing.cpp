// Drawing of ProfileCanvas.
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "app/gui/base/appearance.h"
#include "app/gui/dialogs/profile_canvas.h"

namespace palpa::gui {
namespace {

using Eigen::Vector2d;
using modeling::ProfileSketch;
using modeling::SketchPointKind;

constexpr int kMajor = 10;      // grid lines from one with a number to the next, or 5
constexpr double kPoint = 4.0;  // half the size of a point, pixels
constexpr int kRuler = 18;      // pixels

/// Colours beside the palette of the application.
struct SketchColours {
  QColor minor, major, axis, curve, fill, net, problem, other, ground;
};

QColor faded(QColor colour, double alpha) {
  colour.setAlphaF(static_cast<float>(alpha));
  return colour;
}

SketchColours coloursOf(const QPalette& palette) {
  const QColor text = palette.color(QPalette::Text);
  const QColor accent = palette.color(QPalette::Highlight);
  const QColor problem = currentTheme() == Theme::kDark ? "#ff8a75" : "#b93a21";
  return {faded(text, 0.06),
          faded(text, 0.14),
          faded(text, 0.55),
          accent,
          faded(accent, 0.12),
          faded(text, 0.35),
          problem,
          faded(text, 0.30),
          palette.color(QPalette::Base)};
}

}  // namespace

QPolygonF ProfileCanvas::polygonOf(const ProfileSketch& sketch) const {
  QPolygonF polygon;
  for (const modeling::SketchPlace& place : sketch.samples()) polygon << pixelOf(place.at);
  return polygon;
}

QString ProfileCanvas::numberText(double value) const {
  const double number = value / settings_.units().of(Quantity::kLength).factor;
  return QString::number(std::abs(number) < 1e-12 ? 0.0 : number, 'g', 6);
}

void ProfileCanvas::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  drawGrid(painter);
  painter.setRenderHint(QPainter::Antialiasing);
  drawAxes(painter);
  drawOtherSections(painter);
  drawCurve(painter);
  drawPending(painter);
  drawPoints(painter);
  drawProblem(painter);
  drawRulers(painter);
  if (drag_ == Drag::kBox && pointer_) {
    painter.setPen(QPen(palette().color(QPalette::Highlight), 1, Qt::DashLine));
    painter.setBrush(coloursOf(palette()).fill);
    painter.drawRect(QRectF(pressed_, *pointer_).normalized());
  }
  if (hasFocus()) {
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.setPen(palette().color(QPalette::Highlight));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(rect().adjusted(0, 0, -1, -1));
  }
}

void ProfileCanvas::drawGrid(QPainter& painter) const {
  const SketchColours colours = coloursOf(palette());
  const double step = gridStep();
  const Vector2d low = placeOf(QPointF(0, height())), high = placeOf(QPointF(width(), 0));
  for (int axis : {0, 1}) {
    const auto first = static_cast<long long>(std::ceil(low[axis] / step));
    const auto last = static_cast<long long>(std::floor(high[axis] / step));
    for (long long i = first; i <= last; ++i) {
      painter.setPen(i % kMajor == 0 ? colours.major : colours.minor);
      const double at = static_cast<double>(i) * step;
      if (axis == 0) {
        const double x = pixelOf({at, 0.0}).x();
        painter.drawLine(QPointF(x, 0), QPointF(x, height()));
      } else {
        const double y = pixelOf({0.0, at}).y();
        painter.drawLine(QPointF(0, y), QPointF(width(), y));
      }
    }
  }
}

void ProfileCanvas::drawAxes(QPainter& painter) const {
  const SketchColours colours = coloursOf(palette());
  const QPointF origin = pixelOf(Vector2d::Zero());
  painter.setPen(QPen(colours.axis, 1));
  painter.drawLine(QPointF(0, origin.y()), QPointF(width(), origin.y()));
  if (editor_.use() != modeling::SketchUse::kRevolve) {
    painter.drawLine(QPointF(origin.x(), 0), QPointF(origin.x(), height()));
    return;
  }
  // The other side of the axis is no place for the profile; its image shows the body.
  painter.fillRect(QRectF(0, 0, origin.x(), height()), QBrush(colours.minor, Qt::BDiagPattern));
  QPolygonF image = polygonOf(editor_.sketch());
  for (QPointF& p : image) p.setX(2.0 * origin.x() - p.x());
  painter.setPen(QPen(colours.other, 1.2, Qt::DashLine));
  painter.drawPolyline(image);
  painter.setPen(QPen(colours.axis, 2, Qt::DashDotLine));
  painter.drawLine(QPointF(origin.x(), 0), QPointF(origin.x(), height()));
  painter.save();
  painter.translate(origin.x() - 5, height() - kRuler - 10);
  painter.rotate(-90);
  painter.setPen(palette().color(QPalette::Text));
  painter.drawText(QPointF(0, 0), tr("axis of revolution"));
  painter.restore();
}

void ProfileCanvas::drawOtherSections(QPainter& painter) const {
  const SketchColours colours = coloursOf(palette());
  const auto& sections = editor_.sections();
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (static_cast<int>(i) == editor_.sectionIndex()) continue;
    painter.setPen(QPen(colours.other, 1.2));
    painter.setBrush(Qt::NoBrush);
    painter.drawPolyline(polygonOf(sections[i].profile));
  }
}

void ProfileCanvas::drawCurve(QPainter& painter) const {
  const SketchColours colours = coloursOf(palette());
  const ProfileSketch& sketch = editor_.sketch();
  if (sketch.pointCount() == 0) {
    painter.setPen(palette().color(QPalette::PlaceholderText));
    painter.drawText(rect().adjusted(40, 40, -40, -40), Qt::AlignCenter | Qt::TextWordWrap,
                     tr("Click points to draw a curve. Click the first point to close it; Enter "
                        "ends an open one."));
    return;
  }
  const auto& problem = editor_.problem();
  const bool isBad = problem && problem->section == editor_.sectionIndex() && !isDrawn();
  // Control polygon
  QPolygonF net;
  for (const modeling::SketchPoint& point : sketch.points()) net << pixelOf(point.at);
  if (sketch.isClosed()) net << net.front();
  const bool hasControl =
      std::any_of(sketch.points().begin(), sketch.points().end(),
                  [](const auto& point) { return point.kind == SketchPointKind::kControl; });
  const QPolygonF curve = polygonOf(sketch);
  if (sketch.isClosed()) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(isBad ? faded(colours.problem, 0.08) : colours.fill);
    painter.drawPolygon(curve);
  } else if (editor_.use() == modeling::SketchUse::kRevolve && !curve.isEmpty()) {
    // The body lies between the curve and the axis.
    QPolygonF body = curve;
    const double axis = pixelOf(Vector2d::Zero()).x();
    body.prepend({axis, body.front().y()});
    body.append({axis, body.back().y()});
    painter.setPen(QPen(colours.net, 1, Qt::DotLine));
    painter.drawLine(body[0], body[1]);
    painter.drawLine(body[body.size() - 2], body.back());
    painter.setPen(Qt::NoPen);
    painter.setBrush(isBad ? faded(colours.problem, 0.08) : colours.fill);
    painter.drawPolygon(body);
  }
  if (hasControl && sketch.pointCount() > 2) {
    painter.setPen(QPen(colours.net, 1, Qt::DashLine));
    painter.setBrush(Qt::NoBrush);
    painter.drawPolyline(net);
  }
  painter.setPen(QPen(isBad ? colours.problem : colours.curve, 2.2));
  painter.setBrush(Qt::NoBrush);
  painter.drawPolyline(curve);
  const bool mustClose = editor_.use() != modeling::SketchUse::kRevolve;
  if (mustClose && !sketch.isClosed() && curve.size() > 2 && mode_ == Mode::kSelect) {
    painter.setPen(QPen(colours.problem, 1.4, Qt::DotLine));
    painter.drawLine(curve.front(), curve.back());
  }
}

void ProfileCanvas::drawPending(QPainter& painter) const {
  if (mode_ != Mode::kDraw || !target_) return;
  const SketchColours colours = coloursOf(palette());
  const ProfileSketch& sketch = editor_.sketch();
  const QPointF at = pixelOf(target_->at);
  for (int axis : {0, 1}) {
    if (!target_->toLine[axis]) continue;
    painter.setPen(QPen(faded(colours.curve, 0.6), 1, Qt::DotLine));
    if (axis == 0)
      painter.drawLine(QPointF(at.x(), 0), QPointF(at.x(), height()));
    else
      painter.drawLine(QPointF(0, at.y()), QPointF(width(), at.y()));
  }
  if (!sketch.isClosed() && sketch.pointCount() > 0) {
    const QPointF first = pixelOf(sketch.points().front().at);
    const bool closes =
        sketch.pointCount() >= 3 && pointer_ && QLineF(*pointer_, first).length() <= 9.0;
    ProfileSketch next = sketch;
    if (closes)
      next.close();
    else if (next.points().back().at != target_->at)
      next.append(target_->at, SketchPointKind::kControl);
    painter.setPen(QPen(faded(colours.curve, 0.6), 1.6, Qt::DashLine));
    painter.drawPolyline(polygonOf(next));
    if (closes) {
      painter.setPen(QPen(colours.curve, 2));
      painter.setBrush(Qt::NoBrush);
      painter.drawEllipse(first, 9, 9);
      return;
    }
  }
  painter.setPen(QPen(colours.curve, 1.5));
  painter.setBrush(Qt::NoBrush);
  painter.drawEllipse(at, 4, 4);
}

void ProfileCanvas::drawPoints(QPainter& painter) const {
  const SketchColours colours = coloursOf(palette());
  const ProfileSketch& sketch = editor_.sketch();
  for (int i = 0; i < sketch.pointCount(); ++i) {
    const bool selected = editor_.isSelected(i);
    const double size = kPoint + (i == hovered_ ? 1.5 : 0.0) + (selected ? 1.0 : 0.0);
    const QPointF at = pixelOf(sketch.points()[i].at);
    painter.setPen(QPen(selected ? palette().color(QPalette::Text) : colours.curve, 1.5));
    painter.setBrush(selected ? colours.curve : colours.ground);
    const bool isEnd = !sketch.isClosed() && (i == 0 || i + 1 == sketch.pointCount());
    const SketchPointKind kind = isEnd ? SketchPointKind::kCorner : sketch.points()[i].kind;
    if (kind == SketchPointKind::kCorner) {
      painter.drawRect(QRectF(at.x() - size, at.y() - size, 2 * size, 2 * size));
    } else if (kind == SketchPointKind::kSmooth) {
      const double d = 1.35 * size;
      painter.drawPolygon(QPolygonF({QPointF(at.x() - d, at.y()), QPointF(at.x(), at.y() - d),
                                     QPointF(at.x() + d, at.y()), QPointF(at.x(), at.y() + d)}));
    } else {
      painter.drawEllipse(at, size, size);
    }
  }
}

void ProfileCanvas::drawProblem(QPainter& painter) const {
  const auto& problem = editor_.problem();
  if (!problem || problem->section != editor_.sectionIndex() || !problem->location) return;
  if (isDrawn()) return;
  const QColor colour = coloursOf(palette()).problem;
  const QPointF at = pixelOf(*problem->location);
  painter.setPen(QPen(colour, 2.5));
  painter.setBrush(faded(colour, 0.18));
  painter.drawEllipse(at, 12, 12);
  painter.drawLine(at - QPointF(5, 5), at + QPointF(5, 5));
  painter.drawLine(at - QPointF(5, -5), at + QPointF(5, -5));
}

void ProfileCanvas::drawRulers(QPainter& painter) const {
  painter.setRenderHint(QPainter::Antialiasing, false);
  QFont small = font();
  small.setPointSizeF(0.85 * small.pointSizeF());
  painter.setFont(small);
  const QFontMetrics metrics(small);
  const QColor ground = faded(palette().color(QPalette::Window), 0.92);
  const QRect bottom(0, height() - kRuler, width(), kRuler);
  int widest = 0;
  const double step = gridStep() * kMajor;
  const Vector2d low = placeOf(QPointF(0, height())), high = placeOf(QPointF(width(), 0));
  const auto first = [&](int axis) { return std::ceil(low[axis] / step); };
  for (double i = first(1); i * step <= high.y(); ++i)
    widest = std::max(widest, metrics.horizontalAdvance(numberText(i * step)));
  const QRect left(0, 0, widest + 8, height());
  painter.fillRect(bottom, ground);
  painter.fillRect(left.adjusted(0, 0, 0, -kRuler), ground);
  painter.setPen(palette().color(QPalette::PlaceholderText));
  for (double i = first(0); i * step <= high.x(); ++i) {
    const double x = pixelOf({i * step, 0.0}).x();
    const QString text = numberText(i * step);
    const int half = metrics.horizontalAdvance(text) / 2;
    if (x - half < left.right() + 34 || x + half > width() - 4) continue;
    painter.drawLine(QPointF(x, bottom.top()), QPointF(x, bottom.top() + 4));
    painter.drawText(QPointF(x - half, height() - 4), text);
  }
  for (double i = first(1); i * step <= high.y(); ++i) {
    const double y = pixelOf({0.0, i * step}).y();
    if (y < 20 || y > height() - kRuler - 8) continue;
    painter.drawLine(QPointF(left.right() - 4, y), QPointF(left.right(), y));
    const QString text = numberText(i * step);
    painter.drawText(QPointF(left.right() - 5 - metrics.horizontalAdvance(text), y + 4), text);
  }
  // Unit, and the names of the coordinates
  const bool isRevolve = editor_.use() == modeling::SketchUse::kRevolve;
  painter.setPen(palette().color(QPalette::Text));
  painter.drawText(QPointF(5, height() - 4), settings_.units().of(Quantity::kLength).symbol);
  painter.drawText(QPointF(width() - 14, height() - kRuler - 5), isRevolve ? "r" : "x");
  painter.drawText(QPointF(left.right() + 6, 14), isRevolve ? "z" : "y");
}

}  // namespace palpa::gui
