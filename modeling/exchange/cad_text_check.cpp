#include "modeling/exchange/cad_text_check.h"

#include <stdexcept>

#include "modeling/error.h"

namespace palpa::modeling {

void checkCadText(const std::string& text, FileFormat format, const std::string& source) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw ModelingError(source + ": is empty");
  switch (format) {
    case FileFormat::kStep:
      return checkStepText(text, source);
    case FileFormat::kIges:
      return checkIgesText(text, source);
    case FileFormat::kBrep:
      return checkBrepText(text, source);
    case FileFormat::kProject:
    case FileFormat::kStl:
    case FileFormat::kObj:
    case FileFormat::kPly:
    case FileFormat::kVtp:
    case FileFormat::kPage:
      break;
  }
  throw std::invalid_argument("checkCadText: no CAD format");
}

}  // namespace palpa::modeling
