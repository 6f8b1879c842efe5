#include "modeling/exchange/cad_import.h"

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepOffsetAPI_MakePipe.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepPrimAPI_MakeWedge.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GeomAPI_PointsToBSpline.hxx>
#include <Geom_BSplineCurve.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <gp_Ax1.hxx>
#include <gp_Ax2.hxx>
#include <iostream>
#include <numbers>

#include "modeling/error.h"
#include "modeling/solid/surface_properties.h"
#include "tests/modeling/cad_files.h"

namespace palpa::modeling {
namespace {

using tests::Folder;

TopoDS_Wire rectangle(double x, double y, double z) {
  BRepBuilderAPI_MakePolygon polygon(gp_Pnt(-x, -y, z), gp_Pnt(x, -y, z), gp_Pnt(x, y, z),
                                     gp_Pnt(-x, y, z), Standard_True);
  return polygon.Wire();
}

TopoDS_Shape filletedBox() {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(40.0, 30.0, 20.0).Shape();
  BRepFilletAPI_MakeFillet fillet(box);
  for (TopExp_Explorer e(box, TopAbs_EDGE); e.More(); e.Next())
    fillet.Add(3.0, TopoDS::Edge(e.Current()));
  return fillet.Shape();
}

TopoDS_Shape boredCylinder() {
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(20.0, 30.0).Shape(),
                         BRepPrimAPI_MakeCylinder(8.0, 30.0).Shape())
      .Shape();
}

TopoDS_Shape sweptRectangle() {
  TColgp_Array1OfPnt points(1, 4);
  points(1) = gp_Pnt(0, 0, 0);
  points(2) = gp_Pnt(0, 0, 20);
  points(3) = gp_Pnt(8, 0, 40);
  points(4) = gp_Pnt(24, 0, 55);
  const Handle(Geom_BSplineCurve) spine = GeomAPI_PointsToBSpline(points).Curve();
  const TopoDS_Wire path = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(spine)).Wire();
  return BRepOffsetAPI_MakePipe(path, BRepBuilderAPI_MakeFace(rectangle(5, 4, 0)).Face()).Shape();
}

TopoDS_Shape loft() {
  BRepOffsetAPI_ThruSections sections(Standard_True);
  sections.AddWire(rectangle(10, 10, 0));
  sections.AddWire(rectangle(14, 8, 15));
  sections.AddWire(rectangle(9, 12, 30));
  return sections.Shape();
}

/// A quarter of a pipe with a rectangular wall.
TopoDS_Shape quarterPipe() {
  BRepBuilderAPI_MakePolygon wall(gp_Pnt(10, 0, 0), gp_Pnt(16, 0, 0), gp_Pnt(16, 0, 25),
                                  gp_Pnt(10, 0, 25), Standard_True);
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(wall.Wire()).Face(),
                               gp_Ax1(gp_Pnt(), gp_Dir(0, 0, 1)), std::numbers::pi / 2)
      .Shape();
}

TopoDS_Shape wholeRing() {
  BRepBuilderAPI_MakePolygon wall(gp_Pnt(10, 0, 0), gp_Pnt(16, 0, 0), gp_Pnt(16, 0, 25),
                                  gp_Pnt(10, 0, 25), Standard_True);
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(wall.Wire()).Face(),
                               gp_Ax1(gp_Pnt(), gp_Dir(0, 0, 1)))
      .Shape();
}

std::vector<std::pair<std::string, TopoDS_Shape>> shapes() {
  return {{"box", BRepPrimAPI_MakeBox(40.0, 30.0, 20.0).Shape()},
          {"wedge", BRepPrimAPI_MakeWedge(40.0, 30.0, 20.0, 10.0, 5.0, 30.0, 15.0).Shape()},
          {"quarter pipe", quarterPipe()},
          {"swept rectangle", sweptRectangle()},
          {"loft", loft()},
          {"torus", BRepPrimAPI_MakeTorus(25.0, 8.0).Shape()},
          {"ring", wholeRing()},
          {"cylinder", BRepPrimAPI_MakeCylinder(15.0, 40.0).Shape()},
          {"cone", BRepPrimAPI_MakeCone(15.0, 5.0, 40.0).Shape()},
          {"sphere", BRepPrimAPI_MakeSphere(25.0).Shape()},
          {"filleted box", filletedBox()},
          {"bored cylinder", boredCylinder()}};
}

TEST(CadImport, Explore) {
  const Folder folder;
  for (const auto& [name, shape] : shapes())
    for (const char* format : {"a.step", "a.igs", "a.brep"}) {
      tests::writeForeign(shape, folder.file(format));
      try {
        const ImportedBody read = importCad(folder.file(format));
        const bool solid = std::holds_alternative<Solid>(read.body);
        std::cout << name << " " << format << ": " << (solid ? "solid" : "mesh") << " "
                  << (solid ? std::get<Solid>(read.body).controlPoints().size()
                            : std::get<MeshBody>(read.body).positions().size())
                  << " dev " << read.deviation << " V " << volume(read.body) << " / "
                  << tests::volumeOf(shape) << " patches "
                  << quotedPatchNames(read.body).substr(0, 120) << "\n";
        for (const auto& note : read.notes) std::cout << "    " << note << "\n";
      } catch (const ModelingError& error) {
        std::cout << name << " " << format << ": ERROR " << error.what() << "\n";
      }
    }
}

}  // namespace
}  // namespace palpa::modeling
