#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/core/results/body_section.h"
#include "modeling/exchange/mesh_writer.h"

namespace palpa::app {

/// Table of the states at the points of a section: position at rest (mm), displacement (mm),
/// stress (MPa, global axes), strain, principal stresses, mean stress and von Mises stress.
std::string sectionTable(const BodySection& section, const std::vector<bem::InteriorState>& states);

/// The section at rest as a mesh with the same numbers.
modeling::MeshFile sectionMesh(const BodySection& section,
                               const std::vector<bem::InteriorState>& states);

/// Writes the table (.csv) or the mesh (any other ending). Throws ModelingError or FileError.
void writeSection(const BodySection& section, const std::vector<bem::InteriorState>& states,
                  const std::filesystem::path& path);

}  // namespace palpa::app
