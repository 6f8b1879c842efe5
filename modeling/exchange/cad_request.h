#pragma once

#include <string>

#include "modeling/exchange/cad_import.h"
#include "modeling/exchange/file_bodies.h"

// What Palpa and the program palpa-read-cad tell each other, as one line of text. Internal to
// modeling/exchange/.
namespace palpa::modeling {

/// Work of the program palpa-read-cad.
struct CadRequest {
  bool lists = false;  ///< list the bodies; otherwise read one as importCad()
  ListedSurface surface = ListedSurface::kNone;
  ImportOptions options;
};

std::string toText(const CadRequest& request);
std::string toText(const FileBodies& found);

/// Throw ModelingError if the text is not one of toText().
CadRequest requestFrom(const std::string& text);
FileBodies fileBodiesFrom(const std::string& text);

}  // namespace palpa::modeling
