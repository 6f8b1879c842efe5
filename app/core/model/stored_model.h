#pragma once

#include <filesystem>
#include <memory>

#include "bem/problem/discretisation.h"

namespace palpa::app {

/// Solved models in separate files, which another program than the one that reads them may have
/// computed, on another machine: the results of palpa-mpi. A file has the mesh, conditions and
/// material that its equations belong to, then operators and factors. Compressed problems of
/// quadratic triangles only.

/// Where a model is looked for that belongs to a project: `bracket.json` -> `bracket.model`.
std::filesystem::path storedModelBeside(const std::filesystem::path& project);

/// Replaces the file, or makes it, when it is complete. Throws FileError, Cancelled.
void writeStoredModel(const std::filesystem::path& path, const bem::Discretisation& discretisation,
                      const bem::ProblemInputs& inputs, const bem::ReferenceProblem& problem,
                      const Job& job);

/// Whether a file is there and belongs to a problem: the same triangles, conditions and material,
/// and nodes that differ by rounding at most.
enum class StoredModelFit { kMissing, kDamaged, kOther, kFits };

struct StoredModel {
  StoredModelFit fit = StoredModelFit::kMissing;
  std::unique_ptr<bem::ReferenceProblem> problem;  ///< if it fits
};
/// Reads a file if it fits; what does not is found at its beginning. Throws Cancelled,
/// std::bad_alloc.
StoredModel readStoredModel(const std::filesystem::path& path,
                            const bem::Discretisation& discretisation,
                            const bem::ProblemInputs& inputs, const Job& job);

}  // namespace palpa::app
