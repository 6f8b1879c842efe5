#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "modeling/project/project.h"

namespace palpa::modeling {

/// A material with the source of its constants (resources/materials.json, built into the library).
struct LibraryMaterial {
  Material material;
  std::string note;       ///< origin of the constants, assumptions
  std::string reference;  ///< publication
};

/// All materials of the library, in the order of the file. Names are unique.
const std::vector<LibraryMaterial>& materialLibrary();

/// The material with this name, ignoring upper and lower case.
/// Throws ModelingError (notFound) that lists the known names if there is none.
const LibraryMaterial& libraryMaterial(std::string_view name);

}  // namespace palpa::modeling
