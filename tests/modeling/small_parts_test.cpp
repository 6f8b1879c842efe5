#include "modeling/mesh/small_parts.h"

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Tool.hxx>
#include <Eigen/Geometry>
#include <Poly_Triangulation.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <gp_Ax2.hxx>
#include <map>
#include <numbers>
#include <tuple>

#include "mesh_checks.h"
#include "modeling/body/mesh_body.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/mesh_foci.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

/// Flat triangles of a shape; a face of the shape is a face of the body.
FacedTriangles trianglesOf(const TopoDS_Shape& shape) {
  BRepMesh_IncrementalMesh(shape, 0.02);
  FacedTriangles surface;
  std::map<std::tuple<long, long, long>, int> known;
  int face = 0;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next(), ++face) {
    TopLoc_Location location;
    const auto triangulation = BRep_Tool::Triangulation(TopoDS::Face(faces.Current()), location);
    std::vector<int> number(1);
    for (int i = 1; i <= triangulation->NbNodes(); ++i) {
      const gp_Pnt p = triangulation->Node(i).Transformed(location);
      const auto rounded = [](double x) { return std::lround(x * 1e6); };
      const auto [at, isNew] =
          known.emplace(std::tuple(rounded(p.X()), rounded(p.Y()), rounded(p.Z())),
                        static_cast<int>(surface.positions.size()));
      if (isNew) surface.positions.emplace_back(p.X(), p.Y(), p.Z());
      number.push_back(at->second);
    }
    for (int t = 1; t <= triangulation->NbTriangles(); ++t) {
      int a = 0, b = 0, c = 0;
      triangulation->Triangle(t).Get(a, b, c);
      if (faces.Current().Orientation() == TopAbs_REVERSED) std::swap(b, c);
      surface.triangles.push_back({number[a], number[b], number[c]});
      surface.faceOfTriangle.push_back(face);
    }
  }
  return surface;
}

/// Checks the invariants of a mesh body on the way.
double volumeOf(const FacedTriangles& surface) {
  MeshBody::Data data{surface.positions, surface.triangles, {}, {"all"}};
  data.faceOfTriangle.assign(surface.triangles.size(), 0);
  return volume(MeshBody(std::move(data)));
}

LengthAt everywhere(double length) {
  return [length](const Vector3d&) { return length; };
}

/// 20 × 10 × 5.
TopoDS_Shape block() {
  return BRepPrimAPI_MakeBox(20, 10, 5).Shape();
}

/// A block with a square pin of 0.8 × 0.6 on top, 4 long, which carries a thinner one.
TopoDS_Shape pinned() {
  const TopoDS_Shape pin = BRepPrimAPI_MakeBox(gp_Pnt(5, 5, 4), 0.8, 0.6, 5).Shape();
  const TopoDS_Shape tip = BRepPrimAPI_MakeBox(gp_Pnt(5.2, 5.2, 8), 0.3, 0.3, 3).Shape();
  return BRepAlgoAPI_Fuse(BRepAlgoAPI_Fuse(block(), pin).Shape(), tip).Shape();
}

TopoDS_Shape drill(double x, double radius, double from, double length) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, 5, from), gp_Dir(0, 0, 1)), radius, length)
      .Shape();
}

TEST(SmallParts, ThinPinsAreCutOff) {
  const WithoutSmallParts result = withoutSmallParts(trianglesOf(pinned()), everywhere(1), {});
  EXPECT_GE(result.pins, 1);
  EXPECT_EQ(result.holes, 0);
  EXPECT_NEAR(volumeOf(result.surface), 1000, 1e-9);
  for (const Vector3d& x : result.surface.positions) EXPECT_LE(x.z(), 5 + 1e-9);
}

TEST(SmallParts, ThickPinsStay) {
  const FacedTriangles surface = trianglesOf(pinned());
  // The mean thickness of the thick pin is 0.67.
  const WithoutSmallParts result = withoutSmallParts(surface, everywhere(0.5), {});
  EXPECT_EQ(result.pins, 1);
  EXPECT_NEAR(volumeOf(result.surface), 1000 + 0.8 * 0.6 * 4, 1e-9);
  EXPECT_EQ(withoutSmallParts(surface, everywhere(0.1), {}).pins, 0);
}

TEST(SmallParts, NamedPinsStay) {
  const FacedTriangles surface = trianglesOf(pinned());
  std::set<int> tops;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (surface.positions[surface.triangles[t][0]].z() > 10) tops.insert(surface.faceOfTriangle[t]);
  const WithoutSmallParts result = withoutSmallParts(surface, everywhere(1), tops);
  EXPECT_EQ(result.pins, 0);
  EXPECT_EQ(result.surface.triangles, surface.triangles);
}

