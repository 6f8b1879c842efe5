#include "modeling/exchange/cad_request.h"

#include <nlohmann/json.hpp>

#include "modeling/error.h"

namespace palpa::modeling {
namespace {

using Json = nlohmann::json;

/// Names in CAD files may be in any encoding; what is not UTF-8 is replaced.
std::string textOf(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json toJson(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

Eigen::Vector3d pointFrom(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Json toJson(const FileBody& body) {
  Json json{{"name", body.name},       {"named", body.isNamed},     {"faces", body.faces},
            {"low", toJson(body.low)}, {"high", toJson(body.high)}, {"volume", body.volume},
            {"surface", body.surface}};
  Json& positions = json["positions"] = Json::array();
  for (const Eigen::Vector3d& p : body.positions) positions.push_back(toJson(p));
  return json;
}

FileBody bodyFrom(const Json& json) {
  FileBody body;
  body.name = json.at("name");
  body.isNamed = json.at("named");
  body.faces = json.at("faces");
  body.low = pointFrom(json.at("low"));
  body.high = pointFrom(json.at("high"));
  body.volume = json.at("volume");
  body.surface = json.at("surface").get<std::vector<std::array<int, 3>>>();
  for (const Json& p : json.at("positions")) body.positions.push_back(pointFrom(p));
  const int count = static_cast<int>(body.positions.size());
  for (const auto& triangle : body.surface)
    for (const int corner : triangle)
      if (corner < 0 || corner >= count) throw ModelingError("a corner is not in the list");
  return body;
}

[[noreturn]] void failParsing(const std::exception& error) {
  throw ModelingError(std::string("the answer of palpa-read-cad is damaged: ") + error.what());
}

}  // namespace

std::string toText(const CadRequest& request) {
  const ImportOptions& options = request.options;
  return textOf({{"lists", request.lists},
                 {"all_from", request.allFrom ? Json(*request.allFrom) : Json()},
                 {"surface", request.surface == ListedSurface::kCoarse},
                 {"edge_length", options.edgeLength},
                 {"tolerance", options.tolerance},
                 {"solid", options.solid},
                 {"unit", options.placement.unit},
                 {"scale", options.placement.scale},
                 {"up", static_cast<int>(options.placement.up)}});
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
  failParsing(error);
}

std::string beginText(std::size_t index) {
  return textOf(Json::array({index})) + "\n";
}

std::string endText(std::size_t index, const std::string& problem) {
  return textOf(Json::array({index, problem})) + "\n";
}

SolidsRead solidsReadFrom(const std::string& text) try {
  SolidsRead read;
  for (std::size_t at = 0, end; at < text.size() && text[at] == '['; at = end + 1) {
    end = text.find('\n', at);
    if (end == std::string::npos) break;  // the program ended while it wrote this line
    const Json line = Json::parse(text.substr(at, end - at));
    read.unfinished.reset();
    if (line.size() == 1)
      read.unfinished = line.at(0).get<std::size_t>();
    else
      read.ended.emplace_back(line.at(0).get<std::size_t>(), line.at(1).get<std::string>());
  }
  return read;
} catch (const std::exception& error) {
  failParsing(error);
}

std::string toText(const FileBodies& found) {
  Json json{{"unit", found.unit}, {"states_unit", found.statesUnit}, {"bodies", Json::array()}};
  for (const FileBody& body : found.bodies) json["bodies"].push_back(toJson(body));
  return textOf(json);
}

FileBodies fileBodiesFrom(const std::string& text) try {
  const Json json = Json::parse(text);
  FileBodies found;
  found.unit = json.at("unit");
  found.statesUnit = json.at("states_unit");
  for (const Json& body : json.at("bodies")) found.bodies.push_back(bodyFrom(body));
  if (found.bodies.empty()) throw ModelingError("it lists no body");
  return found;
} catch (const std::exception& error) {
  failParsing(error);
}

}  // namespace palpa::modeling
