#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "modeling/project/project.h"

namespace palpa::modeling {

/// A material with the source of its constants (resources/materials.json, built into the library).
struct LibraryMaterial {
  Material material;
  std::string note;       ///< how the constants were obtained, what was assumed
  std::string reference;  ///< where they were published
};

/// All materials of the library, in the order of the file. Names are unique.
const std::vector<LibraryMaterial>& materialLibrary();

/// The material with this name, upper and lower case regarded as equal.
/// @throws ModelingError (notFound) that lists the known names
const LibraryMaterial& libraryMaterial(std::string_view name);

}  // namespace palpa::modeling
