#include "modeling/exchange/profile_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/shapes/opencascade_curve.h"
#include "modeling/shapes/profile.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kMaxPieces = 4096;

/// Piece with its curve after smoothing.
struct Piece {
  DrawnPiece drawn;
  DrawnPiece smooth;
};

enum class Joint { kCorner, kTangent };

Vector2d directionAt(const DrawnPiece& piece, bool atEnd) {
  const auto& p = piece.points;
  const Vector2d origin = atEnd ? p[3] : p[0];
  double size = 0.0;
  for (const Vector2d& q : p) size = std::max(size, (q - origin).norm());
  for (int k = 1; k < 4; ++k) {
    const Vector2d along = p[atEnd ? 3 - k : k] - origin;
    if (along.norm() > 1e-9 * size) return (atEnd ? -1.0 : 1.0) * along.normalized();
  }
  return Vector2d::Zero();
}

double angleBetween(const Vector2d& a, const Vector2d& b) {
  return std::atan2(std::abs(a.x() * b.y() - a.y() * b.x()), a.dot(b));
}

/// Pieces without those too short to matter; each begins where the one before ends.
std::vector<Piece> piecesOf(const DrawnPath& path, double tolerance) {
  const auto [low, high] = boxOf(path);
  const double size = (high - low).maxCoeff();
  const double shortest = std::clamp(0.25 * tolerance, 1e-6 * size, 1e-4 * size);
  std::vector<Piece> pieces;
  for (const DrawnPiece& piece : path.pieces) {
    double extent = 0.0;
    for (const Vector2d& p : piece.points) extent = std::max(extent, (p - piece.points[0]).norm());
    if (extent <= shortest) continue;
    pieces.push_back({piece, piece});
    if (pieces.size() > 1)
      pieces.back().smooth.points[0] = pieces[pieces.size() - 2].smooth.points[3];
  }
  if (pieces.empty()) throw ModelingError("the loop has no length");
  if (path.closed) pieces.back().smooth.points[3] = pieces.front().smooth.points[0];
  for (Piece& piece : pieces)
    if (piece.smooth.isStraight) {
      auto& p = piece.smooth.points;
      p[1] = p[0] + (p[3] - p[0]) / 3.0;
      p[2] = p[3] - (p[3] - p[0]) / 3.0;
    }
  return pieces;
}

/// Gives straight lines that turn a little common tangents where they meet.
void smoothBends(std::vector<Piece>& pieces, bool closed, double angle) {
  const std::size_t count = pieces.size();
  std::vector<DrawnPiece> bent(count);
  for (std::size_t i = 0; i < count; ++i) bent[i] = pieces[i].smooth;
  for (std::size_t i = closed ? 0 : 1; i < count; ++i) {
    const std::size_t before = (i + count - 1) % count;
    const DrawnPiece &a = pieces[before].smooth, &b = pieces[i].smooth;
    if (before == i || !a.isStraight || !b.isStraight) continue;
    const Vector2d in = a.points[3] - a.points[0], out = b.points[3] - b.points[0];
    const double turn = angleBetween(in, out);
    if (turn >= angle || turn < 1e-9) continue;
    // Tangent of the circle through the three points.
    const Vector2d tangent =
        (in.normalized() * out.norm() + out.normalized() * in.norm()).normalized();
    bent[before].points[2] = a.points[3] - in.norm() / 3.0 * tangent;
    bent[i].points[1] = b.points[0] + out.norm() / 3.0 * tangent;
    bent[before].isStraight = bent[i].isStraight = false;
  }
  for (std::size_t i = 0; i < count; ++i) pieces[i].smooth = bent[i];
}

Joint jointBefore(const std::vector<Piece>& pieces, std::size_t i) {
  const std::size_t before = (i + pieces.size() - 1) % pieces.size();
  const double turn =
      angleBetween(directionAt(pieces[before].smooth, true), directionAt(pieces[i].smooth, false));
  return turn > kSmoothAngle ? Joint::kCorner : Joint::kTangent;
}

ProfileCurve polylineOf(const std::vector<Piece>& pieces, bool closed) {
  // Points in the middle of a straight line are left out.
  std::vector<Vector2d> points;
  for (const Piece& piece : pieces) points.push_back(piece.smooth.points[0]);
  points.push_back(pieces.back().smooth.points[3]);
  std::vector<Vector2d> kept{points.front()};
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    if (angleBetween(points[i] - kept.back(), points[i + 1] - points[i]) > 1e-7)
      kept.push_back(points[i]);
  kept.push_back(closed ? kept.front() : points.back());
  ProfileCurve curve;
  curve.degree = 1;
  curve.knots.push_back(0.0);
  for (std::size_t i = 0; i < kept.size(); ++i) curve.knots.push_back(static_cast<double>(i));
  curve.knots.push_back(static_cast<double>(kept.size() - 1));
  curve.points = std::move(kept);
  return curve;
}

