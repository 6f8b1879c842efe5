#include "modeling/exchange/quad_faces.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomConvert.hxx>
#include <GeomLib_IsPlanarSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Pln.hxx>

namespace palpa::modeling {
namespace {

constexpr int kMaxDegree = 5;
constexpr double kOnSide = 1e-5;  // of the range: largest distance of an edge from its side
constexpr double kFlat = 1e-6;    // mm: largest distance of a flat surface from its plane

[[noreturn]] void fail(const std::string& face, const std::string& what) {
  throw NoPatches{"the face \"" + face + "\" " + what};
}

/// The edges of the only wire. Throws NoPatches if an edge is collapsed or used twice.
std::vector<TopoDS_Edge> edgesOf(const TopoDS_Face& face, const std::string& name) {
  int wires = 0;
  for (TopExp_Explorer w(face, TopAbs_WIRE); w.More(); w.Next()) ++wires;
  if (wires > 1) fail(name, "has a hole");
  std::vector<TopoDS_Edge> edges;
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    edges.push_back(TopoDS::Edge(e.Current()));
    if (BRep_Tool::Degenerated(edges.back())) fail(name, "has a pole");
  }
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (edges[i].IsSame(edges[k])) fail(name, "closes on itself");
  if (edges.size() < 3) fail(name, "is bounded by " + std::to_string(edges.size()) + " edges");
  return edges;
}

/// Sets the sides of a flat face to its four edges in order, for edges of any shape.
void findFlatSides(const TopoDS_Face& face, QuadFace& quad, const QuadFaces& all) {
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  const std::size_t count = edgesOf(forward, quad.name).size();
  if (count != 4)
    fail(quad.name, "is flat with " + std::to_string(count) + " edges; a patch has four");
  std::vector<std::pair<int, bool>> loop;  // edge, runs along the loop
  const TopoDS_Wire wire = BRepTools::OuterWire(forward);
  for (BRepTools_WireExplorer e(wire, forward); e.More(); e.Next())
    loop.emplace_back(all.edges.FindIndex(e.Current()), e.Orientation() == TopAbs_FORWARD);
  if (loop.size() != 4) fail(quad.name, "has a border that is not one loop");
  if (face.Orientation() == TopAbs_REVERSED) {
    std::reverse(loop.begin(), loop.end());
    for (auto& [edge, along] : loop) along = !along;
  }
  for (Side side : kSides) {
    const auto [edge, along] = loop[static_cast<std::size_t>(side)];
    quad.sides[static_cast<std::size_t>(side)] = {edge, along != isForward(side)};
  }
}

struct Rectangle {
  std::array<double, 2> low{1e300, 1e300};
  std::array<double, 2> high{-1e300, -1e300};
};

/// Sets the sides of a curved face: each edge must follow one side of the parameter rectangle
/// around all edges.
Rectangle findCurvedSides(const TopoDS_Face& face, QuadFace& quad, const QuadFaces& all) {
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  const std::vector<TopoDS_Edge> edges = edgesOf(forward, quad.name);
  constexpr int kSamples = 9;
  std::vector<std::array<gp_Pnt2d, kSamples>> lines;
  Rectangle box;
  for (const TopoDS_Edge& edge : edges) {
    double first, last;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, forward, first, last);
    if (curve.IsNull()) fail(quad.name, "has an edge without parameters");
    auto& line = lines.emplace_back();
    for (int i = 0; i < kSamples; ++i) {
      line[i] = curve->Value(first + (last - first) * i / (kSamples - 1));
      for (int d : {0, 1}) {
        const double value = line[i].Coord(d + 1);
        box.low[d] = std::min(box.low[d], value);
        box.high[d] = std::max(box.high[d], value);
      }
    }
  }
  std::array<int, 4> edgesOnSide{};
  for (std::size_t e = 0; e < edges.size(); ++e) {
    bool found = false;
    for (Side side : kSides) {
      const int across = 1 - directionOf(side);
      const bool high = side == Side::kUMax || side == Side::kVMax;
      const double at = high ? box.high[across] : box.low[across];
      const double tolerance = kOnSide * (box.high[across] - box.low[across]);
      if (!std::all_of(lines[e].begin(), lines[e].end(), [&](const gp_Pnt2d& p) {
            return std::abs(p.Coord(across + 1) - at) <= tolerance;
          }))
        continue;
      found = true;
      ++edgesOnSide[static_cast<std::size_t>(side)];
      const int along = directionOf(side) + 1;
      quad.sides[static_cast<std::size_t>(side)] = {
          all.edges.FindIndex(edges[e]),
          lines[e].back().Coord(along) < lines[e].front().Coord(along)};
      break;
    }
    if (!found) fail(quad.name, "is trimmed: its border does not follow its parameter lines");
  }
  for (const int count : edgesOnSide) {
    if (count == 0) fail(quad.name, "does not have four sides");
    if (count > 1) fail(quad.name, "meets several faces along one of its sides");
  }
  return box;
}

