#include "tests/modeling/cad_shapes.h"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepOffsetAPI_MakePipe.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRep_Tool.hxx>
#include <GeomAPI_PointsToBSpline.hxx>
#include <Geom_BSplineCurve.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Wire.hxx>
#include <cmath>
#include <gp_Ax1.hxx>
#include <numbers>

namespace palpa::modeling::tests {
namespace {

TopoDS_Wire rectangle(double x, double y, double z) {
  BRepBuilderAPI_MakePolygon polygon(gp_Pnt(-x, -y, z), gp_Pnt(x, -y, z), gp_Pnt(x, y, z),
                                     gp_Pnt(-x, y, z), Standard_True);
  return polygon.Wire();
}

TopoDS_Face quad(const gp_Pnt& a, const gp_Pnt& b, const gp_Pnt& c, const gp_Pnt& d) {
  return BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakePolygon(a, b, c, d, Standard_True).Wire());
}

}  // namespace

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

TopoDS_Shape quarterPipe() {
  const TopoDS_Face wall =
      quad(gp_Pnt(10, 0, 0), gp_Pnt(16, 0, 0), gp_Pnt(16, 0, 25), gp_Pnt(10, 0, 25));
  return BRepPrimAPI_MakeRevol(wall, gp_Ax1(gp_Pnt(), gp_Dir(0, 0, 1)), std::numbers::pi / 2)
      .Shape();
}

TopoDS_Shape splitBox() {
  // A cube whose front consists of two faces: its top and bottom have five edges.
  BRepBuilderAPI_Sewing sewing(1e-6);
  const auto p = [](double x, double y, double z) { return gp_Pnt(x, y, z); };
  sewing.Add(quad(p(0, 0, 0), p(10, 0, 0), p(10, 0, 20), p(0, 0, 20)));
  sewing.Add(quad(p(10, 0, 0), p(20, 0, 0), p(20, 0, 20), p(10, 0, 20)));
  sewing.Add(quad(p(0, 20, 0), p(20, 20, 0), p(20, 20, 20), p(0, 20, 20)));
  sewing.Add(quad(p(0, 0, 0), p(0, 20, 0), p(0, 20, 20), p(0, 0, 20)));
  sewing.Add(quad(p(20, 0, 0), p(20, 20, 0), p(20, 20, 20), p(20, 0, 20)));
  for (const double z : {0.0, 20.0}) {
    BRepBuilderAPI_MakePolygon lid;
    for (const auto& [x, y] : {std::pair{0, 0}, {10, 0}, {20, 0}, {20, 20}, {0, 20}})
      lid.Add(p(x, y, z));
    lid.Close();
    sewing.Add(BRepBuilderAPI_MakeFace(lid.Wire()).Face());
  }
  sewing.Perform();
  return BRepBuilderAPI_MakeSolid(TopoDS::Shell(sewing.SewedShape())).Solid();
}

TopoDS_Shape perforatedPlate(int rows, int columns) {
  constexpr double kDistance = 12, kThickness = 10, kHole = 3, kRounding = 4;
  const TopoDS_Shape plate =
      BRepPrimAPI_MakeBox(kDistance * rows, kDistance * columns, kThickness).Shape();
  BRepFilletAPI_MakeFillet fillet(plate);
  for (TopExp_Explorer e(plate, TopAbs_EDGE); e.More(); e.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(e.Current());
    const gp_Pnt first = BRep_Tool::Pnt(TopExp::FirstVertex(edge));
    const gp_Pnt last = BRep_Tool::Pnt(TopExp::LastVertex(edge));
    if (std::abs(first.Z() - last.Z()) > 1) fillet.Add(kRounding, edge);
  }
  TopTools_ListOfShape bodies, holes;
  bodies.Append(fillet.Shape());
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const gp_Pnt at(kDistance * (row + 0.5), kDistance * (column + 0.5), 0);
      holes.Append(
          BRepPrimAPI_MakeCylinder(gp_Ax2(at, gp_Dir(0, 0, 1)), kHole, kThickness).Shape());
    }
  BRepAlgoAPI_Cut cut;
  cut.SetArguments(bodies);
  cut.SetTools(holes);
  cut.Build();
  return cut.Shape();
}

}  // namespace palpa::modeling::tests
