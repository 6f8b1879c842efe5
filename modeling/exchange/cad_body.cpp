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
#include "modeling/exchange/cad_bodies.h"
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
std::string tryPatches(const CadSolid& solid, double tolerance, double factor, const Job& job,
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
                               shortNumberText(factor * result.deviation) + " mm (tolerance " +
                               shortNumberText(factor * tolerance) + " mm).");
    return "";
  } catch (const NoPatches& none) {
    return none.reason;
  } catch (const Standard_Failure& failure) {
    return std::string("OpenCASCADE cannot convert its surfaces (") +
           failure.DynamicType()->Name() + ")";
  }
}

void makeMesh(const CadSolid& solid, double edgeLength, double factor, const std::string& reason,
              const Job& job, ImportedBody& imported) {
  if (areaOf(solid.shape) / (edgeLength * edgeLength) > kMaxNodes)
    throw ModelingError("an edge length of " + numberText(factor * edgeLength) +
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
                             shortNumberText(factor * result.deviation) + " mm.");
}

/// Name and note of one of several solids.
void describeChoice(const FileBodies& found, std::size_t index, const std::filesystem::path& path,
                    ImportedBody& imported) {
  if (found.bodies.size() == 1) return;
  imported.name = projectName(found.bodies[index], path);
  imported.notes.push_back(chosenNote(found, index));
}

/// Index of the chosen solid. Sets its name and a note if there are several.
std::size_t choose(const CadContent& content, const CadSolids& solids, const ImportOptions& options,
                   double factor, const std::filesystem::path& path, const Job& job,
                   ImportedBody& imported) {
  if (solids.shapes.size() == 1 && options.solid.empty()) return 0;
  FileBodies found = nameSolids(content, solids);
  const std::size_t index = [&] {
    if (const auto named = findBody(found, options.solid)) return *named;
    // Only the message needs sizes, which may take seconds.
    found = describeSolids(content, solids, ListedSurface::kNone, job);
    place(found, factor, options.placement.up);
    return chooseBody(found, options.solid);
  }();
  describeChoice(found, index, path, imported);
  return index;
}

/// Approximates and meshes in the unit of the file as it was read; `factor` turns lengths there
/// into lengths of the placed body.
void convert(const CadSolids& solids, std::size_t index, const ImportOptions& options,
             double factor, const Job& job, ImportedBody& imported) {
  const CadSolid solid = closedSolid(solids, index, factor, job);
  imported.notes.insert(imported.notes.end(), solid.notes.begin(), solid.notes.end());
  const double tolerance =
      options.tolerance > 0.0 ? options.tolerance / factor : kTolerance * diagonalOf(solid.shape);
  const std::string reason = tryPatches(solid, tolerance, factor, job, imported);
  if (!reason.empty()) {
    const double edgeLength = options.edgeLength > 0.0
                                  ? options.edgeLength / factor
                                  : std::sqrt(areaOf(solid.shape) / kUsualNodes);
    makeMesh(solid, edgeLength, factor, reason, job, imported);
  }
  imported.deviation *= factor;
  imported.body = placed(imported.body, factor, options.placement.up);
}

ImportedBody convertChosen(const CadContent& content, const ImportOptions& options,
                           const std::filesystem::path& path, const Job& job) {
  ImportedBody imported;
  const double factor = options.placement.factor(content.unit);
  const CadSolids solids = findSolids(content, factor, job);
  const std::size_t index = choose(content, solids, options, factor, path, job, imported);
  convert(solids, index, options, factor, job, imported);
  return imported;
}

/// Runs `work`; errors begin with the file's name.
auto withName(const std::filesystem::path& path, const auto& work) {
  try {
    return work();
  } catch (const SeveralBodies& several) {
    throw SeveralBodies(path.string() + ": ", several.found());
  } catch (const ModelingError& error) {
    throw ModelingError(path.string() + ": " + error.what(), error.kind());
  }
}

/// The body that `work` returns, or the problem of one solid.
BodyOutcome outcomeOf(const std::filesystem::path& path, const auto& work) {
  try {
    try {
      return {withName(path, work), ""};
    } catch (...) {
      rethrowAsModelingError(path.string());
    }
  } catch (const ModelingError& error) {
    return {std::nullopt, error.what()};
  }
}

}  // namespace

ImportedBody readCadBody(const std::filesystem::path& path, const std::string& text,
                         const ImportOptions& options, const Job& job) {
  try {
    const CadContent content = readCad(path, text, job);
    return withName(path, [&] { return convertChosen(content, options, path, job); });
  } catch (...) {
    rethrowAsModelingError(path.string());
  }
}

void readCadBodies(const std::filesystem::path& path, const std::string& text,
                   const ImportOptions& options, const std::function<bool(std::size_t)>& wants,
                   const TakeBody& take, const Job& job) {
  try {
    const CadContent content = readCad(path, text, job);
    const double factor = withName(path, [&] { return options.placement.factor(content.unit); });
    const CadSolids solids = withName(path, [&] { return findSolids(content, factor, job); });
    const FileBodies found = nameSolids(content, solids);
    for (std::size_t i = 0; i < solids.shapes.size(); ++i) {
      if (!wants(i)) continue;
      BodyOutcome outcome = outcomeOf(path, [&] {
        ImportedBody imported;
        describeChoice(found, i, path, imported);
        convert(solids, i, options, factor, job, imported);
        return imported;
      });
      take(i, std::move(outcome));
    }
  } catch (...) {
    rethrowAsModelingError(path.string());
  }
}

FileBodies listCadBodies(const std::filesystem::path& path, const std::string& text,
                         ListedSurface surface, const Job& job) {
  try {
    const CadContent content = readCad(path, text, job);
    return withName(
        path, [&] { return describeSolids(content, findSolids(content, 1.0, job), surface, job); });
  } catch (...) {
    rethrowAsModelingError(path.string());
  }
}

}  // namespace palpa::modeling
