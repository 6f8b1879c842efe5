#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace palpa::verification {

/// The reference solutions: analytic.json and fem.json as resources/reference/README.md describes
/// them.
class ReferenceData {
 public:
  /// The files of resources/reference, which are built into the library.
  static const ReferenceData& builtIn();
  /// The same files in a folder. Throws ModelingError if a file is missing, is not JSON or has no
  /// list of cases with names.
  static ReferenceData read(const std::filesystem::path& folder);

  /// Cases with exact solutions (AnalyticCase) and with finite element solutions (FemErrors).
  const nlohmann::json& analytic() const { return analytic_; }
  const nlohmann::json& finiteElements() const { return finiteElements_; }
  /// Throws ModelingError (notFound).
  const nlohmann::json& finiteElementCase(const std::string& id) const;

 private:
  ReferenceData() = default;
  nlohmann::json analytic_, finiteElements_;  ///< lists of cases
};

}  // namespace palpa::verification
