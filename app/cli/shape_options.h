#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "modeling/shapes/make_primitive.h"

// The shapes of `palpa-cli new` and their options.
namespace palpa::cli {

/// "sphere, ellipsoid, …": all names, in the order of the help.
std::string shapeNames();

/// The options of all shapes and their values as text, empty where not given.
class ShapeOptions {
 public:
  void declare(CLI::App& options);

  struct Result {
    modeling::Primitive primitive;
    /// mm: largest distance of the profile from a drawing (SVG, DXF); none for other profiles.
    std::optional<double> drawingDeviation;
  };

  /// Throws UsageError for an unknown shape, an option without meaning for it, a missing or
  /// malformed value; ModelingError for a profile file that cannot be read.
  Result primitive(const std::string& shape) const;

 private:
  std::map<std::string, std::string> values_;
};

}  // namespace palpa::cli
