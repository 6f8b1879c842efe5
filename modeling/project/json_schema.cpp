#include "modeling/project/json_schema.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <vector>

#include "base/text.h"
#include "modeling/project/json_guard.h"

namespace palpa::modeling {
namespace {

using nlohmann::json;

struct Type {
  const char* name;
  const char* words;
  bool (json::*matches)() const noexcept;
};

constexpr Type kTypes[] = {{"array", "a list", &json::is_array},
                           {"object", "an object", &json::is_object},
                           {"integer", "a whole number", &json::is_number_integer},
                           {"number", "a number", &json::is_number},
                           {"string", "a text in quotes", &json::is_string},
                           {"boolean", "true or false", &json::is_boolean}};

const Type& typeNamed(const std::string& name) {
  for (const Type& type : kTypes)
    if (name == type.name) return type;
  throw std::invalid_argument("JsonSchema: unknown type " + name);
}

/// The location of a value in a document, as a chain of the values around it.
struct Location {
  const Location* outer = nullptr;
  const std::string* key = nullptr;  // null: an entry of a list
  std::size_t index = 0;

  std::string path() const {
    if (!outer) return {};
    return key ? joinPath(outer->path(), *key) : joinPath(outer->path(), index);
  }
  std::string words() const { return outer ? path() : "the file"; }
};

/// A value in a message: scalars as they are, long ones cut, lists and objects by their size.
std::string shown(const json& value) {
  if (value.is_array()) return "a list of " + std::to_string(value.size());
  if (value.is_object()) return "an object";
  const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return text.size() <= 60 ? text : text.substr(0, 57) + "…";
}

template <class List, class Text>
std::string joined(const List& list, const char* separator, Text text) {
  std::string result;
  for (const auto& one : list) result += (result.empty() ? "" : separator) + text(one);
  return result;
}

/// The keys of a map, quoted.
template <class Map>
std::string keysOf(const Map& map) {
  return joined(map, ", ", [](const auto& item) { return '"' + item.first + '"'; });
}

}  // namespace

struct JsonSchema::Rule {
  std::string description;
  std::vector<const Type*> types;  // empty: any
  std::vector<json> values;        // of const or enum; empty: any
  std::size_t minLength = 0;
  std::optional<double> minimum, exclusiveMinimum, maximum;
  std::size_t minItems = 0;
  std::size_t maxItems = SIZE_MAX;
  const Rule* items = nullptr;
  std::size_t minProperties = 0;
  std::size_t maxProperties = SIZE_MAX;
  std::map<std::string, const Rule*> properties;
  const Rule* otherProperties = nullptr;
  bool mayHaveOthers = true;
  std::vector<std::string> required;
  std::vector<const Rule*> allOf, oneOf;
  const Rule* condition = nullptr;
  const Rule* consequence = nullptr;
  const Rule* alternative = nullptr;

  class Check;
};

/// Checks values against rules until the first violation. Composes its message only on demand,
/// because the rules of `if` and `oneOf` are violated by valid documents, too.
class JsonSchema::Rule::Check {
 public:
  explicit Check(std::string* message) : message_(message) {}

  bool follows(const Rule& rule, const json& value, const Location& at) const {
    if (!followsTypeAndValues(rule, value, at)) return false;
    if (value.is_number() && !followsLimits(rule, value, at)) return false;
    if (value.is_array() && !followsAsArray(rule, value, at)) return false;
    if (value.is_object() && !followsAsObject(rule, value, at)) return false;
    for (const Rule* part : rule.allOf)
      if (!follows(*part, value, at)) return false;
    if (rule.condition) {
      const Rule* branch =
          Check(nullptr).follows(*rule.condition, value, at) ? rule.consequence : rule.alternative;
      if (branch && !follows(*branch, value, at)) return false;
    }
    return rule.oneOf.empty() || followsOne(rule, value, at);
  }

 private:
  template <class Text>
  bool fail(Text text) const {
    if (message_) *message_ = text();
    return false;
  }

  bool expected(const std::string& what, const json& value, const Location& at) const {
    return fail([&] { return at.words() + ": found " + shown(value) + ", expected " + what; });
  }

  bool followsTypeAndValues(const Rule& rule, const json& value, const Location& at) const {
    const auto matches = [&](const Type* type) { return (value.*type->matches)(); };
    if (!rule.types.empty() && std::none_of(rule.types.begin(), rule.types.end(), matches))
      return expected(
          joined(rule.types, " or ", [](const Type* type) { return std::string(type->words); }),
          value, at);
    if (!rule.values.empty() &&
        std::find(rule.values.begin(), rule.values.end(), value) == rule.values.end()) {
      if (!message_) return false;
      return expected((rule.values.size() > 1 ? "one of " : "") +
                          joined(rule.values, ", ", [](const json& one) { return one.dump(); }),
                      value, at);
    }
    if (value.is_string() && value.get_ref<const std::string&>().size() < rule.minLength)
      return expected("a text that is not empty", value, at);
    return true;
  }

  bool followsLimits(const Rule& rule, const json& value, const Location& at) const {
    const double number = value.get<double>();
    if (rule.minimum && number < *rule.minimum)
      return expected("at least " + numberText(*rule.minimum), value, at);
    if (rule.exclusiveMinimum && number <= *rule.exclusiveMinimum)
      return expected("more than " + numberText(*rule.exclusiveMinimum), value, at);
    if (rule.maximum && number > *rule.maximum)
      return expected("at most " + numberText(*rule.maximum), value, at);
    return true;
  }

