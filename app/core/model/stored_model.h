#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "app/core/model/model_cache.h"

// Files of solved models: a header, then the operators and factors of one ReferenceProblem bit by
// bit, in the byte order of the machine.
namespace palpa::app {

/// Part of ModelCache::keyOf(): changes with the form of the files.
inline constexpr std::uint32_t kStoredModelFormat = 1;

/// Thrown if a file is not as it was written.
struct DamagedModel {};

/// The problem in a file, which counts as used now; null if the file cannot be opened. Throws
/// DamagedModel, also if the file has another key, Cancelled, std::bad_alloc.
std::unique_ptr<bem::ReferenceProblem> readStoredModel(const std::filesystem::path& file,
                                                       const ModelCache::Key& key,
                                                       const bem::Discretisation& discretisation,
                                                       const bem::ProblemInputs& inputs,
                                                       const Job& job);

/// Writes a new file, readable by its owner only. Throws std::system_error and Cancelled; then no
/// part of it remains.
void writeStoredModel(const std::filesystem::path& file, const ModelCache::Key& key,
                      const bem::ReferenceProblem& problem, const Job& job);

}  // namespace palpa::app
