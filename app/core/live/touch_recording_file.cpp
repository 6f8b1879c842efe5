#include "app/core/live/touch_recording_file.h"

#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "app/core/live/touch_snapshot.h"
#include "app/core/model/contact_kind.h"
#include "base/count_text.h"
#include "modeling/error.h"
#include "modeling/project/atomic_write.h"
#include "modeling/project/json_guard.h"
#include "modeling/project/json_values.h"
#include "modeling/project/migration.h"
#include "modeling/project/schema_check.h"
#include "modeling/project/text_file.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Json;
using modeling::ModelingError;
using nlohmann::json;
using Kind = TouchCommand::Kind;

/// Hash of numbers in units of a quantum, and of whole numbers.
class Fingerprint {
 public:
  Fingerprint() : state_(XXH64_createState()) { XXH64_reset(state_, 0); }
  ~Fingerprint() { XXH64_freeState(state_); }
  Fingerprint(const Fingerprint&) = delete;
  Fingerprint& operator=(const Fingerprint&) = delete;

  void add(std::int64_t number) { XXH64_update(state_, &number, sizeof number); }
  template <class List>
  void add(const List& numbers, double quantum) {
    for (const double number : numbers)
      add(static_cast<std::int64_t>(std::llround(number / quantum)));
  }
  std::string text() const {
    char digits[20];
    std::snprintf(digits, sizeof digits, "%016llx",
                  static_cast<unsigned long long>(XXH64_digest(state_)));
    return digits;
  }

 private:
  XXH64_state_t* state_;
};

Json jsonOf(const TouchRecording::Entry& entry) {
  const TouchCommand& command = entry.command;
  const bool isBegin = command.kind == Kind::kBegin;
  Json object{{"step", entry.step},
              {"do", isBegin                      ? "begin"
                     : command.kind == Kind::kSet ? "set"
                                                  : "end"},
              {"contact", command.id}};
  if (isBegin) {
    object["kind"] = infoOf(command.tool.kind).name;
    object["radius_mm"] = command.tool.radius;
    if (command.tool.friction != 0) object["friction"] = command.tool.friction;
    object["at_mm"] = modeling::jsonOf(command.at);
  }
  if (command.kind != Kind::kEnd) object["value"] = modeling::jsonOf(command.value);
  return object;
}

TouchRecording::Entry entryFrom(const json& value) {
  TouchRecording::Entry entry;
  entry.step = value["step"];
  TouchCommand& command = entry.command;
  command.id = value["contact"];
  const std::string& what = value["do"].get_ref<const std::string&>();
  command.kind = what == "begin" ? Kind::kBegin : what == "set" ? Kind::kSet : Kind::kEnd;
  if (command.kind != Kind::kEnd) command.value = modeling::vectorFrom(value["value"]);
  if (command.kind != Kind::kBegin) return entry;
  command.tool = {*contactKindNamed(value["kind"].get_ref<const std::string&>()),
                  value["radius_mm"], value.value("friction", 0.0)};
  command.at = modeling::vectorFrom(value["at_mm"]);
  return entry;
}

/// Keeps track of the contacts that exist.
class Contacts {
 public:
  /// Key and message of an error in a command; empty without an error.
  std::string faultOf(const TouchCommand& command) {
    const std::string name = std::to_string(command.id);
    if (command.kind == Kind::kBegin) return begin(command, name);
    if (!present_.contains(command.id))
      return ".contact: " + name +
             (used_.contains(command.id) ? " has ended before" : " was not begun");
    if (command.kind == Kind::kEnd) {
      present_.erase(command.id);
      balls_.erase(command.id);
    }
    return {};
  }

 private:
  std::string begin(const TouchCommand& command, const std::string& name) {
    if (!used_.insert(command.id).second) return ".contact: " + name + " was begun before";
    present_.insert(command.id);
    if (present_.size() > TouchSnapshot::kMaxContacts)
      return ": more than " + std::to_string(TouchSnapshot::kMaxContacts) + " contacts at once";
    if (command.tool.hasPatch()) balls_.insert(command.id);
    if (balls_.size() > TouchSnapshot::kMaxBalls)
      return ": more than " + std::to_string(TouchSnapshot::kMaxBalls) + " balls at once";
    return {};
  }

  std::set<TouchId> used_, present_, balls_;
};

void checkOrder(const TouchRecording& recording) {
  Contacts contacts;
  std::uint64_t last = 0;
  for (std::size_t k = 0; k < recording.entries.size(); ++k) {
    const TouchRecording::Entry& entry = recording.entries[k];
    const std::string path = "commands[" + std::to_string(k) + "]";
    if (entry.step < last)
      throw ModelingError(path + ".step: found " + std::to_string(entry.step) +
                          " after a command before step " + std::to_string(last));
    if (entry.step > recording.steps)
      throw ModelingError(path + ".step: found " + std::to_string(entry.step) +
                          ", but the recording has " + std::to_string(recording.steps) + " steps");
    last = entry.step;
    if (const std::string fault = contacts.faultOf(entry.command); !fault.empty())
      throw ModelingError(path + fault);
  }
}