/// Cubic spline that equals the pieces, and the knots where they begin and end.
struct Chain {
  ProfileCurve curve;
  std::vector<double> ends;            ///< pieces + 1 knots
  std::vector<int> leastMultiplicity;  ///< per inner end
};

double polygonLength(const DrawnPiece& piece) {
  const auto& p = piece.points;
  return (p[1] - p[0]).norm() + (p[2] - p[1]).norm() + (p[3] - p[2]).norm();
}

Chain chainOf(const std::vector<Piece>& pieces) {
  constexpr double kMaxRatio = 1e3;  // between neighbouring spans
  double length = 0.0;
  for (const Piece& piece : pieces) length += polygonLength(piece.smooth);
  const double shortest = 1e-5 * length;  // a profile refuses smaller differences between knots
  Chain chain;
  chain.curve.knots.assign(4, 0.0);
  chain.curve.points.push_back(pieces.front().smooth.points[0]);
  chain.ends.push_back(0.0);
  double span = 0.0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto& p = pieces[i].smooth.points;
    const double first = (p[1] - p[0]).norm();
    const double chord = std::max(shortest, polygonLength(pieces[i].smooth));
    double fresh = chord;
    if (i > 0) {
      // Equal derivatives on both sides allow a double knot, without the point between them.
      const auto& q = pieces[i - 1].smooth.points;
      const double last = (q[3] - q[2]).norm();
      bool isTangent =
          jointBefore(pieces, i) == Joint::kTangent && last > 1e-6 * chord && first > 1e-6 * chord;
      const double matched = isTangent ? span * first / last : chord;
      isTangent = isTangent && matched < kMaxRatio * chord && kMaxRatio * matched > chord &&
                  matched >= shortest;
      fresh = isTangent ? matched : chord;
      if (isTangent) chain.curve.points.pop_back();
      const bool isLine = pieces[i].smooth.isStraight || pieces[i - 1].smooth.isStraight;
      chain.leastMultiplicity.push_back(!isTangent ? 3 : isLine ? 2 : 0);
      chain.curve.knots.insert(chain.curve.knots.end(), isTangent ? 2 : 3, chain.ends.back());
    }
    chain.curve.points.insert(chain.curve.points.end(), p.begin() + 1, p.end());
    span = fresh;
    chain.ends.push_back(chain.ends.back() + span);
  }
  chain.curve.knots.insert(chain.curve.knots.end(), 4, chain.ends.back());
  return chain;
}

double distanceToLine(const DrawnPiece& line, const Vector2d& p) {
  const Vector2d along = line.points[3] - line.points[0];
  const double t = std::clamp(along.dot(p - line.points[0]) / along.squaredNorm(), 0.0, 1.0);
  return (line.points[0] + t * along - p).norm();
}

constexpr int kSamples = 12;  // per piece, for distances

/// Largest distance of the curve from the pieces first … last - 1. Equal parameters are compared,
/// since removing knots nearly keeps the parameter, so that the distance is overestimated.
double deviationOf(const Geom2d_BSplineCurve& curve, const std::vector<Piece>& pieces,
                   const Chain& chain, std::size_t first, std::size_t last) {
  double largest = 0.0;
  for (std::size_t i = first; i < last; ++i)
    for (int k = 0; k <= kSamples; ++k) {
      const double t = static_cast<double>(k) / kSamples;
      const gp_Pnt2d point = curve.Value(chain.ends[i] + t * (chain.ends[i + 1] - chain.ends[i]));
      largest = std::max(largest, (pieces[i].smooth.at(t) - Vector2d(point.X(), point.Y())).norm());
    }
  return largest;
}

/// Largest distance of the curve from the drawn pieces, which smoothing changed.
double deviationFromDrawing(const Geom2d_BSplineCurve& curve, const std::vector<Piece>& pieces,
                            const Chain& chain) {
  double largest = 0.0;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (int k = 0; k <= kSamples; ++k) {
      const double t = static_cast<double>(k) / kSamples;
      const gp_Pnt2d point = curve.Value(chain.ends[i] + t * (chain.ends[i + 1] - chain.ends[i]));
      const Vector2d p(point.X(), point.Y());
      const DrawnPiece& drawn = pieces[i].drawn;
      largest =
          std::max(largest, drawn.isStraight ? distanceToLine(drawn, p) : (drawn.at(t) - p).norm());
    }
  return largest;
}

