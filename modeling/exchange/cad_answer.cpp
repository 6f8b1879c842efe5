#include "modeling/exchange/cad_answer.h"

#include <stdexcept>
#include <utility>

#include "modeling/project/json_values.h"

namespace palpa::modeling {
namespace {

using nlohmann::json;

Json toJson(const FileBody& body) {
  return {{"name", body.name},         {"named", body.isNamed},
          {"faces", body.faces},       {"low", jsonOf(body.low)},
          {"high", jsonOf(body.high)}, {"volume", body.volume},
          {"surface", body.surface},   {"positions", jsonOfEach(body.positions)}};
}

FileBody fileBodyFrom(const json& value) {
  FileBody body;
  body.name = value.at("name");
  body.isNamed = value.at("named");
  body.faces = value.at("faces");
  body.low = vectorFrom(value.at("low"));
  body.high = vectorFrom(value.at("high"));
  body.volume = value.at("volume");
  body.surface = value.at("surface").get<std::vector<std::array<int, 3>>>();
  for (const json& p : value.at("positions")) body.positions.push_back(vectorFrom(p));
  const int count = static_cast<int>(body.positions.size());
  for (const auto& triangle : body.surface)
    for (const int corner : triangle)
      if (corner < 0 || corner >= count) throw ModelingError("a corner is not in the list");
  return body;
}

Json toJson(const FileBodies& found) {
  Json bodies = Json::array();
  for (const FileBody& body : found.bodies) bodies.push_back(toJson(body));
  return {{"unit", found.unit}, {"states_unit", found.statesUnit}, {"bodies", std::move(bodies)}};
}

FileBodies fileBodiesFrom(const json& value) {
  FileBodies found;
  found.unit = value.at("unit");
  found.statesUnit = value.at("states_unit");
  for (const json& body : value.at("bodies")) found.bodies.push_back(fileBodyFrom(body));
  if (found.bodies.empty()) throw ModelingError("it lists no body");
  return found;
}

Json toJson(const ImportedBody& imported) {
  Json object{
      {"notes", imported.notes}, {"deviation", imported.deviation}, {"name", imported.name}};
  if (const auto* solid = std::get_if<Solid>(&imported.body))
    object["solid"] = jsonOf(*solid);
  else
    object["mesh_body"] = jsonOf(std::get<MeshBody>(imported.body));
  return object;
}

ImportedBody importedBodyFrom(const json& value) {
  ImportedBody imported;
  imported.notes = value.at("notes").get<std::vector<std::string>>();
  imported.deviation = value.at("deviation");
  imported.name = value.at("name");
  if (value.contains("solid"))
    imported.body = solidFrom(value.at("solid"));
  else
    imported.body = meshBodyFrom(value.at("mesh_body"));
  return imported;
}

constexpr const char* kProgress = "progress";
constexpr const char* kBegun = "begun";
constexpr const char* kEnded = "ended";
constexpr const char* kBody = "body";
constexpr const char* kList = "list";
constexpr const char* kChoose = "choose";
constexpr const char* kFailed = "failed";

struct ToJson {
  Json operator()(const ReadProgress& progress) const {
    return Json::array({kProgress, static_cast<int>(progress.phase), progress.fraction});
  }
  Json operator()(const SolidBegun& begun) const { return Json::array({kBegun, begun.index}); }
  Json operator()(const SolidEnded& ended) const {
    const auto& [imported, problem] = ended.outcome;
    return Json::array({kEnded, ended.index, problem, imported ? toJson(*imported) : Json()});
  }
  Json operator()(const ImportedBody& imported) const {
    return Json::array({kBody, toJson(imported)});
  }
  Json operator()(const FileBodies& found) const { return Json::array({kList, toJson(found)}); }
  Json operator()(const SolidsToChooseFrom& several) const {
    return Json::array({kChoose, toJson(several.found)});
  }
  Json operator()(const ReadFailed& failed) const {
    return Json::array({kFailed, failed.message, static_cast<int>(failed.kind)});
  }
};

}  // namespace

std::string toLine(const CadAnswer& answer) {
  return std::visit(ToJson{}, answer).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

CadAnswer answerFrom(const std::string& line) try {
  const json message = json::parse(line);
  const std::string what = message.at(0);
  if (what == kProgress)
    return ReadProgress{static_cast<Phase>(message.at(1).get<int>()), message.at(2)};
  if (what == kBegun) return SolidBegun{message.at(1)};
  if (what == kEnded) {
    BodyOutcome outcome{std::nullopt, message.at(2)};
    if (!message.at(3).is_null()) outcome.imported = importedBodyFrom(message.at(3));
    return SolidEnded{message.at(1), std::move(outcome)};
  }
  if (what == kBody) return importedBodyFrom(message.at(1));
  if (what == kList) return fileBodiesFrom(message.at(1));
  if (what == kChoose) return SolidsToChooseFrom{fileBodiesFrom(message.at(1))};
  if (what == kFailed)
    return ReadFailed{message.at(1), static_cast<ModelingError::Kind>(message.at(2).get<int>())};
  throw std::invalid_argument(what);
} catch (const std::exception& error) {
  throw ModelingError(std::string("the answer of palpa-read-cad is damaged: ") + error.what());
}

}  // namespace palpa::modeling
