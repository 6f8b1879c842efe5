#pragma once

#include <TopoDS_Shape.hxx>
#include <filesystem>
#include <map>
#include <string>

#include "modeling/job.h"

// Internal to modeling/exchange/: only .cpp files include this header.
namespace palpa::modeling {

/// What a CAD file holds, in mm.
struct CadContent {
  TopoDS_Shape shape;
  /// Names of faces, by their underlying shape (TopoDS_Shape::TShape()); those without are absent.
  std::map<const void*, std::string> faceNames;
};

/// Reads a file. To be called within an OpenCascadeSession; the file's text has been checked before
/// it reaches OpenCASCADE (cad_text_check.h).
/// @throws ModelingError, Standard_Failure, Cancelled
CadContent readCad(const std::filesystem::path& path, const Job& job);

}  // namespace palpa::modeling
