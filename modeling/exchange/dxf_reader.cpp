// Entities of text DXF files.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/exchange/drawing.h"
#include "modeling/exchange/drawn_spline.h"
#include "modeling/exchange/dxf_records.h"

namespace palpa::modeling {
namespace {

using dxf::Group;
using dxf::plainText;
using dxf::Record;
using dxf::RecordReader;
using dxf::unitNumbered;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kDegree = std::numbers::pi / 180.0;

class DxfReader {
 public:
  explicit DxfReader(const Job& job) : job_(job) {}

  Drawing read(std::string_view text) {
    if (text.starts_with("AutoCAD Binary DXF"))
      throw ModelingError("the file is a binary DXF; save it as text (ASCII) DXF");
    RecordReader records(text);
    Record record;
    std::string section;
    bool hasEntities = false;
    while (records.next(record)) {
      job_.throwIfCancelled();
      if (record.type == "SECTION") {
        section = record.text(2).value_or("");
        hasEntities = hasEntities || section == "ENTITIES";
        if (section == "HEADER") readHeader(record);
      } else if (record.type == "ENDSEC") {
        finishPolyline();
        section.clear();
      } else if (section == "TABLES" && record.type == "LAYER") {
        readLayer(record);
      } else if (section == "ENTITIES") {
        readEntity(record);
      }
    }
    finishPolyline();
    if (!hasEntities)
      throw ModelingError("there is no section ENTITIES; this is not a DXF drawing");
    drawing_.unit = unit_.first;
    drawing_.paths = builder_.take();
    return std::move(drawing_);
  }

 private:
  void readHeader(const Record& record) {
    for (std::size_t i = 0; i + 1 < record.groups.size(); ++i)
      if (record.groups[i].code == 9 && record.groups[i].value == "$INSUNITS")
        unit_ = unitNumbered(
            static_cast<int>(std::clamp(Record::number(record.groups[i + 1]), -1.0, 1e6)));
  }

  void readLayer(const Record& record) {
    const bool off = record.number(62, 7.0) < 0.0;
    const bool frozen = (record.flags(70) & 1) != 0;
    if (off || frozen) hiddenLayers_.insert(std::string(record.text(2).value_or("")));
  }

  /// Map from the entity's coordinates to mm. Entities in their own plane are mirrored if its
  /// normal is (0, 0, -1).
  Eigen::Affine2d toMm(const Record& record, bool inOwnPlane) const {
    const double sign = normalSign(record);
    Eigen::Affine2d map = Eigen::Affine2d::Identity();
    map.linear() =
        Vector2d(inOwnPlane ? sign : 1.0, 1.0).asDiagonal() * Eigen::Matrix2d::Identity();
    map.linear() *= unit_.second;
    return map;
  }

  static double normalSign(const Record& record) {
    const Vector3d normal(record.number(210, 0.0), record.number(220, 0.0),
                          record.number(230, 1.0));
    if (!(std::abs(normal.z()) > (1.0 - 1e-9) * normal.norm()))
      record.fail("the entity does not lie in a plane z = const; draw it in the xy plane");
    return normal.z() < 0.0 ? -1.0 : 1.0;
  }

  void begin(const Record& record, bool inOwnPlane) {
    builder_.begin(record.place(), std::string(record.text(8).value_or("0")),
                   toMm(record, inOwnPlane));
  }

  void readEntity(const Record& record) {
    if (record.type == "VERTEX") {
      if (polyline_) addVertex(record);
      return;
    }
    finishPolyline();
    if (record.type == "SEQEND") return;
    const bool isOnPaper = record.flags(67) == 1;
    const bool isHidden =
        record.flags(60) == 1 || hiddenLayers_.count(std::string(record.text(8).value_or("0"))) > 0;
    if (isOnPaper || isHidden) {
      ++drawing_.skipped[isOnPaper ? "in the paper space" : "hidden"];
      return;
    }
    if (record.type == "LINE") {
      begin(record, false);
      builder_.moveTo(record.point(10));
      builder_.lineTo(record.point(11));
    } else if (record.type == "ARC" || record.type == "CIRCLE") {
      readArc(record);
    } else if (record.type == "ELLIPSE") {
      readEllipse(record);
    } else if (record.type == "LWPOLYLINE") {
      readLightPolyline(record);
    } else if (record.type == "POLYLINE") {
      beginPolyline(record);
    } else if (record.type == "SPLINE") {
      readSpline(record);
    } else {
      ++drawing_.skipped[plainText(record.type)];
    }
  }

  void readArc(const Record& record) {
    const double radius = record.number(40);
    if (!(radius > 0.0)) record.fail("the radius is " + numberText(radius) + "; expected > 0");
    begin(record, true);
    const Vector2d u(radius, 0.0), v(0.0, radius);
    if (record.type == "CIRCLE") {
      builder_.arc(record.point(10), u, v, 0.0, kTurn);
      builder_.close();
      return;
    }
    const double from = kDegree * std::remainder(record.number(50), 360.0);
    double to = kDegree * std::remainder(record.number(51), 360.0);
    if (to <= from) to += kTurn;
    builder_.arc(record.point(10), u, v, from, to);
  }

