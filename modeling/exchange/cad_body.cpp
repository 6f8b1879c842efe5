#include "modeling/exchange/cad_body.h"

#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeUpgrade_ShapeDivideClosed.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <cmath>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/exchange/cad_mesh.h"
#include "modeling/exchange/cad_patches.h"
#include "modeling/exchange/cad_read.h"
#include "modeling/exchange/cad_solid.h"
#include "modeling/exchange/opencascade_session.h"
#include "modeling/mesh/mesh.h"

namespace palpa::modeling {
namespace {

constexpr double kTolerance = 1e-4;  // of the diagonal of the bounding box
constexpr double kRounding = 1e-9;   // of the diagonal: smaller deviations need no note
constexpr int kUsualNodes = 600;
constexpr double kChordsPerEdgeLength = 50.0;

double diagonalOf(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::AddClose(shape, box);
  return std::sqrt(box.SquareExtent());
}

double areaOf(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(shape, properties);
  return properties.Mass();
}

std::string facesText(int count) {
  return count == 1 ? "1 face" : std::to_string(count) + " faces";
}

struct Named {
  TopoDS_Solid shape;
  std::vector<std::string> faceNames;
  int divided = 0;  // number of divided faces
};

/// Divides faces that close on themselves (a whole cylinder, a whole torus) into halves, which can
/// become patches. Their names get a number.
Named divideClosed(const CadSolid& solid) {
  const std::vector<std::string> names = uniqueFaceNames(solid.shape, solid.faceNames);
  ShapeUpgrade_ShapeDivideClosed divider(solid.shape);
  divider.SetNbSplitPoints(1);
  divider.Perform();
  const TopoDS_Shape result = divider.Result();
  TopExp_Explorer found(result, TopAbs_SOLID);
  if (!found.More()) return {solid.shape, names, 0};
  Named named{TopoDS::Solid(found.Current()), {}, 0};
  FaceNames parts;
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(solid.shape, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i) {
    TopTools_IndexedMapOfShape pieces;
    TopExp::MapShapes(divider.GetContext()->Apply(faces(i)), TopAbs_FACE, pieces);
    for (int k = 1; k <= pieces.Extent(); ++k)
      parts.Bind(pieces(k), names[static_cast<std::size_t>(i) - 1]);
    if (pieces.Extent() > 1) ++named.divided;
  }
  named.faceNames = uniqueFaceNames(named.shape, parts);
  return named;
}

/// Sets the NUBS solid and returns an empty text, or returns the reason why there is none.
std::string tryPatches(const CadSolid& solid, double tolerance, const Job& job,
                       ImportedBody& imported) {
  try {
    const Named named = divideClosed(solid);
    job.throwIfCancelled();
    PatchResult result = makePatches(named.shape, named.faceNames, tolerance, job);
    imported.body = std::move(result.solid);
    imported.deviation = result.deviation;
    if (named.divided > 0)
      imported.notes.push_back(
          "Divided because a patch must not close on itself: " + facesText(named.divided) + ".");
    if (result.approximatedFaces > 0 && result.deviation > kRounding * diagonalOf(solid.shape))
      imported.notes.push_back("Approximated because they are not plain B-splines: " +
                               facesText(result.approximatedFaces) +
                               "; the patches differ by up to " +
                               shortNumberText(result.deviation) + " mm (tolerance " +
                               shortNumberText(tolerance) + " mm).");
    return "";
  } catch (const NoPatches& none) {
    return none.reason;
  } catch (const Standard_Failure& failure) {
    return std::string("OpenCASCADE cannot convert its surfaces (") +
           failure.DynamicType()->Name() + ")";
  }
}

void makeMesh(const CadSolid& solid, double edgeLength, const std::string& reason, const Job& job,
              ImportedBody& imported) {
  if (areaOf(solid.shape) / (edgeLength * edgeLength) > kMaxNodes)
    throw ModelingError("an edge length of " + numberText(edgeLength) +
                            " mm would need too many triangles; use a larger one",
                        ModelingError::Kind::kTooLarge);
  const double chordTolerance = edgeLength / kChordsPerEdgeLength;
  MeshResult result =
      makeMeshBody(solid.shape, uniqueFaceNames(solid.shape, solid.faceNames), chordTolerance, job);
  imported.body = std::move(result.body);
  imported.deviation = result.deviation;
  imported.notes.push_back(
      "The body became a mesh body, which can be supported and touched but has no control points, "
      "because " +
      reason + ".");
  if (result.deviation > 0.0)
    imported.notes.push_back("Flat triangles follow the curved faces within " +
                             shortNumberText(result.deviation) + " mm.");
}

ImportedBody convert(const CadContent& content, const ImportOptions& options, const Job& job) {
  const CadSolid solid = findSolid(content, job);
  ImportedBody imported;
  imported.notes = solid.notes;
  const double tolerance =
      options.tolerance > 0.0 ? options.tolerance : kTolerance * diagonalOf(solid.shape);
  const std::string reason = tryPatches(solid, tolerance, job, imported);
  if (reason.empty()) return imported;
  const double edgeLength =
      options.edgeLength > 0.0 ? options.edgeLength : std::sqrt(areaOf(solid.shape) / kUsualNodes);
  makeMesh(solid, edgeLength, reason, job, imported);
  return imported;
}

}  // namespace

ImportedBody readCadBody(const std::filesystem::path& path, const std::string& text,
                         const ImportOptions& options, const Job& job) {
  try {
    const CadContent content = readCad(path, text, job);
    try {
      return convert(content, options, job);
    } catch (const ModelingError& error) {
      throw ModelingError(path.string() + ": " + error.what(), error.kind());
    }
  } catch (...) {
    rethrowAsModelingError(path.string());
  }
}

}  // namespace palpa::modeling
