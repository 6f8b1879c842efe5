#include "modeling/exchange/cad_solid.h"

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeFix_Shape.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shell.hxx>
#include <cmath>
#include <map>
#include <set>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/exchange/cad_text_check.h"
#include "modeling/exchange/opencascade_session.h"

namespace palpa::modeling {
namespace {

constexpr double kSewing = 1e-5;  // of the diagonal: largest gap between loose faces to close

int countOf(const TopoDS_Shape& shape, TopAbs_ShapeEnum type) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, type, map);
  return map.Extent();
}

double diagonalOf(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::AddClose(shape, box);
  if (box.IsVoid()) throw ModelingError("contains no surface");
  const double diagonal = std::sqrt(box.SquareExtent());
  if (!std::isfinite(diagonal) || diagonal > 2e7 || diagonal < 1e-6)
    throw ModelingError("the shape has a size of " + numberText(diagonal) +
                        " mm; expected 0.000001 mm … 10 km");
  return diagonal;
}

/// Moves the names of replaced faces to their replacements.
void followNames(const TopoDS_Shape& before, const auto& replacement, FaceNames& names) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(before, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i) {
    const std::string* found = names.Seek(faces(i));
    if (!found) continue;
    const std::string name = *found;
    const TopoDS_Shape after = replacement(faces(i));
    TopTools_IndexedMapOfShape parts;
    if (!after.IsNull()) TopExp::MapShapes(after, TopAbs_FACE, parts);
    for (int k = 1; k <= parts.Extent(); ++k) names.Bind(parts(k), name);
  }
}

/// Joins loose faces along their borders.
TopoDS_Shape sew(const TopoDS_Shape& shape, double tolerance, CadSolid& result, const Job& job) {
  BRepBuilderAPI_Sewing sewing(tolerance);
  sewing.Add(shape);
  const auto progress = makeProgress(job, Phase::kSew);
  sewing.Perform(progress->Start());
  job.throwIfCancelled();
  followNames(
      shape, [&](const TopoDS_Shape& face) { return sewing.ModifiedSubShape(face); },
      result.faceNames);
  return sewing.SewedShape();
}

TopoDS_Shape repair(const TopoDS_Shape& shape, CadSolid& result, const Job& job) {
  const Handle(ShapeFix_Shape) fix = new ShapeFix_Shape(shape);
  const auto progress = makeProgress(job, Phase::kRepair);
  fix->Perform(progress->Start());
  job.throwIfCancelled();
  followNames(
      shape, [&](const TopoDS_Shape& face) { return fix->Context()->Apply(face); },
      result.faceNames);
  return fix->Shape();
}

std::string pointText(const gp_Pnt& p) {
  return placeText({p.X(), p.Y(), p.Z()});
}

/// The reason why the faces do not enclose a body; empty if they do.
std::string openPlace(const TopoDS_Shape& shape) {
  TopTools_IndexedDataMapOfShapeListOfShape faces;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i) {
    const TopoDS_Edge& edge = TopoDS::Edge(faces.FindKey(i));
    if (BRep_Tool::Degenerated(edge)) continue;
    int uses = 0;
    TopTools_IndexedMapOfShape seen;
    for (const TopoDS_Shape& face : faces(i)) {
      if (seen.Contains(face)) continue;
      seen.Add(face);
      for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next())
        if (e.Current().IsSame(edge) && e.Current().Orientation() != TopAbs_INTERNAL) ++uses;
    }
    if (uses == 2) continue;
    double first, last;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
    const std::string place =
        curve.IsNull() ? "" : " near " + pointText(curve->Value(0.5 * (first + last)));
    return uses < 2 ? "the surface is not closed: an edge" + place +
                          " belongs to one face only; close the surface"
                    : "an edge" + place + " belongs to " + std::to_string(uses) +
                          " faces; a body has two at each edge: separate bodies that touch, remove "
                          "inner walls";
  }
  return "";
}

