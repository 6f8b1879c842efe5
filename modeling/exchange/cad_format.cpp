#include "modeling/exchange/cad_format.h"

#include <algorithm>
#include <cctype>

namespace palpa::modeling {

std::optional<CadFormat> cadFormatOf(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".step" || ending == ".stp") return CadFormat::kStep;
  if (ending == ".iges" || ending == ".igs") return CadFormat::kIges;
  if (ending == ".brep") return CadFormat::kBrep;
  return std::nullopt;
}

}  // namespace palpa::modeling
