#include "modeling/error.h"
#include "modeling/exchange/cad_text_check.h"

namespace palpa::modeling {

void checkBrepText(const std::string& text, const std::string& source) {
  if (text.substr(0, 4096).find("CASCADE Topology V") == std::string::npos)
    throw ModelingError(source + ": is no BREP file; CASCADE Topology is missing at its beginning");
}

}  // namespace palpa::modeling
