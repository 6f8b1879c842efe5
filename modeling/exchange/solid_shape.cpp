#include "modeling/exchange/solid_shape.h"

#include <BRep_Builder.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <map>

#include "modeling/solid/opencascade_surface.h"

namespace palpa::modeling {
namespace {

constexpr double kTolerance = 1e-7;  // mm; Precision::Confusion(), OpenCASCADE's smallest tolerance

using Surfaces = std::vector<Handle(Geom_BSplineSurface)>;

Handle(Geom_BSplineCurve) sideCurve(const Handle(Geom_BSplineSurface) & surface, Side side) {
  double uMin, uMax, vMin, vMax;
  surface->Bounds(uMin, uMax, vMin, vMax);
  Handle(Geom_Curve) curve;
  switch (side) {
    case Side::kVMin:
      curve = surface->VIso(vMin);
      break;
    case Side::kUMax:
      curve = surface->UIso(uMax);
      break;
    case Side::kVMax:
      curve = surface->VIso(vMax);
      break;
    case Side::kUMin:
      curve = surface->UIso(uMin);
      break;
  }
  return Handle(Geom_BSplineCurve)::DownCast(curve);
}

/// The side as a line in the parameter plane, parametrised like the edge's first use.
Handle(Geom2d_Curve)
    sideLine(const Patch& patch, Side side, const std::array<double, 2>& edgeRange, bool reversed) {
  const auto [uMin, uMax] = patch.range(0);
  const auto [vMin, vMax] = patch.range(1);
  gp_Pnt2d start(side == Side::kUMax ? uMax : uMin, side == Side::kVMax ? vMax : vMin);
  gp_Pnt2d end(side == Side::kUMin ? uMin : uMax, side == Side::kVMin ? vMin : vMax);
  if (reversed) std::swap(start, end);
  TColgp_Array1OfPnt2d poles(1, 2);
  poles(1) = start;
  poles(2) = end;
  TColStd_Array1OfReal knots(1, 2);
  knots(1) = edgeRange[0];
  knots(2) = edgeRange[1];
  TColStd_Array1OfInteger multiplicities(1, 2);
  multiplicities.Init(2);
  return new Geom2d_BSplineCurve(poles, knots, multiplicities, 1);
}

std::array<double, 2> rangeOfSide(const std::vector<Patch>& patches, PatchEdge use) {
  return patches[use.patch].range(directionOf(use.side));
}

std::vector<TopoDS_Edge> makeEdges(const Solid& solid, const Surfaces& surfaces) {
  BRep_Builder builder;
  std::map<int, TopoDS_Vertex> vertices;
  const auto vertexAt = [&](int point) {
    const auto [found, added] = vertices.try_emplace(point);
    if (added) {
      const Eigen::Vector3d& p = solid.controlPoints()[point];
      builder.MakeVertex(found->second, gp_Pnt(p.x(), p.y(), p.z()), kTolerance);
    }
    return found->second;
  };
  std::vector<TopoDS_Edge> edges;
  for (const SolidEdge& edge : solid.edges()) {
    const PatchEdge use = edge.uses[0];
    const auto [first, last] = rangeOfSide(solid.patches(), use);
    TopoDS_Edge made;
    builder.MakeEdge(made, sideCurve(surfaces[use.patch], use.side), kTolerance);
    builder.Range(made, first, last);
    builder.Add(made, vertexAt(edge.vertices[0]).Oriented(TopAbs_FORWARD));
    builder.Add(made, vertexAt(edge.vertices[1]).Oriented(TopAbs_REVERSED));
    edges.push_back(made);
  }
  return edges;
}

/// Adds the edges as curves in the parameter planes of the adjacent faces.
void addParameterCurves(const Solid& solid, const std::vector<TopoDS_Edge>& edges,
                        const std::vector<TopoDS_Face>& faces) {
  const BRep_Builder builder;
  const std::vector<Patch>& patches = solid.patches();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const SolidEdge& edge = solid.edges()[e];
    const std::array<double, 2> range = rangeOfSide(patches, edge.uses[0]);
    std::array<Handle(Geom2d_Curve), 2> lines;
    for (int i : {0, 1}) {
      const PatchEdge use = edge.uses[i];
      lines[i] = sideLine(patches[use.patch], use.side, range, i == 1 && edge.reversed);
    }
    if (edge.uses[0].patch == edge.uses[1].patch) {  // a seam: both lines in one face
      const bool forward = isForward(edge.uses[0].side);
      builder.UpdateEdge(edges[e], lines[forward ? 0 : 1], lines[forward ? 1 : 0],
                         faces[edge.uses[0].patch], kTolerance);
    } else {
      for (int i : {0, 1})
        builder.UpdateEdge(edges[e], lines[i], faces[edge.uses[i].patch], kTolerance);
    }
    for (const PatchEdge use : edge.uses)
      builder.Range(edges[e], faces[use.patch], range[0], range[1]);
  }
}

TopoDS_Wire makeWire(const Solid& solid, int patch, const std::vector<TopoDS_Edge>& edges) {
  const BRep_Builder builder;
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (Side side : kSides) {
    const int index = solid.edgeOf(patch, side);
    const SolidEdge& edge = solid.edges()[index];
    const bool second = edge.uses[0].patch != patch || edge.uses[0].side != side;
    const bool forward = isForward(side) != (second && edge.reversed);
    builder.Add(wire, edges[index].Oriented(forward ? TopAbs_FORWARD : TopAbs_REVERSED));
  }
  wire.Closed(Standard_True);
  return wire;
}

/// For each patch, the first patch of its shell.
std::vector<int> shellOfPatch(const Solid& solid) {
  std::vector<int> shell(solid.patches().size());
  for (std::size_t p = 0; p < shell.size(); ++p) shell[p] = static_cast<int>(p);
  for (bool changed = true; changed;) {
    changed = false;
    for (const SolidEdge& edge : solid.edges()) {
      int& a = shell[edge.uses[0].patch];
      int& b = shell[edge.uses[1].patch];
      changed = changed || a != b;
      a = b = std::min(a, b);
    }
  }
  return shell;
}

}  // namespace

ShapeOfSolid makeShape(const Solid& solid) {
  const BRep_Builder builder;
  Surfaces surfaces;
  ShapeOfSolid result;
  for (const Patch& patch : solid.patches()) {
    surfaces.push_back(makeSurface(solid.controlPoints(), patch));
    builder.MakeFace(result.faces.emplace_back(), surfaces.back(), kTolerance);
    builder.NaturalRestriction(result.faces.back(), Standard_True);
  }
  const std::vector<TopoDS_Edge> edges = makeEdges(solid, surfaces);
  addParameterCurves(solid, edges, result.faces);

  std::map<int, TopoDS_Shell> shells;
  const std::vector<int> shellOf = shellOfPatch(solid);
  for (std::size_t p = 0; p < result.faces.size(); ++p) {
    builder.Add(result.faces[p], makeWire(solid, static_cast<int>(p), edges));
    const auto [shell, added] = shells.try_emplace(shellOf[p]);
    if (added) builder.MakeShell(shell->second);
    builder.Add(shell->second, result.faces[p]);
  }
  builder.MakeSolid(result.shape);
  for (auto& [first, shell] : shells) {
    shell.Closed(Standard_True);
    builder.Add(result.shape, shell);
  }
  return result;
}

}  // namespace palpa::modeling
