#include "modeling/exchange/drawn_spline.h"

#include <Geom2dConvert_BSplineCurveToBezierCurve.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_BezierCurve.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "modeling/error.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;

Vector2d vectorOf(const gp_XY& p) {
  return {p.X(), p.Y()};
}

void check(const DrawnSpline& spline) {
  const std::size_t count = spline.points.size();
  const std::size_t order = static_cast<std::size_t>(spline.degree) + 1;
  if (count < order || count > DrawnSpline::kMaxPoints)
    throw ModelingError(std::to_string(count) + " control points; degree " +
                        std::to_string(spline.degree) + " needs " + std::to_string(order) + " … " +
                        std::to_string(DrawnSpline::kMaxPoints));
  if (spline.knots.size() != count + order)
    throw ModelingError(std::to_string(spline.knots.size()) + " knots, but " +
                        std::to_string(count) + " points of degree " +
                        std::to_string(spline.degree) + " need " + std::to_string(count + order));
  if (!spline.weights.empty() && spline.weights.size() != count)
    throw ModelingError(std::to_string(spline.weights.size()) + " weights for " +
                        std::to_string(count) + " control points");
  for (double weight : spline.weights)
    if (!(weight > 0.0)) throw ModelingError("the weights of a spline must be > 0");
  if (!std::is_sorted(spline.knots.begin(), spline.knots.end()) ||
      !(spline.knots[spline.degree] < spline.knots[count]))
    throw ModelingError("the knots of a spline must ascend");
}

Handle(Geom2d_BSplineCurve) curveOf(const DrawnSpline& spline) {
  const int count = static_cast<int>(spline.points.size());
  std::vector<double> distinct;
  std::vector<int> times;
  const double range = spline.knots.back() - spline.knots.front();
  for (double knot : spline.knots) {
    if (distinct.empty() || knot - distinct.back() > 1e-10 * range) {
      distinct.push_back(knot);
      times.push_back(0);
    }
    ++times.back();
  }
  TColgp_Array1OfPnt2d poles(1, count);
  TColStd_Array1OfReal weights(1, count);
  for (int i = 1; i <= count; ++i) {
    poles.SetValue(i, gp_Pnt2d(spline.points[i - 1].x(), spline.points[i - 1].y()));
    weights.SetValue(i, spline.weights.empty() ? 1.0 : spline.weights[i - 1]);
  }
  TColStd_Array1OfReal knots(1, static_cast<int>(distinct.size()));
  TColStd_Array1OfInteger multiplicities(1, knots.Length());
  for (int i = 1; i <= knots.Length(); ++i) {
    knots.SetValue(i, distinct[i - 1]);
    multiplicities.SetValue(i, times[i - 1]);
  }
  Handle(Geom2d_BSplineCurve) curve =
      new Geom2d_BSplineCurve(poles, weights, knots, multiplicities, spline.degree);
  curve->Segment(curve->FirstParameter(), curve->LastParameter());
  return curve;
}

/// Adds a curve that is no cubic polynomial by cubics with its tangents at their ends.
void addApproximated(DrawingBuilder& builder, const Geom2d_BezierCurve& curve, double from,
                     double to, double tolerance, int depth) {
  constexpr int kMaxDepth = 10;
  const auto tangentAt = [&](double t) {
    gp_Pnt2d p;
    gp_Vec2d d;
    curve.D1(t, p, d);
    return vectorOf(d.XY());
  };
  const Vector2d a = vectorOf(curve.Value(from).XY()), b = vectorOf(curve.Value(to).XY());
  const double third = (to - from) / 3.0;
  const DrawnPiece piece{{a, a + third * tangentAt(from), b - third * tangentAt(to), b}, false};
  double error = 0.0;
  for (const double t : {0.25, 0.5, 0.75})
    error =
        std::max(error, (piece.at(t) - vectorOf(curve.Value(from + t * (to - from)).XY())).norm());
  if (error > tolerance && depth < kMaxDepth) {
    const double middle = 0.5 * (from + to);
    addApproximated(builder, curve, from, middle, tolerance, depth + 1);
    addApproximated(builder, curve, middle, to, tolerance, depth + 1);
    return;
  }
  builder.cubicTo(piece.points[1], piece.points[2], piece.points[3]);
}

}  // namespace

void addSpline(DrawingBuilder& builder, const DrawnSpline& spline, const Job& job) {
  check(spline);
  Vector2d low = spline.points.front(), high = low;
  for (const Vector2d& p : spline.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  try {
    Geom2dConvert_BSplineCurveToBezierCurve pieces(curveOf(spline));
    for (int i = 1; i <= pieces.NbArcs(); ++i) {
      job.throwIfCancelled();
      const Handle(Geom2d_BezierCurve) piece = pieces.Arc(i);
      const Vector2d start = vectorOf(piece->StartPoint().XY());
      if (i == 1) builder.moveTo(start);
      if (piece->IsRational() || piece->Degree() > 3) {
        addApproximated(builder, *piece, 0.0, 1.0, kArcError * (high - low).maxCoeff(), 0);
        continue;
      }
      if (piece->Degree() == 1) {
        builder.lineTo(vectorOf(piece->EndPoint().XY()));
        continue;
      }
      piece->Increase(3);
      builder.cubicTo(vectorOf(piece->Pole(2).XY()), vectorOf(piece->Pole(3).XY()),
                      vectorOf(piece->Pole(4).XY()));
    }
  } catch (const Standard_Failure& failure) {
    throw ModelingError(std::string("the spline cannot be evaluated (") +
                        failure.GetMessageString() + ")");
  }
}

}  // namespace palpa::modeling
