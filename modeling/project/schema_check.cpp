#include "modeling/project/schema_check.h"

#include <optional>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/project/json_guard.h"

namespace palpa::modeling {
namespace {

using nlohmann::json;

/// Lets a schema that refers to `project.schema.json#/…` stand alone: the project schema becomes a
/// part of it, and all references become local.
void redirectReferences(json& part, const std::string& from, const std::string& to) {
  if (part.is_object())
    if (const auto reference = part.find("$ref"); reference != part.end()) {
      const std::string target = *reference;
      if (target.rfind(from, 0) == 0) *reference = to + target.substr(from.size());
    }
  if (part.is_structured())
    for (json& inner : part) redirectReferences(inner, from, to);
}

json standaloneCommandsSchema() {
  json project = json::parse(kProjectSchema);
  redirectReferences(project, "#/", "#/definitions/project/");
  json commands = json::parse(kCommandsSchema);
  redirectReferences(commands, "project.schema.json#/", "#/definitions/project/");
  commands["definitions"]["project"] = std::move(project);
  return commands;
}

struct CompiledSchema {
  explicit CompiledSchema(json schemaDocument) : document(std::move(schemaDocument)) {
    const valijson::adapters::NlohmannJsonAdapter adapter(document);
    valijson::SchemaParser().populateSchema(adapter, schema);
  }

