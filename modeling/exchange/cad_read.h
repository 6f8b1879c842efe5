#pragma once

#include <NCollection_DataMap.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS_Shape.hxx>
#include <filesystem>
#include <string>

#include "base/job.h"

// Internal to modeling/exchange/: only .cpp files include this header.
namespace palpa::modeling {

/// Names of shapes, independent of their orientation; shapes without a name are absent.
using ShapeNames = NCollection_DataMap<TopoDS_Shape, std::string, TopTools_ShapeMapHasher>;
using FaceNames = ShapeNames;

/// Content of a CAD file, in mm.
struct CadContent {
  TopoDS_Shape shape;
  FaceNames faceNames;
  ShapeNames solidNames;
  double unit = 1.0;        ///< mm per unit of length of the file; 0: parts in different units
  bool statesUnit = false;  ///< false for BREP files
};

/// The text of a CAD file after checkCadText().
/// Throws ModelingError if the file cannot be read or fails the check.
std::string readCadText(const std::filesystem::path& path);

/// Content of the file `path` with this text, from OpenCASCADE's readers. The caller must hold an
/// OpenCascadeSession. Throws ModelingError, Standard_Failure, Cancelled.
CadContent readCad(const std::filesystem::path& path, const std::string& text, const Job& job);

}  // namespace palpa::modeling
