#pragma once

#include <filesystem>
#include <optional>

namespace palpa::modeling {

/// The CAD file formats that can be read and written. Lengths are in mm when written; when read,
/// the file's unit is converted to mm (BREP files have none: mm).
enum class CadFormat {
  kStep,  ///< .step, .stp: ISO 10303-21, application protocol 214
  kIges,  ///< .iges, .igs: version 5.3, manifold solid B-rep
  kBrep,  ///< .brep: OpenCASCADE's own text format
};

inline constexpr const char* kCadFileEndings = ".step, .stp, .iges, .igs or .brep";

/// The format a file's ending (in any case) stands for.
std::optional<CadFormat> cadFormatOf(const std::filesystem::path& path);

}  // namespace palpa::modeling
