#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

// Writes the reference page of the project file from its JSON schema, so that both always agree,
// and the dictionary of the fuzz target.
namespace {

using nlohmann::ordered_json;

std::string anchor(const std::string& definition) {
  return "#" + definition;
}

/// The member of that name; an empty list when there is none.
const ordered_json& member(const ordered_json& object, const std::string& key) {
  static const ordered_json none = ordered_json::array();
  const auto found = object.find(key);
  return found == object.end() ? none : *found;
}

/// The name behind "#/definitions/name".
std::string definitionOf(const ordered_json& schema) {
  const std::string reference = schema.at("$ref");
  return reference.substr(reference.rfind('/') + 1);
}

std::string linkTo(const std::string& definition) {
  return "[" + definition + "](" + anchor(definition) + ")";
}

std::string number(const ordered_json& value) {
  return value.dump();
}

std::string rangeText(const ordered_json& schema) {
  std::vector<std::string> parts;
  if (schema.contains("exclusiveMinimum"))
    parts.push_back("> " + number(schema["exclusiveMinimum"]));
  if (schema.contains("minimum")) parts.push_back("≥ " + number(schema["minimum"]));
  if (schema.contains("maximum")) parts.push_back("≤ " + number(schema["maximum"]));
  if (schema.contains("minItems") && schema.contains("maxItems") &&
      schema["minItems"] == schema["maxItems"])
    parts.push_back(number(schema["minItems"]) + " entries");
  else if (schema.contains("minItems"))
    parts.push_back("at least " + number(schema["minItems"]) + " entries");
  if (schema.value("minLength", 0) > 0) parts.push_back("not empty");
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

/// What a value is, in words: "list of [vector](#vector)", "`fixed` or `roller`".
std::string typeText(const ordered_json& schema) {
  if (schema.contains("$ref")) return linkTo(definitionOf(schema));
  if (schema.contains("const")) return "`" + schema["const"].get<std::string>() + "`";
  if (schema.contains("enum")) {
    std::string text;
    for (std::size_t i = 0; i < schema["enum"].size(); ++i)
      text += (i == 0                          ? ""
               : i + 1 < schema["enum"].size() ? ", "
                                               : " or ") +
              ("`" + schema["enum"][i].get<std::string>() + "`");
    return text;
  }
  if (!schema.at("type").is_string()) {
    std::string text;
    for (const std::string type : schema["type"])
      text += (text.empty() ? "" : " or ") + std::string(type == "array"     ? "list"
                                                         : type == "integer" ? "whole number"
                                                         : type == "string"  ? "text"
                                                                             : type);
    return text;
  }
  const std::string type = schema["type"];
  if (type == "array") {
    const ordered_json& items = schema.at("items");
    const std::string range = rangeText(items);
    const bool plain = !items.contains("$ref") && !items.contains("items");
    return "list of " + typeText(items) + (plain && !range.empty() ? " " + range : "");
  }
  if (type == "integer") return "whole number";
  if (type == "string") return "text";
  if (type == "object" && schema.contains("additionalProperties") &&
      schema["additionalProperties"].is_object())
    return "object of " + typeText(schema["additionalProperties"]) + " " +
           rangeText(schema["additionalProperties"]);
  return type;
}

/// The unit at the end of a key, as in edge_length_mm.
std::string unitOf(const std::string& key) {
  if (key.ends_with("_N_per_mm")) return "N/mm";
  for (const char* unit : {"mm", "MPa", "N"})
    if (key == unit || key.ends_with("_" + std::string(unit))) return unit;
  return "";
}

class Page {
 public:
  explicit Page(const ordered_json& schema) : schema_(schema) {
    text_ =
        "# Project file reference\n\nMade from `resources/project.schema.json` by `ninja -C "
        "build/release reference`; do not edit. What the parts are for is explained in [the "
        "project "
        "file](project-file.md).\n\n" +
        schema.at("description").get<std::string>() + "\n\n## project\n\n" + bodyOf(schema);
    for (const auto& [key, part] : schema.at("properties").items())
      if (member(part, "type") == "object") section(key, part);
    for (const auto& [key, part] : schema.at("definitions").items()) section(key, part);
  }

  const std::string& text() const { return text_; }

 private:
  void section(const std::string& key, const ordered_json& part) {
    if (!part.contains("properties") && key == "view") return;
    text_ += "## " + key + "\n\n" + bodyOf(part);
    for (const auto& [name, inner] : member(part, "properties").items())
      if (inner.contains("properties")) section(name, inner);
  }

  std::string descriptionOf(const ordered_json& part) const {
    const std::string title = part.value("title", "");
    const std::string description = part.value("description", "");
    return title + (title.empty() || description.empty() ? "" : ". ") + description;
  }

  std::string meaningOf(const ordered_json& part) const {
    if (!part.contains("$ref")) return descriptionOf(part);
    const std::string own = descriptionOf(part);
    return own.empty() ? descriptionOf(schema_.at("definitions").at(definitionOf(part))) : own;
  }

  std::string bodyOf(const ordered_json& part) const {
    std::string text;
    if (&part != &schema_) {
      text = descriptionOf(part);
      if (!text.ends_with(".")) text += ".";
      text += "\n\n";
    }
    if (part.contains("properties"))
      text += table(part);
    else if (part.contains("then"))
      text += "Either " + linkTo(definitionOf(part["else"])) + " or " +
              (part["then"].contains("items")
                   ? "a list of " + linkTo(definitionOf(part["then"]["items"]))
                   : linkTo(definitionOf(part["then"]))) +
              ".\n\n";
    else
      text += "A value of this kind: " + typeText(part) +
              (rangeText(part).empty() ? "" : ", " + rangeText(part)) + ".\n\n";
    return text + variants(part);
  }

  std::string table(const ordered_json& part) const {
    std::set<std::string> required;
    for (const ordered_json& key : member(part, "required")) required.insert(key);
    std::string text =
        "| key | type | unit, range | required | meaning |\n| --- | --- | --- | --- | --- |\n";
    for (const auto& [key, value] : part.at("properties").items()) {
      const bool isSection = value.contains("properties");
      const ordered_json& shown =
          value.contains("$ref") ? schema_.at("definitions").at(definitionOf(value)) : value;
      std::string range = unitOf(key);
      const std::string limits = rangeText(shown);
      range += (range.empty() || limits.empty() ? "" : ", ") + limits;
      text += "| `" + key + "` | " + (isSection ? linkTo(key) : typeText(value)) + " | " + range +
              " | " + (required.contains(key) ? "yes" : oneOfWhich(part, key)) + " | " +
              meaningOf(value) + " |\n";
    }
    return text + "\n";
  }

  /// "one of the two" for keys of which the file has exactly one.
  static std::string oneOfWhich(const ordered_json& part, const std::string& key) {
    for (const ordered_json& variant : member(part, "oneOf"))
      if (variant.at("required").front() == key) return variant.at("description");
    return part.contains("maxProperties") ? "exactly one of these" : "";
  }

  /// Which definition applies for which kind.
  static std::string variants(const ordered_json& part) {
    std::string text;
    for (const ordered_json& one : member(part, "allOf"))
      text +=
          (text.empty() ? "Further keys by kind: " : ", ") + linkTo(definitionOf(one.at("then")));
    return text.empty() ? text : text + ".\n\n";
  }

  const ordered_json& schema_;
  std::string text_;
};

void collectWords(const ordered_json& part, std::set<std::string>& words) {
  if (part.is_object()) {
    for (const auto& [key, value] : member(part, "properties").items()) words.insert(key);
    for (const ordered_json& value : member(part, "enum")) words.insert(value);
    if (part.contains("const")) words.insert(part["const"]);
  }
  if (part.is_structured())
    for (const ordered_json& inner : part) collectWords(inner, words);
}

/// One libFuzzer dictionary entry per key and word of the schema, quotes included.
std::string dictionaryOf(const ordered_json& schema) {
  std::set<std::string> words;
  collectWords(schema, words);
  std::string text;
  for (const std::string& word : words) text += "\"\\\"" + word + "\\\"\"\n";
  return text;
}

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  if (!(file << text).flush()) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  const std::string task = argc == 4 ? argv[1] : "";
  try {
    if (task != "page" && task != "check" && task != "dictionary")
      throw std::runtime_error("usage: schema_reference page|check|dictionary schema.json file");
    const ordered_json schema = ordered_json::parse(contentOf(argv[2]));
    const std::string text = task == "dictionary" ? dictionaryOf(schema) : Page(schema).text();
    if (task != "check")
      write(argv[3], text);
    else if (contentOf(argv[3]) != text)
      throw std::runtime_error(
          std::string(argv[3]) +
          ": is not what the schema says; run ninja -C build/release reference");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
