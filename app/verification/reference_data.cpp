#include "app/verification/reference_data.h"

#include <fstream>
#include <sstream>

#include "modeling/error.h"

namespace palpa::verification {

extern const char* const kAnalyticReference;  // resources/reference/analytic.json
extern const char* const kFemReference;       // resources/reference/fem.json

namespace {

using modeling::ModelingError;
using nlohmann::json;

json casesOf(const std::string& text, const std::string& source) {
  try {
    json cases = json::parse(text).at("cases");
    if (!cases.is_array()) throw ModelingError(source + ": cases is not a list");
    for (const json& entry : cases) (void)entry.at("id").get_ref<const std::string&>();
    return cases;
  } catch (const json::exception& error) {
    throw ModelingError(source + ": " + error.what());
  }
}

std::string textOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  // A folder opens, but cannot be read.
  if (!file || !(text << file.rdbuf()))
    throw ModelingError(path.string() + " cannot be read", ModelingError::Kind::kIo);
  return text.str();
}

}  // namespace

const ReferenceData& ReferenceData::builtIn() {
  static const ReferenceData data = [] {
    ReferenceData made;
    made.analytic_ = casesOf(kAnalyticReference, "analytic.json");
    made.finiteElements_ = casesOf(kFemReference, "fem.json");
    return made;
  }();
  return data;
}

ReferenceData ReferenceData::read(const std::filesystem::path& folder) {
  ReferenceData made;
  const auto analytic = folder / "analytic.json", fem = folder / "fem.json";
  made.analytic_ = casesOf(textOf(analytic), analytic.string());
  made.finiteElements_ = casesOf(textOf(fem), fem.string());
  return made;
}

const json& ReferenceData::finiteElementCase(const std::string& id) const {
  for (const json& entry : finiteElements_)
    if (entry.at("id") == id) return entry;
  throw ModelingError("fem.json has no case " + id, ModelingError::Kind::kNotFound);
}

}  // namespace palpa::verification