/// Checks that it is a recording of a known version, before the check against the schema.
void checkFormat(const json& document, const std::string& source) {
  const auto is = [&](const char* key, const json& value) {
    return document.is_object() && document.contains(key) && document[key] == value;
  };
  if (!is("format", "palpa-recording"))
    throw ModelingError(source +
                        ": this is not a recording of Palpa (format is not "
                        "\"palpa-recording\")");
  if (document.contains("version") && document["version"].is_number_integer() &&
      document["version"] > kRecordingVersion)
    throw ModelingError(source + ": version: found " + document["version"].dump() +
                        "; this program reads up to version " + std::to_string(kRecordingVersion) +
                        "; a newer Palpa is needed");
}

}  // namespace

RecordedModel recordedModelOf(const TouchModel& model, const std::string& projectName) {
  constexpr double kRounding = 1e-7;
  const BoundarySetup& setup = model.setup();
  Fingerprint print;
  const double length = kRounding * std::max(setup.mesh().boundingSize(), 1e-300);
  for (const Vector3d& node : setup.mesh().nodes) print.add(node, length);
  for (const auto& triangle : setup.mesh().triangles)
    for (const int corner : triangle) print.add(corner);
  for (const auto condition : setup.conditions.ofSlot)
    print.add(static_cast<std::int64_t>(condition));
  const double modulus = setup.material.youngsModulus;
  print.add(std::array{std::log(modulus), setup.material.poissonRatio}, kRounding);
  print.add(setup.conditions.displacement, length);
  print.add(setup.conditions.traction, kRounding * modulus);
  // Without a body force the print is as before there were any.
  if (setup.bulk().hasBodyForce())
    print.add(setup.conditions.bodyForce, kRounding * modulus / setup.mesh().boundingSize());
  return {projectName, print.text(), setup.mesh().nodeCount()};
}

std::string differenceOf(const RecordedModel& recorded, const RecordedModel& present) {
  if (recorded.key == present.key) return {};
  std::string text = "the recording was made on another model";
  if (recorded.name != present.name) text += " (\"" + recorded.name + "\")";
  if (recorded.nodes != present.nodes)
    text += " with " + countText(recorded.nodes) + " nodes instead of " + countText(present.nodes);
  return text + "; its forces are others";
}

std::string toJson(const RecordingFile& file) {
  const TouchRecording& recording = file.recording;
  Json object{
      {"format", "palpa-recording"},
      {"version", kRecordingVersion},
      {"model", {{"name", file.model.name}, {"key", file.model.key}, {"nodes", file.model.nodes}}},
      {"steps", recording.steps}};
  if (recording.modelChanges > 0) object["model_changes"] = recording.modelChanges;
  if (recording.isFull) object["end_lost"] = true;
  Json commands = Json::array();
  for (const TouchRecording::Entry& entry : recording.entries) commands.push_back(jsonOf(entry));
  object["commands"] = std::move(commands);
  return modeling::jsonText(object, {"", "commands"}) + "\n";
}

RecordingFile parseRecording(std::string_view text, const std::string& sourceName) {
  json document =
      modeling::parseGuarded(text, sourceName, {kMaxRecordingFile, kMaxRecordingValues, 8});
  checkFormat(document, sourceName);
  if (document.contains("commands"))
    for (json& command : document["commands"]) modeling::upgradeKind(command);
  modeling::checkAgainstSchema(document, sourceName, modeling::SchemaName::kRecording);
  const json& model = document["model"];
  RecordingFile file{{model["name"], model["key"], model["nodes"]}, {}};
  file.recording.steps = document["steps"];
  file.recording.modelChanges = document.value("model_changes", 0);
  file.recording.isFull = document.value("end_lost", false);
  file.recording.entries.reserve(document["commands"].size());
  for (const json& one : document["commands"]) file.recording.entries.push_back(entryFrom(one));
  try {
    checkOrder(file.recording);
  } catch (const ModelingError& error) {
    throw ModelingError(sourceName + ": " + error.what(), error.kind());
  }
  return file;
}

RecordingFile readRecording(const std::filesystem::path& path) {
  return parseRecording(modeling::readTextFile(path, kMaxRecordingFile), path.string());
}

void writeRecording(const RecordingFile& file, const std::filesystem::path& path) {
  const std::string text = toJson(file);
  parseRecording(text, path.string() + " is not saved");
  modeling::writeAtomically(text, path);
}

}  // namespace palpa::app