  json document;
  valijson::Schema schema;
};

const CompiledSchema& compiledSchema(SchemaName name) {
  if (name == SchemaName::kCommands) {
    static const CompiledSchema commands(standaloneCommandsSchema());
    return commands;
  }
  if (name == SchemaName::kRecording) {
    static const CompiledSchema recording(json::parse(kRecordingSchema));
    return recording;
  }
  static const CompiledSchema project(json::parse(kProjectSchema));
  return project;
}

/// A value in a message: scalars as they are, long ones cut, lists and objects by their size.
std::string shown(const json& value) {
  if (value.is_array()) return "a list of " + std::to_string(value.size());
  if (value.is_object()) return "an object";
  const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return text.size() <= 60 ? text : text.substr(0, 57) + "…";
}

std::string typeName(const std::string& type) {
  if (type == "array") return "a list";
  if (type == "object") return "an object";
  if (type == "integer") return "a whole number";
  if (type == "number") return "a number";
  if (type == "string") return "a text in quotes";
  if (type == "boolean") return "true or false";
  return type;
}

bool hasType(const json& value, const std::string& type) {
  if (type == "array") return value.is_array();
  if (type == "object") return value.is_object();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  return false;
}

std::string quotedList(const json& values) {
  std::string text;
  for (const json& value : values) text += (text.empty() ? "" : ", ") + value.dump();
  return text;
}

std::string keysOf(const json& object) {
  std::string text;
  for (const auto& item : object.items())
    text += (text.empty() ? "\"" : ", \"") + item.key() + "\"";
  return text;
}

std::optional<std::string> violation(const json& root, const json& schema, const json& value,
                                     const std::string& path);

std::string at(const std::string& path) {
  return path.empty() ? "the file" : path;
}

std::optional<std::string> typeViolation(const json& schema, const json& value,
                                         const std::string& path) {
  const auto found = [&](const std::string& expected) {
    return at(path) + ": found " + shown(value) + ", expected " + expected;
  };
  if (const auto type = schema.find("type"); type != schema.end()) {
    std::string expected;
    bool matches = false;
    for (const json& one : type->is_array() ? *type : json::array({*type})) {
      matches = matches || hasType(value, one);
      expected += (expected.empty() ? "" : " or ") + typeName(one);
    }
    if (!matches) return found(expected);
  }
  if (const auto one = schema.find("const"); one != schema.end() && value != *one)
    return found(one->dump());
  if (const auto list = schema.find("enum"); list != schema.end())
    if (std::find(list->begin(), list->end(), value) == list->end())
      return found((list->size() > 1 ? "one of " : "") + quotedList(*list));
  if (!value.is_number()) {
    if (value.is_string() &&
        value.get_ref<const std::string&>().size() < schema.value("minLength", 0U))
      return found("a text that is not empty");
    return std::nullopt;
  }
  const double number = value.get<double>();
  const auto limit = [&](const char* key) {
    const auto it = schema.find(key);
    return it == schema.end() ? std::optional<double>() : std::optional(it->get<double>());
  };
  if (const auto low = limit("minimum"); low && number < *low)
    return found("at least " + numberText(*low));
  if (const auto low = limit("exclusiveMinimum"); low && number <= *low)
    return found("more than " + numberText(*low));
  if (const auto high = limit("maximum"); high && number > *high)
    return found("at most " + numberText(*high));
  return std::nullopt;
}

std::optional<std::string> arrayViolation(const json& root, const json& schema, const json& value,
                                          const std::string& path) {
  const std::size_t low = schema.value("minItems", std::size_t{0});
  const std::size_t high = schema.value("maxItems", SIZE_MAX);
  if (value.size() < low || value.size() > high) {
    const std::string expected = low == high          ? std::to_string(low)
                                 : value.size() < low ? "at least " + std::to_string(low)
                                                      : "at most " + std::to_string(high);
    return at(path) + ": found a list of " + std::to_string(value.size()) + ", expected " +
           expected + " entries";
  }
  if (const auto items = schema.find("items"); items != schema.end())
    for (std::size_t i = 0; i < value.size(); ++i)
      if (auto inner = violation(root, *items, value[i], joinPath(path, i))) return inner;
  return std::nullopt;
}

std::optional<std::string> objectViolation(const json& root, const json& schema, const json& value,
                                           const std::string& path) {
  const json properties = schema.value("properties", json::object());
  // Unknown keys first: a misspelt key also leaves a required one missing, and names the cause.
  const json others = schema.value("additionalProperties", json(true));
  for (const auto& item : value.items()) {
    if (properties.contains(item.key())) continue;
    const std::string itemPath = joinPath(path, item.key());
    if (others == false) return itemPath + ": unknown key, expected one of " + keysOf(properties);
    if (others.is_object())
      if (auto inner = violation(root, others, item.value(), itemPath)) return inner;
  }
  for (const json& key : schema.value("required", json::array()))
    if (!value.contains(key)) return joinPath(path, key.get<std::string>()) + ": is missing";
  if (value.size() < schema.value("minProperties", std::size_t{0}) ||
      value.size() > schema.value("maxProperties", SIZE_MAX))
    return at(path) + ": found " + (value.empty() ? "no key" : keysOf(value)) +
           ", expected exactly one of " + keysOf(properties);
  for (const auto& item : properties.items())
    if (const auto found = value.find(item.key()); found != value.end())
      if (auto inner = violation(root, item.value(), *found, joinPath(path, item.key())))
        return inner;
  return std::nullopt;
}

/// The first violation of the schema (with the keywords that our schemas use), in words.
std::optional<std::string> violation(const json& root, const json& schema, const json& value,
                                     const std::string& path) {
  if (const auto reference = schema.find("$ref"); reference != schema.end())
    return violation(root, root.at(json::json_pointer(reference->get<std::string>().substr(1))),
                     value, path);
  if (auto found = typeViolation(schema, value, path)) return found;
  if (value.is_array())
    if (auto found = arrayViolation(root, schema, value, path)) return found;
  if (value.is_object())
    if (auto found = objectViolation(root, schema, value, path)) return found;
  for (const json& part : schema.value("allOf", json::array()))
    if (auto found = violation(root, part, value, path)) return found;
  if (schema.contains("if")) {
    const char* branch = violation(root, schema["if"], value, path) ? "else" : "then";
    if (schema.contains(branch))
      if (auto found = violation(root, schema[branch], value, path)) return found;
  }
  if (schema.contains("oneOf")) {
    int matches = 0;
    for (const json& part : schema["oneOf"]) matches += !violation(root, part, value, path);
    if (matches != 1)
      return at(path) + ": expected " + schema["oneOf"][0].value("description", "one variant") +
             (matches == 0 ? ", found neither" : ", found both");
  }
  return std::nullopt;
}

}  // namespace

void checkAgainstSchema(const json& document, const std::string& source, SchemaName schema) {
  const CompiledSchema& compiled = compiledSchema(schema);
  valijson::Validator validator(valijson::Validator::kStrongTypes);
  const valijson::adapters::NlohmannJsonAdapter adapter(document);
  if (validator.validate(compiled.schema, adapter, nullptr)) return;
  const auto found = violation(compiled.document, compiled.document, document, "");
  const std::string name = schema == SchemaName::kProject    ? "project"
                           : schema == SchemaName::kCommands ? "commands"
                                                             : "recording";
  throw ModelingError(
      source + ": " +
      found.value_or("does not follow the schema (resources/" + name + ".schema.json)"));
}

}  // namespace palpa::modeling
