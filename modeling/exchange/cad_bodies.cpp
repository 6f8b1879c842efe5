#include "modeling/exchange/cad_bodies.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <cmath>

namespace palpa::modeling {
namespace {

constexpr double kCoarse = 0.01;       // of the diagonal: largest distance of a picture's triangles
constexpr double kCoarseAngle = 0.5;   // rad between neighbouring chords
constexpr int kMaxExactBoxFaces = 20;  // free-form ones; each takes a tenth of a second

bool isFreeForm(const TopoDS_Shape& face) {
  const GeomAbs_SurfaceType type = BRepAdaptor_Surface(TopoDS::Face(face), false).GetType();
  return type > GeomAbs_Torus;  // after plane, cylinder, cone and sphere
}

/// The box is exact, or, with many free-form faces, around their control points.
void measureBox(const TopoDS_Shape& shape, FileBody& body) {
  int freeForm = 0;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next())
    if (isFreeForm(faces.Current())) ++freeForm;
  Bnd_Box box;
  if (freeForm <= kMaxExactBoxFaces)
    BRepBndLib::AddOptimal(shape, box, Standard_False, Standard_False);
  else
    BRepBndLib::Add(shape, box, Standard_False);
  if (box.IsVoid()) return;
  box.SetGap(0.0);
  box.Get(body.low.x(), body.low.y(), body.low.z(), body.high.x(), body.high.y(), body.high.z());
}

void addTriangles(const TopoDS_Face& face, FileBody& body) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
  if (mesh.IsNull()) return;
  const int first = static_cast<int>(body.positions.size()) - 1;  // nodes count from 1
  for (int i = 1; i <= mesh->NbNodes(); ++i) {
    const gp_Pnt p = mesh->Node(i).Transformed(location.Transformation());
    body.positions.emplace_back(p.X(), p.Y(), p.Z());
  }
  for (int t = 1; t <= mesh->NbTriangles(); ++t) {
    std::array<int, 3> nodes{};
    mesh->Triangle(t).Get(nodes[0], nodes[1], nodes[2]);
    if (face.Orientation() == TopAbs_REVERSED) std::swap(nodes[1], nodes[2]);
    body.surface.push_back({first + nodes[0], first + nodes[1], first + nodes[2]});
  }
}

/// Without effect if OpenCASCADE cannot triangulate the shape: the picture then lacks it.
void addSurface(const TopoDS_Shape& shape, const Job& job, FileBody& body) try {
  const double size = body.size().norm();
  if (!(size > 0.0)) return;
  BRepMesh_IncrementalMesh(shape, kCoarse * size, Standard_False, kCoarseAngle);
  job.throwIfCancelled();
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next())
    addTriangles(TopoDS::Face(faces.Current()), body);
} catch (const Standard_Failure&) {
  body.positions.clear();
  body.surface.clear();
}

}  // namespace

FileBodies nameSolids(const CadContent& content, const CadSolids& solids) {
  FileBodies found;
  found.unit = content.unit;
  found.statesUnit = content.statesUnit;
  found.bodies.resize(solids.shapes.size());
  for (std::size_t i = 0; i < solids.shapes.size(); ++i) found.bodies[i].name = solids.names[i];
  makeNamesUnique(found.bodies);
  return found;
}

FileBodies describeSolids(const CadContent& content, const CadSolids& solids, ListedSurface surface,
                          const Job& job) {
  FileBodies found = nameSolids(content, solids);
  for (std::size_t i = 0; i < solids.shapes.size(); ++i) {
    job.throwIfCancelled();
    const TopoDS_Shape& shape = solids.shapes[i];
    FileBody& body = found.bodies[i];
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    body.faces = faces.Extent();
    measureBox(shape, body);
    GProp_GProps properties;
    BRepGProp::VolumeProperties(shape, properties);
    body.volume = std::abs(properties.Mass());
    if (surface == ListedSurface::kCoarse) addSurface(shape, job, body);
  }
  return found;
}

}  // namespace palpa::modeling
