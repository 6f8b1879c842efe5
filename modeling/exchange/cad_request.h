#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "modeling/exchange/cad_import.h"
#include "modeling/exchange/file_bodies.h"

// What Palpa and the program palpa-read-cad tell each other, as one line of text. Internal to
// modeling/exchange/.
namespace palpa::modeling {

/// Work of the program palpa-read-cad.
struct CadRequest {
  bool lists = false;  ///< list the bodies; otherwise read one as importCad()
  /// Read all solids from this index on instead of one, and report each with beginText() and
  /// endText().
  std::optional<std::size_t> allFrom{};
  ListedSurface surface = ListedSurface::kNone;
  ImportOptions options{};
};

std::string toText(const CadRequest& request);
std::string toText(const FileBodies& found);

/// Throw ModelingError if the text is not one of toText().
CadRequest requestFrom(const std::string& text);
FileBodies fileBodiesFrom(const std::string& text);

// Lines that palpa-read-cad writes before and after each of several solids.
std::string beginText(std::size_t index);
/// `problem`: why the solid is refused; empty if it was read.
std::string endText(std::size_t index, const std::string& problem);

/// What the lines of beginText() and endText() at the beginning of a text say.
struct SolidsRead {
  std::vector<std::pair<std::size_t, std::string>> ended;  ///< index and problem
  std::optional<std::size_t> unfinished;                   ///< begun and not ended
};
SolidsRead solidsReadFrom(const std::string& text);

}  // namespace palpa::modeling
