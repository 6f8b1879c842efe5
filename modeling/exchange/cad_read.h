#pragma once

#include <NCollection_DataMap.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS_Shape.hxx>
#include <filesystem>
#include <string>

#include "modeling/job.h"

// Internal to modeling/exchange/: only .cpp files include this header.
namespace palpa::modeling {

/// Names of faces, whatever their orientation; those without are absent.
using FaceNames = NCollection_DataMap<TopoDS_Shape, std::string, TopTools_ShapeMapHasher>;

/// What a CAD file holds, in mm.
struct CadContent {
  TopoDS_Shape shape;
  FaceNames faceNames;
};

/// Reads a file. To be called within an OpenCascadeSession; the file's text has been checked before
/// it reaches OpenCASCADE (cad_text_check.h).
/// @throws ModelingError, Standard_Failure, Cancelled
CadContent readCad(const std::filesystem::path& path, const Job& job);

}  // namespace palpa::modeling
