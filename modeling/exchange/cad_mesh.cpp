#include "modeling/exchange/cad_mesh.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Eigen/Geometry>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <optional>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/exchange/chord_gaps.h"
#include "modeling/exchange/opencascade_session.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

constexpr double kAngle = 0.35;  // rad between neighbouring chords

Vector3d toEigen(const gp_Pnt& p) {
  return {p.X(), p.Y(), p.Z()};
}

/// Joins the triangles of all faces at common vertices.
class Joiner {
 public:
  explicit Joiner(const std::vector<std::string>& faceNames) : names_(faceNames) {}

  void add(const TopoDS_Face& face, int index) {
    TopLoc_Location location;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
    if (mesh.IsNull() || mesh->NbTriangles() == 0)
      throw ModelingError("OpenCASCADE cannot triangulate " + faceText(face, index));
    vertexOfNode_.assign(static_cast<std::size_t>(mesh->NbNodes()) + 1, -1);
    collapsed_.assign(vertexOfNode_.size(), -1);
    const auto position = [&](int node) {
      return toEigen(mesh->Node(node).Transformed(location.Transformation()));
    };
    for (TopExp_Explorer e(face.Oriented(TopAbs_FORWARD), TopAbs_EDGE); e.More(); e.Next())
      addEdge(TopoDS::Edge(e.Current()), mesh, location, position, faceText(face, index));
    for (int node = 1; node <= mesh->NbNodes(); ++node) {
      int& vertex = vertexOfNode_[node];
      if (vertex < 0) vertex = addPoint(position(node));
    }
    const BRepAdaptor_Surface surface(face, Standard_False);
    for (int t = 1; t <= mesh->NbTriangles(); ++t) {
      std::array<int, 3> nodes{};
      mesh->Triangle(t).Get(nodes[0], nodes[1], nodes[2]);
      if (face.Orientation() == TopAbs_REVERSED) std::swap(nodes[1], nodes[2]);
      const std::array triangle{vertexOfNode_[nodes[0]], vertexOfNode_[nodes[1]],
                                vertexOfNode_[nodes[2]]};
      // At a pole two corners coincide.
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
        continue;
      data_.triangles.push_back(triangle);
      data_.faceOfTriangle.push_back(index);
      gaps_.push_back(measure(surface, *mesh, nodes, triangle));
    }
  }

  MeshResult finish() {
    dropEmptyFaces();
    balanceGaps(data_, gaps_);
    return {MeshBody(std::move(data_)), deviation_};
  }

 private:
  std::string faceText(const TopoDS_Face& face, int index) const {
    const TopExp_Explorer vertex(face, TopAbs_VERTEX);
    const std::string place =
        vertex.More()
            ? " near " + placeText(toEigen(BRep_Tool::Pnt(TopoDS::Vertex(vertex.Current()))))
            : "";
    return "the face \"" + names_[index] + "\"" + place;
  }

  int addPoint(const Vector3d& p) {
    data_.positions.push_back(p);
    return static_cast<int>(data_.positions.size()) - 1;
  }

  /// The entry of a list for a shape; a new entry for a new shape. Shapes of swept bodies share
  /// their geometry at several locations, so the location is part of the key.
  template <class Entry>
  static Entry& entryOf(const TopoDS_Shape& shape, TopTools_IndexedMapOfShape& known,
                        std::vector<Entry>& entries) {
    const int index = known.Add(shape);
    entries.resize(static_cast<std::size_t>(known.Extent()));
    return entries[static_cast<std::size_t>(index) - 1];
  }

  /// Vertices at the nodes of an edge: its two ends, and the inner nodes in order.
  void addEdge(const TopoDS_Edge& edge, const Handle(Poly_Triangulation) & mesh,
               const TopLoc_Location& location, const auto& position, const std::string& face) {
    const Handle(Poly_PolygonOnTriangulation) polygon =
        BRep_Tool::PolygonOnTriangulation(edge, mesh, location);
    if (polygon.IsNull())
      throw ModelingError("OpenCASCADE left an edge without triangles at " + face);
    const int count = polygon->NbNodes();
    std::vector<int>& row = entryOf(edge, edges_, rowOfEdge_);
    if (row.empty()) {
      for (int i = 1; i <= count; ++i) {
        const int node = polygon->Node(i);
        if (i > 1 && i < count && !BRep_Tool::Degenerated(edge)) {
          row.push_back(addPoint(position(node)));
          continue;
        }
        const TopoDS_Vertex end =
            2 * i > count ? TopExp::LastVertex(edge) : TopExp::FirstVertex(edge);
        std::optional<int>& point = entryOf(end, ends_, pointOfEnd_);
        if (!point) point = addPoint(position(node));
        row.push_back(*point);
      }
    }
    if (static_cast<int>(row.size()) != count)
      throw ModelingError("OpenCASCADE divided an edge differently on its two sides at " + face);
    for (int i = 1; i <= count; ++i) vertexOfNode_[polygon->Node(i)] = row[i - 1];
    if (!BRep_Tool::Degenerated(edge) || !mesh->HasUVNodes()) return;
    const gp_XY along =
        mesh->UVNode(polygon->Node(count)).XY() - mesh->UVNode(polygon->Node(1)).XY();
    for (int i = 1; i <= count; ++i)
      collapsed_[polygon->Node(i)] = std::abs(along.X()) > std::abs(along.Y()) ? 0 : 1;
  }

