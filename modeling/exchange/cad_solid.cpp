#include "modeling/exchange/cad_solid.h"

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
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
#include <TopoDS_Vertex.hxx>
#include <cmath>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/exchange/cad_text_check.h"
#include "modeling/exchange/opencascade_session.h"
#include "modeling/exchange/unique_names.h"

namespace palpa::modeling {
namespace {

constexpr double kSewing = 1e-5;     // of the diagonal: largest gap between loose faces to close
constexpr double kNoVolume = 1e-14;  // of the cube of the diagonal
constexpr double kInside = 1e-6;  // mm: a point nearer to a surface is neither inside nor outside

int countOf(const TopoDS_Shape& shape, TopAbs_ShapeEnum type) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, type, map);
  return map.Extent();
}

double diagonalOf(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::AddClose(shape, box);
  if (box.IsVoid()) throw ModelingError("contains no surface; export the part as a solid");
  const double diagonal = std::sqrt(box.SquareExtent());
  if (!std::isfinite(diagonal) || diagonal > 2e7 || diagonal < 1e-6)
    throw ModelingError(
        "the shape has a size of " + shortNumberText(diagonal) +
        " mm; expected 0.000001 mm … 20 km: correct the unit in the program that made the file");
  return diagonal;
}

void checkFaceCount(int faces) {
  if (faces > kMaxCadFaces)
    throw ModelingError("has " + std::to_string(faces) + " faces; at most " +
                            std::to_string(kMaxCadFaces) + " are read: simplify the part",
                        ModelingError::Kind::kTooLarge);
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
TopoDS_Shape sew(const TopoDS_Shape& shape, double tolerance, FaceNames& names, const Job& job) {
  BRepBuilderAPI_Sewing sewing(tolerance);
  sewing.Add(shape);
  const auto progress = makeProgress(job, Phase::kSew);
  sewing.Perform(progress->Start());
  job.throwIfCancelled();
  followNames(
      shape, [&](const TopoDS_Shape& face) { return sewing.ModifiedSubShape(face); }, names);
  return sewing.SewedShape();
}

TopoDS_Shape repair(const TopoDS_Shape& shape, FaceNames& names, const Job& job) {
  const Handle(ShapeFix_Shape) fix = new ShapeFix_Shape(shape);
  const auto progress = makeProgress(job, Phase::kRepair);
  fix->Perform(progress->Start());
  job.throwIfCancelled();
  followNames(
      shape, [&](const TopoDS_Shape& face) { return fix->Context()->Apply(face); }, names);
  return fix->Shape();
}

std::string pointText(const gp_Pnt& p) {
  return placeText({p.X(), p.Y(), p.Z()});
}

/// A vertex of a shape; the origin if it has none.
gp_Pnt vertexOf(const TopoDS_Shape& shape) {
  const TopExp_Explorer vertex(shape, TopAbs_VERTEX);
  return vertex.More() ? BRep_Tool::Pnt(TopoDS::Vertex(vertex.Current())) : gp_Pnt();
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
        " near " + pointText(curve.IsNull() ? vertexOf(edge) : curve->Value(0.5 * (first + last)));
    return uses < 2 ? "the surface is not closed: an edge" + place +
                          " belongs to one face only; close the surface"
                    : "an edge" + place + " belongs to " + std::to_string(uses) +
                          " faces; a body has two at each edge: separate bodies that touch, remove "
                          "inner walls";
  }
  return "";
}

/// The shells of a shape, and its single faces without a shell as shells.
std::vector<TopoDS_Shell> shellsOf(const TopoDS_Shape& shape) {
  std::vector<TopoDS_Shell> result;
  for (TopExp_Explorer shells(shape, TopAbs_SHELL); shells.More(); shells.Next())
    result.push_back(TopoDS::Shell(shells.Current()));
  const BRep_Builder builder;
  for (TopExp_Explorer faces(shape, TopAbs_FACE, TopAbs_SHELL); faces.More(); faces.Next()) {
    TopoDS_Shell shell;
    builder.MakeShell(shell);
    builder.Add(shell, faces.Current());
    shell.Closed(Standard_True);
    result.push_back(shell);
  }
  return result;
}

TopoDS_Solid solidFromShells(const std::vector<TopoDS_Shell>& shells) {
  BRepBuilderAPI_MakeSolid maker;
  for (const TopoDS_Shell& shell : shells) maker.Add(shell);
  if (!maker.IsDone())
    throw ModelingError("its faces do not form a closed surface; close the surface");
  return maker.Solid();
}

std::string sewingNote(double gap) {
  return "Loose faces were sewn together; gaps up to " + shortNumberText(gap) + " mm were closed.";
}