/// Removes knots while the curve stays within the tolerance of the pieces, the cheap ones first.
Handle(Geom2d_BSplineCurve)
    withFewKnots(Handle(Geom2d_BSplineCurve) curve, const std::vector<Piece>& pieces,
                 const Chain& chain, double tolerance, const Job& job) {
  constexpr int kReach = 4;  // knots to both sides, between which a removal changes the curve
  const auto pieceAt = [&](double knot) {
    const auto at = std::upper_bound(chain.ends.begin(), chain.ends.end(), knot);
    const std::ptrdiff_t index = at - chain.ends.begin() - 1;
    return static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(index, 0, static_cast<std::ptrdiff_t>(pieces.size()) - 1));
  };
  for (const double share : {1e-6, 1.0 / 16.0, 1.0 / 4.0, 1.0})
    for (int i = 2; i < curve->NbKnots();) {
      job.throwIfCancelled();
      const int times = curve->Multiplicity(i);
      const double knot = curve->Knot(i);
      const auto end = std::lower_bound(chain.ends.begin(), chain.ends.end(), knot);
      const auto inner = static_cast<std::size_t>(end - chain.ends.begin()) - 1;
      if (times <= chain.leastMultiplicity[inner]) {
        ++i;
        continue;
      }
      const double from = curve->Knot(std::max(1, i - kReach));
      const double to = curve->Knot(std::min(curve->NbKnots(), i + kReach));
      const Handle(Geom2d_BSplineCurve) fewer =
          Handle(Geom2d_BSplineCurve)::DownCast(curve->Copy());
      const bool isRemoved = fewer->RemoveKnot(i, times - 1, 1e3 * tolerance);
      if (isRemoved &&
          deviationOf(*fewer, pieces, chain, pieceAt(from), pieceAt(to) + 1) <= share * tolerance)
        curve = fewer;  // a knot that disappeared gives its number to the next
      else
        ++i;
    }
  return curve;
}

void checkCount(std::size_t count, double tolerance) {
  if (count <= Profile::kMaxPoints) return;
  throw ModelingError("the loop needs " + std::to_string(count) +
                          " control points to stay within " + roundedText(tolerance) +
                          " mm of the drawing, and at most " + std::to_string(Profile::kMaxPoints) +
                          " are possible; allow a larger tolerance, smooth the bends of polylines, "
                          "or simplify the loop",
                      ModelingError::Kind::kTooLarge);
}

}  // namespace

std::array<Vector2d, 2> boxOf(const DrawnPath& path) {
  std::array<Vector2d, 2> box{path.start(), path.start()};
  for (const DrawnPiece& piece : path.pieces)
    for (const Vector2d& p : piece.points) {
      box[0] = box[0].cwiseMin(p);
      box[1] = box[1].cwiseMax(p);
    }
  return box;
}

FittedProfile fitProfile(const DrawnPath& path, const FitOptions& options, const Job& job) {
  std::vector<Piece> pieces = piecesOf(path, options.tolerance);
  if (pieces.size() > kMaxPieces)
    throw ModelingError("the loop has " + std::to_string(pieces.size()) +
                            " lines and curves; at most " + std::to_string(kMaxPieces) +
                            " are possible; simplify it",
                        ModelingError::Kind::kTooLarge);
  if (options.smoothBelow > 0.0) smoothBends(pieces, path.closed, options.smoothBelow);
  if (std::all_of(pieces.begin(), pieces.end(),
                  [](const Piece& piece) { return piece.smooth.isStraight; })) {
    FittedProfile result{polylineOf(pieces, path.closed), 0.0};
    checkCount(result.curve.points.size(), options.tolerance);
    return result;
  }
  // A closed curve begins at a corner, so that no other point needs the seam.
  if (path.closed)
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (jointBefore(pieces, i) == Joint::kCorner) {
        std::rotate(pieces.begin(), pieces.begin() + static_cast<std::ptrdiff_t>(i), pieces.end());
        break;
      }
  const Chain chain = chainOf(pieces);
  const Handle(Geom2d_BSplineCurve) curve =
      withFewKnots(makeCurve(chain.curve), pieces, chain, options.tolerance, job);
  FittedProfile result{toProfileCurve(*curve), deviationFromDrawing(*curve, pieces, chain)};
  checkCount(result.curve.points.size(), options.tolerance);
  if (path.closed) result.curve.points.back() = result.curve.points.front();
  return result;
}

}  // namespace palpa::modeling