  /// The mean distance of the surface from the flat triangle, positive outside; the largest one
  /// becomes the deviation. The middles of the sides give the mean of a quadratic surface exactly.
  double measure(const BRepAdaptor_Surface& surface, const Poly_Triangulation& mesh,
                 const std::array<int, 3>& nodes, const std::array<int, 3>& triangle) {
    if (!mesh.HasUVNodes() || surface.GetType() == GeomAbs_Plane) return 0.0;
    const auto& p = data_.positions;
    const Vector3d normal =
        (p[triangle[1]] - p[triangle[0]]).cross(p[triangle[2]] - p[triangle[0]]).normalized();
    std::array<gp_XY, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = mesh.UVNode(nodes[k]).XY();
    for (int k = 0; k < 3; ++k) {  // at a pole one parameter is arbitrary; the mean is used
      const int direction = collapsed_[nodes[k]];
      if (direction < 0) continue;
      const gp_XY middle = 0.5 * (corners[(k + 1) % 3] + corners[(k + 2) % 3]);
      corners[k].SetCoord(direction + 1, middle.Coord(direction + 1));
    }
    constexpr std::array<std::array<double, 3>, 4> kPlaces{
        {{1.0 / 3, 1.0 / 3, 1.0 / 3}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}}};
    double sum = 0.0;
    for (std::size_t i = 0; i < kPlaces.size(); ++i) {
      gp_XY uv;
      for (int k = 0; k < 3; ++k) uv += kPlaces[i][k] * corners[k];
      const double gap =
          normal.dot(toEigen(surface.Value(uv.X(), uv.Y())) - data_.positions[triangle[0]]);
      deviation_ = std::max(deviation_, std::abs(gap));
      if (i > 0) sum += gap;
    }
    return sum / 3.0;
  }

  /// Removes faces whose triangles were all degenerate: they have no part of the surface.
  void dropEmptyFaces() {
    std::vector<int> fresh(names_.size(), -1);
    for (const int face : data_.faceOfTriangle) fresh[face] = 0;
    for (std::size_t f = 0; f < names_.size(); ++f) {
      if (fresh[f] < 0) continue;
      fresh[f] = static_cast<int>(data_.faceNames.size());
      data_.faceNames.push_back(names_[f]);
    }
    for (int& face : data_.faceOfTriangle) face = fresh[face];
    // Removes the nodes that only such triangles used.
    std::vector<int> number(data_.positions.size(), -1);
    std::vector<Vector3d> positions;
    for (auto& triangle : data_.triangles)
      for (int& vertex : triangle) {
        if (number[vertex] < 0) {
          number[vertex] = static_cast<int>(positions.size());
          positions.push_back(data_.positions[vertex]);
        }
        vertex = number[vertex];
      }
    data_.positions = std::move(positions);
  }

  const std::vector<std::string>& names_;
  MeshBody::Data data_;
  std::vector<int> vertexOfNode_;
  std::vector<int> collapsed_;  // per node: the direction (0 u, 1 v) that is a pole there, or -1
  TopTools_IndexedMapOfShape edges_;
  std::vector<std::vector<int>> rowOfEdge_;  // one per edges_
  TopTools_IndexedMapOfShape ends_;
  std::vector<std::optional<int>> pointOfEnd_;  // one per ends_
  std::vector<double> gaps_;                    // mm, one per triangle
  double deviation_ = 0.0;
};

MeshResult attempt(const TopoDS_Solid& shape, const std::vector<std::string>& faceNames,
                   double chordTolerance, const Job& job) {
  BRepTools::Clean(shape);
  IMeshTools_Parameters parameters;
  parameters.Deflection = chordTolerance;
  parameters.Angle = kAngle;
  BRepMesh_IncrementalMesh mesher;
  mesher.SetShape(shape);
  mesher.ChangeParameters() = parameters;
  const auto progress = makeProgress(job, Phase::kTriangulate);
  mesher.Perform(progress->Start());
  job.throwIfCancelled();
  Joiner joiner(faceNames);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i) {
    job.throwIfCancelled();
    joiner.add(TopoDS::Face(faces(i)), i - 1);
  }
  return joiner.finish();
}

}  // namespace

MeshResult makeMeshBody(const TopoDS_Solid& shape, const std::vector<std::string>& faceNames,
                        double chordTolerance, const Job& job) {
  // In a coarse triangulation narrow faces may collapse, and OpenCASCADE sometimes exceeds the
  // chord tolerance. A smaller tolerance helps in both cases.
  constexpr int kMaxAttempts = 4;
  std::optional<MeshResult> best;
  std::string fault;
  double finer = chordTolerance;
  for (int i = 0; i < kMaxAttempts; ++i, finer /= 2.5) {
    try {
      MeshResult result = attempt(shape, faceNames, finer, job);
      if (!best || result.deviation < best->deviation) best = std::move(result);
      if (best->deviation <= chordTolerance) break;
    } catch (const ModelingError& error) {
      fault = error.what();
    }
  }
  if (!best)
    throw ModelingError("no closed triangulation was found: " + fault +
                        "; repair this face, or export the part as STL");
  return *best;
}

}  // namespace palpa::modeling
