#pragma once

#include <STEPControl_Reader.hxx>
#include <TopoDS_Shape.hxx>

#include "modeling/exchange/cad_read.h"

// Internal to modeling/exchange/: only .cpp files include this header.
namespace palpa::modeling {

/// Names of the solids of a shape that the reader has transferred: of the product, if the solid is
/// the only one of it; otherwise of the solid, or of the product if the solid has no name.
ShapeNames stepSolidNames(const STEPControl_Reader& reader, const TopoDS_Shape& shape);

/// Names of the faces of the shape, also where an assembly has moved them.
ShapeNames stepFaceNames(const STEPControl_Reader& reader, const TopoDS_Shape& shape);

/// mm per unit of length of the file; 0 if its parts have different units.
double stepLengthUnit(const STEPControl_Reader& reader);

}  // namespace palpa::modeling
