#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "modeling/exchange/cad_import.h"
#include "modeling/exchange/file_bodies.h"

// What Palpa asks of the program palpa-read-cad, as one line of JSON. Internal to
// modeling/exchange/.
namespace palpa::modeling {

/// Work of the program palpa-read-cad.
struct CadRequest {
  bool lists = false;  ///< list the bodies; otherwise read one as importCad()
  /// Read all solids from this index on instead of one.
  std::optional<std::size_t> allFrom{};
  ListedSurface surface = ListedSurface::kNone;
  ImportOptions options{};
};

std::string toText(const CadRequest& request);

/// Throws std::invalid_argument if the text is not one of toText().
CadRequest requestFrom(const std::string& text);

}  // namespace palpa::modeling
