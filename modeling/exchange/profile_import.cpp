#include "modeling/exchange/profile_import.h"

#include <algorithm>
#include <set>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/exchange/drawn_spline.h"
#include "modeling/exchange/text_cursor.h"
#include "modeling/project/atomic_write.h"

namespace palpa::modeling {

using Eigen::Vector2d;

namespace {

constexpr std::size_t kMaxListed = 8;

std::string quoted(const std::string& name) {
  return "\"" + name + "\"";
}

std::string listOf(const std::vector<DrawnPath>& paths) {
  std::string list;
  for (std::size_t i = 0; i < std::min(paths.size(), kMaxListed); ++i)
    list += (i == 0 ? " " : "; ") + std::to_string(i + 1) + ": " + describePath(paths[i]);
  if (paths.size() > kMaxListed)
    list += "; and " + std::to_string(paths.size() - kMaxListed) + " smaller ones";
  return list;
}

}  // namespace

ProfileDrawing readProfileDrawing(const std::filesystem::path& path, const std::string& layer,
                                  double tolerance, const Job& job) {
  Drawing drawing = readDrawing(path, job);
  ProfileDrawing result;
  result.source = path.string();
  result.skipped = std::move(drawing.skipped);
  result.unit = drawing.unit;
  std::set<std::string> layers;
  for (const DrawnPath& each : drawing.paths)
    if (!each.layer.empty()) layers.insert(each.layer);
  result.layers.assign(layers.begin(), layers.end());
  if (!layer.empty())
    std::erase_if(drawing.paths, [&](const DrawnPath& each) { return each.layer != layer; });
  if (drawing.paths.empty()) {
    std::string names;
    for (const std::string& name : result.layers)
      names += (names.empty() ? "" : ", ") + quoted(name);
    throw ModelingError(result.source + ": there is no line or curve on the layer " +
                        quoted(layer) + (names.empty() ? "" : "; the layers are " + names));
  }
  Vector2d low = drawing.paths.front().start(), high = low;
  for (const DrawnPath& each : drawing.paths)
    for (const Vector2d& corner : boxOf(each)) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  constexpr double kShare = 1e-4, kMinTolerance = 1e-6;
  result.tolerance =
      std::max(tolerance > 0.0 ? tolerance : kShare * (high - low).maxCoeff(), kMinTolerance);
  result.paths = joinedPaths(std::move(drawing.paths), result.tolerance, job);
  return result;
}

std::string describePath(const DrawnPath& path) {
  const auto [low, high] = boxOf(path);
  std::string text = path.closed ? "closed, " : "open, ";
  text += roundedText(high.x() - low.x()) + " × " + roundedText(high.y() - low.y()) + " mm";
  if (!path.layer.empty()) text += ", layer " + excerpt(path.layer);
  return text + ", " + path.origin;
}

std::size_t onlyPath(const ProfileDrawing& drawing, bool mustBeClosed) {
  const auto isPossible = [&](const DrawnPath& path) { return path.closed || !mustBeClosed; };
  const auto count = std::count_if(drawing.paths.begin(), drawing.paths.end(), isPossible);
  if (count == 1)
    return static_cast<std::size_t>(
        std::find_if(drawing.paths.begin(), drawing.paths.end(), isPossible) -
        drawing.paths.begin());
  if (count > 1)
    throw ModelingError(drawing.source + ": the drawing has " + std::to_string(count) +
                        (mustBeClosed ? " closed loops" : " curves") +
                        "; choose one by its number or its layer:" + listOf(drawing.paths));
  throw ModelingError(drawing.source +
                      ": the drawing has no closed loop; ends are joined where two of them are "
                      "within " +
                      roundedText(drawing.tolerance) + " mm:" + listOf(drawing.paths));
}

FittedProfile fitPath(const ProfileDrawing& drawing, std::size_t path, const FitOptions& options,
                      const Job& job) {
  if (path >= drawing.paths.size())
    throw ModelingError(drawing.source + ": there is no curve number " + std::to_string(path + 1) +
                        "; the drawing has " + std::to_string(drawing.paths.size()) + ":" +
                        listOf(drawing.paths));
  try {
    return fitProfile(drawing.paths[path], options, job);
  } catch (const ModelingError& error) {
    throw ModelingError(drawing.source + ": " + drawing.paths[path].origin + ": " + error.what(),
                        error.kind());
  }
}

std::string toSvg(const ProfileCurve& curve) {
  DrawingBuilder builder;
  builder.begin("profile", {}, Eigen::Affine2d::Identity());
  addSpline(builder, {curve.degree, curve.knots, curve.points, {}}, {});
  const DrawnPath path = builder.take().at(0);
  const auto [low, high] = boxOf(path);
  const double margin = 0.05 * (high - low).maxCoeff();
  // The corner of the page is the origin, so that reading the file gives the same coordinates.
  const Vector2d size = high.cwiseMax(Vector2d::Zero()) + Vector2d::Constant(margin);
  const auto place = [](const Vector2d& p) {
    return roundedText(p.x(), 12) + "," + roundedText(0.0 - p.y(), 12);
  };
  std::string data = "M " + place(path.start());
  for (const DrawnPiece& piece : path.pieces)
    data += piece.isStraight ? " L " + place(piece.points[3])
                             : " C " + place(piece.points[1]) + " " + place(piece.points[2]) + " " +
                                   place(piece.points[3]);
  if (path.closed) data += " Z";
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + roundedText(size.x(), 9) +
         "mm\" height=\"" + roundedText(size.y(), 9) + "mm\"\n     viewBox=\"" + "0 " +
         roundedText(-size.y(), 9) + " " + roundedText(size.x(), 9) + " " +
         roundedText(size.y(), 9) + "\" overflow=\"visible\">\n  <path d=\"" + data +
         "\"\n        fill=\"none\" stroke=\"black\" stroke-width=\"" +
         roundedText(0.004 * size.maxCoeff(), 3) + "\"/>\n</svg>\n";
}

void writeProfileSvg(const ProfileCurve& curve, const std::filesystem::path& path) {
  writeAtomically(toSvg(curve), path);
}

}  // namespace palpa::modeling