/// Solids from closed shells: those inside an odd number of others are cavities of the innermost
/// one around them.
std::vector<TopoDS_Shape> solidsFromShells(const std::vector<TopoDS_Shell>& shells,
                                           const Job& job) {
  if (shells.size() == 1) return {solidFromShells(shells)};
  std::vector<TopoDS_Solid> filled;
  for (const TopoDS_Shell& shell : shells) {
    filled.push_back(solidFromShells({shell}));
    BRepLib::OrientClosedSolid(filled.back());
  }
  std::vector<std::vector<std::size_t>> around(shells.size());
  for (std::size_t outer = 0; outer < shells.size(); ++outer) {
    job.throwIfCancelled();
    BRepClass3d_SolidClassifier classifier(filled[outer]);
    for (std::size_t inner = 0; inner < shells.size(); ++inner) {
      const TopExp_Explorer vertex(shells[inner], TopAbs_VERTEX);
      if (inner == outer || !vertex.More()) continue;
      classifier.Perform(BRep_Tool::Pnt(TopoDS::Vertex(vertex.Current())), kInside);
      if (classifier.State() == TopAbs_IN) around[inner].push_back(outer);
    }
  }
  const BRep_Builder builder;
  for (std::size_t inner = 0; inner < shells.size(); ++inner) {
    if (around[inner].size() % 2 == 0) continue;
    for (const std::size_t outer : around[inner])
      if (around[outer].size() + 1 == around[inner].size()) {
        const TopoDS_Shape shell = TopExp_Explorer(filled[inner], TopAbs_SHELL).Current();
        builder.Add(filled[outer], shell.Reversed());
      }
  }
  std::vector<TopoDS_Shape> bodies;
  for (std::size_t i = 0; i < shells.size(); ++i)
    if (around[i].size() % 2 == 0) bodies.push_back(filled[i]);
  return bodies;
}

}  // namespace

CadSolids findSolids(const CadContent& content, double factor, const Job& job) {
  CadSolids found;
  found.faceNames = content.faceNames;
  const int faces = countOf(content.shape, TopAbs_FACE);
  if (faces == 0) throw ModelingError("contains no faces; export the part as a solid");
  TopTools_IndexedMapOfShape solids;
  TopExp::MapShapes(content.shape, TopAbs_SOLID, solids);
  int inSolids = 0;
  for (int i = 1; i <= solids.Extent(); ++i) {
    found.shapes.push_back(solids(i));
    const std::string* name = content.solidNames.Seek(solids(i));
    found.names.push_back(name ? *name : "");
    inSolids += countOf(solids(i), TopAbs_FACE);
  }
  if (found.shapes.empty()) {
    checkFaceCount(faces);
    const double gap = kSewing * diagonalOf(content.shape);
    const TopoDS_Shape sewn = sew(content.shape, gap, found.faceNames, job);
    const std::string open = openPlace(sewn);
    if (!open.empty()) throw ModelingError(open);
    found.shapes = solidsFromShells(shellsOf(sewn), job);
    found.names.resize(found.shapes.size());
    found.notes.push_back(sewingNote(factor * gap));
  } else if (inSolids < faces) {
    found.notes.push_back("Faces outside the solid were omitted.");
  }
  return found;
}

CadSolid closedSolid(const CadSolids& solids, std::size_t index, double factor, const Job& job) {
  CadSolid result;
  result.faceNames = solids.faceNames;
  result.notes = solids.notes;
  TopoDS_Shape shape = solids.shapes.at(index);
  checkFaceCount(countOf(shape, TopAbs_FACE));
  const double diagonal = diagonalOf(shape);
  job.throwIfCancelled();
  if (!openPlace(shape).empty()) {
    shape = sew(shape, kSewing * diagonal, result.faceNames, job);
    const std::string open = openPlace(shape);
    if (!open.empty()) throw ModelingError(open);
    shape = solidFromShells(shellsOf(shape));
    result.notes.push_back(sewingNote(factor * kSewing * diagonal));
  }
  if (!BRepCheck_Analyzer(shape).IsValid()) {
    shape = repair(shape, result.faceNames, job);
    if (countOf(shape, TopAbs_SOLID) == 0) shape = solidFromShells(shellsOf(shape));
    const std::string open = openPlace(shape);
    if (!open.empty()) throw ModelingError(open);
    result.notes.push_back("OpenCASCADE found faults in the shape and repaired it.");
  }
  job.throwIfCancelled();
  result.shape = TopoDS::Solid(TopExp_Explorer(shape, TopAbs_SOLID).Current());
  GProp_GProps properties;
  BRepGProp::VolumeProperties(result.shape, properties);
  if (!(std::abs(properties.Mass()) > kNoVolume * std::pow(diagonal, 3)))
    throw ModelingError("the solid near " + pointText(vertexOf(result.shape)) +
                        " encloses no volume; give it a thickness");
  if (properties.Mass() < 0.0) result.shape.Reverse();
  return result;
}

std::vector<std::string> uniqueFaceNames(const TopoDS_Shape& shape, const FaceNames& names) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  std::vector<std::string> found;
  for (int i = 1; i <= faces.Extent(); ++i) {
    const std::string* name = names.Seek(faces(i));
    found.push_back(name ? *name : "");
  }
  return uniqueNames(found, "face");
}

}  // namespace palpa::modeling