TEST(SmallParts, PlatesStay) {
  const TopoDS_Shape fin = BRepPrimAPI_MakeBox(gp_Pnt(5, 5, 4), 6, 0.4, 5).Shape();
  const TopoDS_Shape neck = BRepPrimAPI_MakeBox(gp_Pnt(8, 5, 4), 0.4, 0.4, 3).Shape();
  const TopoDS_Shape plate = BRepPrimAPI_MakeBox(gp_Pnt(5, 5, 6), 6, 0.4, 6).Shape();
  const TopoDS_Shape paddle = BRepAlgoAPI_Fuse(neck, plate).Shape();
  for (const TopoDS_Shape& added : {fin, paddle}) {
    const FacedTriangles surface = trianglesOf(BRepAlgoAPI_Fuse(block(), added).Shape());
    EXPECT_EQ(withoutSmallParts(surface, everywhere(1), {}).pins, 0);
  }
}

TEST(SmallParts, NarrowHolesAreFilled) {
  const TopoDS_Shape blind = BRepAlgoAPI_Cut(block(), drill(5, 0.4, 3, 5)).Shape();
  const TopoDS_Shape both = BRepAlgoAPI_Cut(blind, drill(12, 0.4, -1, 10)).Shape();
  const FacedTriangles surface = trianglesOf(both);
  const WithoutSmallParts result = withoutSmallParts(surface, everywhere(1), {});
  EXPECT_EQ(result.pins, 0);
  EXPECT_EQ(result.holes, 2);
  EXPECT_NEAR(volumeOf(result.surface), 1000, 1e-9);
  EXPECT_EQ(withoutSmallParts(surface, everywhere(0.4), {}).holes, 0);
}

TEST(SmallParts, HolesIntoAChamberStay) {
  // Filling the narrow hole would leave a cavity.
  const TopoDS_Shape chamber = BRepPrimAPI_MakeBox(gp_Pnt(3, 3, 1), 4, 4, 3).Shape();
  const TopoDS_Shape hollow = BRepAlgoAPI_Cut(block(), chamber).Shape();
  const FacedTriangles surface = trianglesOf(BRepAlgoAPI_Cut(hollow, drill(5, 0.4, 3, 5)).Shape());
  const WithoutSmallParts result = withoutSmallParts(surface, everywhere(1), {});
  EXPECT_EQ(result.holes, 0);
  EXPECT_EQ(result.surface.triangles, surface.triangles);
}

TEST(SmallParts, AFlatEndBelongsToTheFaceAroundIt) {
  const FacedTriangles surface = trianglesOf(pinned());
  int top = -1;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    const auto& p = surface.positions;
    if (p[a].z() > 4.99 && p[a].z() < 5.01 && p[b].z() == p[a].z() && p[c].z() == p[a].z())
      top = surface.faceOfTriangle[t];
  }
  const auto areaOfTop = [&](const FacedTriangles& of) {
    double area = 0;
    for (std::size_t t = 0; t < of.triangles.size(); ++t) {
      if (of.faceOfTriangle[t] != top) continue;
      const auto& [a, b, c] = of.triangles[t];
      const auto& p = of.positions;
      area += (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2;
    }
    return area;
  };
  EXPECT_NEAR(areaOfTop(withoutSmallParts(surface, everywhere(1), {}).surface), 200, 1e-9);
  // A supported face keeps its border.
  EXPECT_NEAR(areaOfTop(withoutSmallParts(surface, everywhere(1), {top}).surface), 200 - 0.48,
              1e-9);
}

TEST(SmallParts, AMeshReportsThem) {
  const FacedTriangles surface = trianglesOf(pinned());
  MeshBody::Data data{surface.positions, surface.triangles, {}, {"all"}};
  data.faceOfTriangle.assign(surface.triangles.size(), 0);
  MeshSettings settings;
  settings.edgeLength = 4;
  settings.engine = Engine::kTriangles;
  const MeshBody body(std::move(data));
  const SurfaceMesh without = mesh(body, settings);
  EXPECT_GE(without.simplification.cutPins, 1);
  EXPECT_EQ(without.simplification.partsBelow, settings.featureFraction * settings.edgeLength);
  EXPECT_NEAR(checks::enclosedVolume(without), 1000, 1e-6);
  const MeshFocus focus{{5.4, 5.3, 10}, 1, 0.4};
  const SurfaceMesh touched = mesh(body, settings, {}, {}, {{focus}});
  EXPECT_EQ(touched.simplification.cutPins, 0);
  EXPECT_GT(checks::enclosedVolume(touched), 1001.5);
  // So does a touch that is too wide to need a finer mesh.
  Project project;
  project.body = body;
  project.mesh = settings;
  project.touches.push_back({"wide", focus.center, TouchKind::kGrab, {0, 0, -1}, 15.0});
  EXPECT_EQ(mesh(body, settings, {}, {}, meshFoci(project)).simplification.cutPins, 0);
}

}  // namespace
}  // namespace palpa::modeling
