#pragma once

#include <NCollection_DataMap.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS_Shape.hxx>
#include <filesystem>
#include <string>

#include "base/job.h"

// Internal to modeling/exchange/: only .cpp files include this header.
namespace palpa::modeling {

/// Names of faces, whatever their orientation; those without are absent.
using FaceNames = NCollection_DataMap<TopoDS_Shape, std::string, TopTools_ShapeMapHasher>;

/// What a CAD file holds, in mm.
struct CadContent {
  TopoDS_Shape shape;
  FaceNames faceNames;
};

/// The text of a CAD file, complete and well formed as far as checkCadText() can tell.
/// @throws ModelingError
std::string readCadText(const std::filesystem::path& path);

/// What OpenCASCADE makes of the file with this text. To be called within an OpenCascadeSession.
/// @throws ModelingError, Standard_Failure, Cancelled
CadContent readCad(const std::filesystem::path& path, const std::string& text, const Job& job);

}  // namespace palpa::modeling
