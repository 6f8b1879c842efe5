#pragma once

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/job.h"

// Plane drawings from files: lines and curves that can become profiles.
namespace palpa::modeling {

/// Piece of a drawn path: a cubic Bézier curve, mm.
struct DrawnPiece {
  std::array<Eigen::Vector2d, 4> points;  ///< control points
  bool isStraight = false;  ///< a line from points[0] to points[3], the others at its thirds

  /// Point at the parameter t in [0, 1].
  Eigen::Vector2d at(double t) const;
};

/// Pieces, each of which begins where the one before ends. A closed path ends where it begins.
struct DrawnPath {
  std::vector<DrawnPiece> pieces;  ///< not empty
  bool closed = false;
  std::string layer;   ///< of the file; empty if there is none
  std::string origin;  ///< of its first piece: "line 12: LWPOLYLINE"

  Eigen::Vector2d start() const { return pieces.front().points.front(); }
  Eigen::Vector2d end() const { return pieces.back().points.back(); }
};

/// Paths of a drawing file.
struct Drawing {
  std::vector<DrawnPath> paths;        ///< not empty, in the order of the file
  std::map<std::string, int> skipped;  ///< kinds of elements that are no curves, and how many
  std::string unit;                    ///< of the file, with a remark if it was assumed
};

inline constexpr std::size_t kMaxDrawingFile = 32UL << 20;  // bytes
inline constexpr std::size_t kMaxDrawnPieces = 100'000;     // of one drawing

/// Largest distance of Bézier curves from parts of circles and ellipses, over the larger radius.
inline constexpr double kArcError = 1e-6;

/// Reads the entities LINE, ARC, CIRCLE, LWPOLYLINE, POLYLINE, ELLIPSE and SPLINE of a text DXF
/// file of any version, in the plane z = const; the unit is given by $INSUNITS, otherwise mm.
/// Ignores layers that are off or frozen, the paper space, and elements of other kinds. `source` is
/// the beginning of messages, which name the line. Throws ModelingError; Cancelled.
Drawing readDxf(std::string_view text, const std::string& source, const Job& job = {});

/// Reads path, rect, circle, ellipse, line, polyline and polygon of an SVG file, with transforms;
/// x to the right, y upwards from the lower edge of the page. A px is 25.4 / 96 mm. Ignores hidden
/// elements, definitions, and elements of other kinds. Throws as readDxf().
Drawing readSvg(std::string_view text, const std::string& source, const Job& job = {});

/// True for names that end in .dxf or .svg.
bool isDrawingFile(const std::filesystem::path& path);

/// readDxf() or readSvg(), chosen by the ending. Throws as they, and if the file cannot be read or
/// is larger than kMaxDrawingFile.
Drawing readDrawing(const std::filesystem::path& path, const Job& job = {});

/// Collects the pieces of paths for readers of files. Points are in the coordinates of the file;
/// the map given to begin() takes them to mm. Angles in rad. Functions that add a piece throw
/// ModelingError if the drawing has more than kMaxDrawnPieces or a coordinate is not a number or
/// beyond kMaxLength.
class DrawingBuilder {
 public:
  /// Begins an element of the file and ends the path before. Messages begin with `place`, which
  /// names the line.
  void begin(const std::string& place, const std::string& layer, const Eigen::Affine2d& toMm);
  /// Begins a path at a point.
  void moveTo(const Eigen::Vector2d& p);
  void lineTo(const Eigen::Vector2d& p);
  void quadTo(const Eigen::Vector2d& control, const Eigen::Vector2d& p);
  void cubicTo(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p);
  /// Part of an ellipse: centre + cos(angle) u + sin(angle) v; begins a path if there is none.
  void arc(const Eigen::Vector2d& centre, const Eigen::Vector2d& u, const Eigen::Vector2d& v,
           double from, double to);
  /// Closes the path, with a straight line if it does not end at its beginning.
  void close();
  /// Ends the path.
  void end();

  bool hasPath() const { return isOpen_; }
  /// Present end of the path.
  const Eigen::Vector2d& position() const { return position_; }
  /// Ends the path and returns all paths, which the builder then no longer has.
  std::vector<DrawnPath> take();

 private:
  void add(const std::array<Eigen::Vector2d, 4>& points, bool isStraight);

  std::string place_, layer_;
  Eigen::Affine2d toMm_ = Eigen::Affine2d::Identity();
  std::vector<DrawnPath> paths_;
  DrawnPath path_;
  Eigen::Vector2d start_ = Eigen::Vector2d::Zero(), position_ = Eigen::Vector2d::Zero();
  bool isOpen_ = false;
  std::size_t pieces_ = 0;
};

}  // namespace palpa::modeling
