#include "modeling/exchange/cad_request.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace palpa::modeling {
using Json = nlohmann::json;

std::string toText(const CadRequest& request) {
  const ImportOptions& options = request.options;
  const Json json{{"lists", request.lists},
                  {"all_from", request.allFrom ? Json(*request.allFrom) : Json()},
                  {"surface", request.surface == ListedSurface::kCoarse},
                  {"edge_length", options.edgeLength},
                  {"tolerance", options.tolerance},
                  {"solid", options.solid},
                  {"unit", options.placement.unit},
                  {"scale", options.placement.scale},
                  {"up", static_cast<int>(options.placement.up)}};
  // Names in CAD files may be in any encoding; what is not UTF-8 is replaced.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

CadRequest requestFrom(const std::string& text) try {
  const Json json = Json::parse(text);
  CadRequest request;
  request.lists = json.at("lists");
  if (!json.at("all_from").is_null()) request.allFrom = json.at("all_from").get<std::size_t>();
  if (json.at("surface").get<bool>()) request.surface = ListedSurface::kCoarse;
  request.options.edgeLength = json.at("edge_length");
  request.options.tolerance = json.at("tolerance");
  request.options.solid = json.at("solid");
  request.options.placement.unit = json.at("unit");
  request.options.placement.scale = json.at("scale");
  request.options.placement.up = static_cast<UpAxis>(json.at("up").get<int>());
  return request;
} catch (const std::exception& error) {
  throw std::invalid_argument(std::string("requestFrom: ") + error.what());
}

}  // namespace palpa::modeling
