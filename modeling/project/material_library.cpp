#include "modeling/project/material_library.h"

#include <algorithm>
#include <cctype>

#include "modeling/error.h"
#include "modeling/project/json_values.h"

namespace palpa::modeling {

extern const char* const kMaterials;  // resources/materials.json

namespace {

std::vector<LibraryMaterial> read() {
  std::vector<LibraryMaterial> library;
  const nlohmann::json document = nlohmann::json::parse(kMaterials);
  for (const auto& entry : document.at("materials"))
    library.push_back({materialFrom(entry), entry.at("note"), entry.at("reference")});
  return library;
}

bool sameLetters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

}  // namespace

const std::vector<LibraryMaterial>& materialLibrary() {
  static const std::vector<LibraryMaterial> library = read();
  return library;
}

const LibraryMaterial& libraryMaterial(std::string_view name) {
  std::string known;
  for (const LibraryMaterial& entry : materialLibrary()) {
    if (sameLetters(entry.material.name, name)) return entry;
    known += (known.empty() ? "\"" : ", \"") + entry.material.name + "\"";
  }
  throw ModelingError("no material is named \"" + std::string(name) + "\"; known are " + known,
                      ModelingError::Kind::kNotFound);
}

}  // namespace palpa::modeling