/// The surface as a B-spline over the rectangle if the conversion is exact, without weights and of
/// low degree; otherwise null.
Handle(Geom_BSplineSurface) asSpline(const Handle(Geom_Surface) & surface, const Rectangle& box) {
  const auto& [low, high] = box;
  const bool isSpline = surface->IsKind(STANDARD_TYPE(Geom_BSplineSurface));
  Handle(Geom_BSplineSurface) spline;
  if (isSpline) {
    spline = Handle(Geom_BSplineSurface)::DownCast(surface->Copy());
  } else if (surface->IsKind(STANDARD_TYPE(Geom_BezierSurface)) ||
             surface->IsKind(STANDARD_TYPE(Geom_SurfaceOfLinearExtrusion))) {
    const Handle(Geom_Surface) piece =
        new Geom_RectangularTrimmedSurface(surface, low[0], high[0], low[1], high[1]);
    spline = GeomConvert::SurfaceToBSplineSurface(piece);
  }
  if (spline.IsNull() || spline->IsURational() || spline->IsVRational() ||
      spline->UDegree() > kMaxDegree || spline->VDegree() > kMaxDegree)
    return {};
  double u0, u1, v0, v1;
  spline->Bounds(u0, u1, v0, v1);
  const auto differs = [](double a0, double a1, double b0, double b1) {
    return std::abs(a0 - b0) + std::abs(a1 - b1) > 1e-9 * (b1 - b0);
  };
  const bool part = differs(low[0], high[0], u0, u1) || differs(low[1], high[1], v0, v1);
  if (!part && !spline->IsUPeriodic() && !spline->IsVPeriodic()) return spline;
  spline->Segment(low[0], high[0], low[1], high[1]);
  return spline;
}

Handle(Geom_Surface) withoutTrimming(Handle(Geom_Surface) surface) {
  while (surface->IsKind(STANDARD_TYPE(Geom_RectangularTrimmedSurface)))
    surface = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface)->BasisSurface();
  return surface;
}

/// Sets the plane if the surface is a plane or a flat surface of another type (many programs write
/// planes as B-splines); returns whether it is.
bool findPlane(const TopoDS_Face& face, QuadFace& quad) {
  const BRepAdaptor_Surface adaptor(face, Standard_False);
  gp_Pln plane;
  if (adaptor.GetType() == GeomAbs_Plane) {
    plane = adaptor.Plane();
  } else {
    const GeomLib_IsPlanarSurface planar(BRep_Tool::Surface(face), kFlat);
    if (!planar.IsPlanar()) return false;
    plane = planar.Plan();
  }
  quad.kind = QuadFace::Kind::kFlat;
  quad.origin = plane.Location();
  double u0, u1, v0, v1;
  BRepTools::UVBounds(face, u0, u1, v0, v1);
  gp_Pnt point;
  gp_Vec du, dv;
  adaptor.D1(0.5 * (u0 + u1), 0.5 * (v0 + v1), point, du, dv);
  quad.normal = plane.Axis().Direction();
  const bool along = du.Crossed(dv).Dot(gp_Vec(quad.normal)) > 0.0;
  if (along != (face.Orientation() == TopAbs_FORWARD)) quad.normal.Reverse();
  return true;
}

bool isPlane(const TopoDS_Face& face) {
  return BRepAdaptor_Surface(face, Standard_False).GetType() == GeomAbs_Plane;
}

QuadFace makeQuad(const TopoDS_Face& face, const std::string& name, const QuadFaces& all) {
  QuadFace quad;
  quad.name = name;
  if (isPlane(face)) {
    findPlane(face, quad);
    findFlatSides(face, quad, all);
    return quad;
  }
  Rectangle box;
  try {
    box = findCurvedSides(face, quad, all);
  } catch (const NoPatches&) {
    if (!findPlane(face, quad)) throw;
    findFlatSides(face, quad, all);
    return quad;
  }
  quad.swapped = face.Orientation() == TopAbs_REVERSED;
  quad.surface = withoutTrimming(BRep_Tool::Surface(face));
  quad.spline = asSpline(quad.surface, box);
  quad.kind = quad.spline.IsNull() ? QuadFace::Kind::kSmooth : QuadFace::Kind::kSpline;
  quad.range = {{{box.low[0], box.high[0]}, {box.low[1], box.high[1]}}};
  if (quad.swapped) {
    if (!quad.spline.IsNull()) quad.spline->ExchangeUV();
    std::swap(quad.range[0], quad.range[1]);
    const auto side = [&](Side s) -> QuadFace::SideUse& {
      return quad.sides[static_cast<std::size_t>(s)];
    };
    std::swap(side(Side::kVMin), side(Side::kUMin));
    std::swap(side(Side::kUMax), side(Side::kVMax));
  }
  return quad;
}

}  // namespace

gp_Pnt QuadFace::value(double s, double t) const {
  if (kind == Kind::kSpline) {
    double u0, u1, v0, v1;
    spline->Bounds(u0, u1, v0, v1);
    return spline->Value(u0 + s * (u1 - u0), v0 + t * (v1 - v0));
  }
  const double u = range[0][0] + s * (range[0][1] - range[0][0]);
  const double v = range[1][0] + t * (range[1][1] - range[1][0]);
  return swapped ? surface->Value(v, u) : surface->Value(u, v);
}

QuadFaces findQuadFaces(const TopoDS_Solid& solid, const std::vector<std::string>& faceNames) {
  QuadFaces result;
  TopExp::MapShapes(solid, TopAbs_EDGE, result.edges);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(solid, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i)
    result.faces.push_back(
        makeQuad(TopoDS::Face(faces(i)), faceNames[static_cast<std::size_t>(i) - 1], result));
  return result;
}

}  // namespace palpa::modeling