/// A solid from the shells of a shape without solids, and from single closed faces.
TopoDS_Shape solidFromShells(const TopoDS_Shape& shape) {
  BRepBuilderAPI_MakeSolid maker;
  for (TopExp_Explorer shells(shape, TopAbs_SHELL); shells.More(); shells.Next())
    maker.Add(TopoDS::Shell(shells.Current()));
  const BRep_Builder builder;
  for (TopExp_Explorer faces(shape, TopAbs_FACE, TopAbs_SHELL); faces.More(); faces.Next()) {
    TopoDS_Shell shell;
    builder.MakeShell(shell);
    builder.Add(shell, faces.Current());
    shell.Closed(Standard_True);
    maker.Add(shell);
  }
  if (!maker.IsDone()) throw ModelingError("its faces do not form a closed surface");
  return maker.Solid();
}

}  // namespace

CadSolid findSolid(const CadContent& content, const Job& job) {
  CadSolid result;
  result.faceNames = content.faceNames;
  const int faces = countOf(content.shape, TopAbs_FACE);
  if (faces == 0) throw ModelingError("contains no faces; only solids can be imported");
  if (faces > kMaxCadFaces)
    throw ModelingError("has " + std::to_string(faces) + " faces; at most " +
                            std::to_string(kMaxCadFaces) + " are read",
                        ModelingError::Kind::kTooLarge);
  const double diagonal = diagonalOf(content.shape);
  const int solids = countOf(content.shape, TopAbs_SOLID);
  if (solids > 1)
    throw ModelingError("contains " + std::to_string(solids) +
                        " solids, but a project has one body; export them into separate files");
  TopoDS_Shape shape = content.shape;
  if (solids == 1) {
    shape = TopExp_Explorer(shape, TopAbs_SOLID).Current();
    if (countOf(shape, TopAbs_FACE) < faces)
      result.notes.push_back("Faces outside the solid were omitted.");
  }
  job.throwIfCancelled();
  if (solids == 0 || !openPlace(shape).empty()) {
    shape = sew(shape, kSewing * diagonal, result, job);
    const std::string open = openPlace(shape);
    if (!open.empty()) throw ModelingError(open);
    shape = solidFromShells(shape);
    result.notes.push_back("Loose faces were sewn together; gaps up to " +
                           shortNumberText(kSewing * diagonal) + " mm were closed.");
  }
  if (!BRepCheck_Analyzer(shape).IsValid()) {
    shape = repair(shape, result, job);
    if (countOf(shape, TopAbs_SOLID) == 0) shape = solidFromShells(shape);
    const std::string open = openPlace(shape);
    if (!open.empty()) throw ModelingError(open);
    result.notes.push_back("OpenCASCADE found faults in the shape and repaired it.");
  }
  job.throwIfCancelled();
  result.shape = TopoDS::Solid(TopExp_Explorer(shape, TopAbs_SOLID).Current());
  GProp_GProps properties;
  BRepGProp::VolumeProperties(result.shape, properties);
  if (!std::isfinite(properties.Mass()) || properties.Mass() == 0.0)
    throw ModelingError("the solid encloses no volume");
  if (properties.Mass() < 0.0) result.shape.Reverse();
  return result;
}

std::vector<std::string> uniqueFaceNames(const TopoDS_Shape& shape, const FaceNames& names) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  std::map<std::string, int> uses;
  for (int i = 1; i <= faces.Extent(); ++i) {
    if (const std::string* name = names.Seek(faces(i))) ++uses[*name];
  }
  std::set<std::string> taken;
  std::map<std::string, int> next;
  std::vector<std::string> result;
  for (int i = 1; i <= faces.Extent(); ++i) {
    const std::string* found = names.Seek(faces(i));
    const bool named = found != nullptr;
    const std::string base = named ? *found : "face";
    std::string name = base;
    if (!named || uses[base] > 1) {
      int number = named ? next[base] : i - 1;
      do name = base + "_" + std::to_string(++number);
      while (uses.count(name) || taken.count(name));
      next[base] = number;
    }
    taken.insert(name);
    result.push_back(name);
  }
  return result;
}

}  // namespace palpa::modeling