  bool followsAsArray(const Rule& rule, const json& value, const Location& at) const {
    const std::size_t low = rule.minItems;
    const std::size_t high = rule.maxItems;
    if (value.size() < low || value.size() > high)
      return expected((low == high          ? std::to_string(low)
                       : value.size() < low ? "at least " + std::to_string(low)
                                            : "at most " + std::to_string(high)) +
                          " entries",
                      value, at);
    if (rule.items)
      for (std::size_t i = 0; i < value.size(); ++i)
        if (!follows(*rule.items, value[i], {&at, nullptr, i})) return false;
    return true;
  }

  bool followsAsObject(const Rule& rule, const json& value, const Location& at) const {
    const auto& members = value.get_ref<const json::object_t&>();
    for (const auto& [key, member] : members) {
      if (rule.properties.contains(key)) continue;
      const Location place{&at, &key};
      if (!rule.mayHaveOthers)
        return fail([&] {
          return place.path() + ": unknown key, expected one of " + keysOf(rule.properties);
        });
      if (rule.otherProperties && !follows(*rule.otherProperties, member, place)) return false;
    }
    for (const std::string& key : rule.required)
      if (!members.contains(key))
        return fail([&] { return Location{&at, &key}.path() + ": is missing"; });
    if (members.size() < rule.minProperties || members.size() > rule.maxProperties)
      return fail([&] {
        return at.words() + ": found " + (members.empty() ? "no key" : keysOf(members)) +
               ", expected exactly one of " + keysOf(rule.properties);
      });
    for (const auto& [key, member] : members)
      if (const auto property = rule.properties.find(key); property != rule.properties.end())
        if (!follows(*property->second, member, {&at, &key})) return false;
    return true;
  }

  bool followsOne(const Rule& rule, const json& value, const Location& at) const {
    const auto count = std::count_if(
        rule.oneOf.begin(), rule.oneOf.end(),
        [&](const Rule* variant) { return Check(nullptr).follows(*variant, value, at); });
    return count == 1 || fail([&] {
             return at.words() + ": expected " + rule.oneOf.front()->description +
                    (count == 0 ? ", found neither" : ", found both");
           });
  }

  std::string* message_;
};

JsonSchema::JsonSchema(const json& document, const json& project)
    : root_(compile(document, document, project)) {}
JsonSchema::~JsonSchema() = default;

const JsonSchema::Rule* JsonSchema::compile(const json& node, const json& document,
                                            const json& project) {
  if (const auto reference = node.find("$ref"); reference != node.end()) {
    const std::string& target = reference->get_ref<const std::string&>();
    const std::size_t hash = target.find('#');
    const json& home = hash == 0 ? document : project;
    return compile(home.at(json::json_pointer(target.substr(hash + 1))), home, project);
  }
  std::unique_ptr<Rule>& place = rules_[&node];
  if (place) return place.get();  // also while it is being compiled: schemas may be recursive
  place = std::make_unique<Rule>();
  Rule& rule = *place;
  const auto compiled = [&](const json& part) { return compile(part, document, project); };
  const auto listOf = [&](const json& parts) {
    std::vector<const Rule*> list;
    for (const json& part : parts) list.push_back(compiled(part));
    return list;
  };
  using Reader = std::function<void(const json&)>;
  const Reader ignore = [](const json&) {};
  const std::map<std::string, Reader> readers{
      {"$schema", ignore},
      {"title", ignore},
      {"definitions", ignore},
      {"description", [&](const json& v) { rule.description = v; }},
      {"type",
       [&](const json& v) {
         for (const json& name : v.is_array() ? v : json::array({v}))
           rule.types.push_back(&typeNamed(name));
       }},
      {"const", [&](const json& v) { rule.values = {v}; }},
      {"enum", [&](const json& v) { rule.values = v.get<std::vector<json>>(); }},
      {"minLength", [&](const json& v) { rule.minLength = v; }},
      {"minimum", [&](const json& v) { rule.minimum = v.get<double>(); }},
      {"exclusiveMinimum", [&](const json& v) { rule.exclusiveMinimum = v.get<double>(); }},
      {"maximum", [&](const json& v) { rule.maximum = v.get<double>(); }},
      {"minItems", [&](const json& v) { rule.minItems = v; }},
      {"maxItems", [&](const json& v) { rule.maxItems = v; }},
      {"items", [&](const json& v) { rule.items = compiled(v); }},
      {"minProperties", [&](const json& v) { rule.minProperties = v; }},
      {"maxProperties", [&](const json& v) { rule.maxProperties = v; }},
      {"properties",
       [&](const json& v) {
         for (const auto& [key, part] : v.items()) rule.properties[key] = compiled(part);
       }},
      {"additionalProperties",
       [&](const json& v) {
         rule.mayHaveOthers = v != false;
         if (v.is_object()) rule.otherProperties = compiled(v);
       }},
      {"required", [&](const json& v) { rule.required = v.get<std::vector<std::string>>(); }},
      {"allOf", [&](const json& v) { rule.allOf = listOf(v); }},
      {"oneOf", [&](const json& v) { rule.oneOf = listOf(v); }},
      {"if", [&](const json& v) { rule.condition = compiled(v); }},
      {"then", [&](const json& v) { rule.consequence = compiled(v); }},
      {"else", [&](const json& v) { rule.alternative = compiled(v); }}};
  for (const auto& [keyword, value] : node.items()) {
    const auto reader = readers.find(keyword);
    if (reader == readers.end())
      throw std::invalid_argument("JsonSchema: unknown keyword " + keyword);
    reader->second(value);
  }
  return &rule;
}

std::optional<std::string> JsonSchema::violation(const json& value) const {
  std::string message;
  if (Rule::Check(&message).follows(*root_, value, {})) return std::nullopt;
  return message;
}

}  // namespace palpa::modeling