  void readEllipse(const Record& record) {
    const Vector2d major(record.number(11), record.number(21));
    const double ratio = record.number(40);
    if (!(major.norm() > 0.0) || !(ratio > 0.0) || ratio > 1.0 + 1e-9)
      record.fail("expected a major axis and a ratio between 0 and 1");
    const Vector2d minor = normalSign(record) * ratio * Vector2d(-major.y(), major.x());
    const double from = std::remainder(record.number(41, 0.0), kTurn);
    const double range = record.number(42, kTurn) - record.number(41, 0.0);
    begin(record, false);
    const double whole = std::abs(range) < 1e-9 ? kTurn : range - kTurn * std::floor(range / kTurn);
    const bool isFull = whole < 1e-9 || whole > kTurn - 1e-9;
    builder_.arc(record.point(10), major, minor, from, from + (isFull ? kTurn : whole));
    if (isFull) builder_.close();
  }

  struct Vertex {
    Vector2d at = Vector2d::Zero();
    double bulge = 0.0;  ///< tangent of a quarter of the arc's angle, > 0 to the left
  };

  void addPolyline(const Record& record, const std::vector<Vertex>& vertices, bool closed) {
    if (vertices.size() < 2) record.fail("a polyline needs at least two vertices");
    begin(record, true);
    builder_.moveTo(vertices[0].at);
    const std::size_t count = vertices.size();
    for (std::size_t i = 0; i + (closed ? 0 : 1) < count; ++i) {
      const Vector2d from = vertices[i].at, to = vertices[(i + 1) % count].at;
      const double bulge = vertices[i].bulge;
      const Vector2d chord = to - from;
      if (std::abs(bulge) < 1e-9 || !(chord.norm() > 0.0)) {
        builder_.lineTo(to);
        continue;
      }
      const Vector2d left(-chord.y(), chord.x());
      const Vector2d centre = 0.5 * (from + to) + (1.0 - bulge * bulge) / (4.0 * bulge) * left;
      const Vector2d u = from - centre;
      builder_.arc(centre, u, Vector2d(-u.y(), u.x()), 0.0, 4.0 * std::atan(bulge));
    }
    if (closed) builder_.close();
  }

  void readLightPolyline(const Record& record) {
    std::vector<Vertex> vertices;
    for (const Group& group : record.groups) {
      if (group.code == 10) vertices.push_back({{Record::number(group), 0.0}, 0.0});
      if (vertices.empty()) continue;
      if (group.code == 20) vertices.back().at.y() = Record::number(group);
      if (group.code == 42) vertices.back().bulge = Record::number(group);
    }
    addPolyline(record, vertices, (record.flags(70) & 1) != 0);
  }

  void beginPolyline(const Record& record) {
    constexpr int kMeshes = 16 | 64;
    if ((record.flags(70) & kMeshes) != 0) {
      ++drawing_.skipped["POLYLINE mesh"];
      return;
    }
    polyline_ = record;
    vertices_.clear();
  }

  void addVertex(const Record& record) {
    constexpr int kFrameOfSpline = 16;
    if ((record.flags(70) & kFrameOfSpline) != 0) return;
    vertices_.push_back({record.point(10), record.number(42, 0.0)});
  }

  void finishPolyline() {
    if (!polyline_) return;
    const Record record = *polyline_;
    polyline_.reset();
    addPolyline(record, vertices_, (record.flags(70) & 1) != 0);
  }

  void readSpline(const Record& record) {
    DrawnSpline spline;
    const double degree = record.number(71);
    if (degree != std::floor(degree) || degree < 1.0 || degree > DrawnSpline::kMaxDegree)
      record.fail("the degree is " + numberText(degree) + "; expected 1 … " +
                  std::to_string(DrawnSpline::kMaxDegree));
    spline.degree = static_cast<int>(degree);
    for (const Group& group : record.groups) {
      if (group.code == 40) spline.knots.push_back(Record::number(group));
      if (group.code == 41) spline.weights.push_back(Record::number(group));
      if (group.code == 10) spline.points.emplace_back(Record::number(group), 0.0);
      if (group.code == 20 && !spline.points.empty())
        spline.points.back().y() = Record::number(group);
    }
    if (spline.points.empty())
      record.fail("the spline has no control points; convert it or draw it as a polyline");
    begin(record, false);
    try {
      addSpline(builder_, spline, job_);
    } catch (const ModelingError& error) {
      if (std::string_view(error.what()).starts_with("line ")) throw;
      record.fail(error.what());
    }
  }

  const Job& job_;
  Drawing drawing_;
  DrawingBuilder builder_;
  std::pair<std::string, double> unit_ = unitNumbered(0);
  std::set<std::string> hiddenLayers_;
  std::optional<Record> polyline_;  // whose vertices follow
  std::vector<Vertex> vertices_;
};

}  // namespace

Drawing readDxf(std::string_view text, const std::string& source, const Job& job) {
  try {
    Drawing drawing = DxfReader(job).read(text);
    if (!drawing.paths.empty()) return drawing;
    std::string skipped;
    for (const auto& [kind, count] : drawing.skipped)
      skipped += (skipped.empty() ? "; it has " : ", ") + std::to_string(count) + " " + kind;
    throw ModelingError(
        "there is no line or curve that can become a profile" + skipped +
        (drawing.skipped.count("INSERT") > 0 ? ": explode the blocks (INSERT)" : ""));
  } catch (const ModelingError& error) {
    throw ModelingError(source + ": " + error.what(), error.kind());
  }
}

}  // namespace palpa::modeling
