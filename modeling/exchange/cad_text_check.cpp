#include "modeling/exchange/cad_text_check.h"

#include "modeling/error.h"

namespace palpa::modeling {

void checkCadText(const std::string& text, CadFormat format, const std::string& source) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw ModelingError(source + ": is empty");
  switch (format) {
    case CadFormat::kStep:
      checkStepText(text, source);
      break;
    case CadFormat::kIges:
      checkIgesText(text, source);
      break;
    case CadFormat::kBrep:
      checkBrepText(text, source);
      break;
  }
}

}  // namespace palpa::modeling
