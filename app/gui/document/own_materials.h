#pragma once

#include <vector>

#include "app/gui/base/settings.h"
#include "modeling/project/material_library.h"

namespace palpa::gui {

/// The user's materials, kept in the preferences for all projects; each change is stored at once.
/// The note of a material is the source that the user gave; it has no reference.
class OwnMaterials {
 public:
  /// Damaged entries are left out.
  explicit OwnMaterials(Settings& settings);

  /// By name.
  const std::vector<modeling::LibraryMaterial>& list() const { return list_; }
  const modeling::LibraryMaterial* find(const std::string& name) const;

  /// Adds a material or replaces the one of its name.
  void put(modeling::LibraryMaterial material);
  /// False if there is no material `from`, or `to` is in use or empty.
  bool rename(const std::string& from, const std::string& to);
  void remove(const std::string& name);

 private:
  void store();

  Settings& settings_;
  std::vector<modeling::LibraryMaterial> list_;
};

/// True if the library has a material of this name.
bool isOfLibrary(const std::string& name);

/// The material of the library with the same name, otherwise the one nearest in Young's modulus,
/// among those with a density.
const modeling::LibraryMaterial& similarWithDensity(const modeling::Material& material);

}  // namespace palpa::gui
