#pragma once

#include <TopoDS_Shape.hxx>
#include <string>

namespace palpa::modeling::tests {

// Bodies as made by other programs, lengths in mm.

TopoDS_Shape filletedBox();     ///< 40 × 30 × 20, all edges rounded with radius 3
TopoDS_Shape boredCylinder();   ///< radius 20, bore 8, height 30
TopoDS_Shape sweptRectangle();  ///< 10 × 8 along a plane spline
TopoDS_Shape loft();            ///< through three rectangles
TopoDS_Shape quarterPipe();     ///< radii 10 and 16, height 25, 90 degrees
TopoDS_Shape splitBox();        ///< 20 × 20 × 20, front divided into two faces of 10 × 20
/// Plate 10 thick with rows × columns holes of radius 3, 12 apart; the vertical edges are rounded.
TopoDS_Shape perforatedPlate(int rows, int columns);

}  // namespace palpa::modeling::tests
