#include "modeling/project/json_schema.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace palpa::modeling {
namespace {

using nlohmann::json;

std::string violation(const char* schema, const char* value) {
  return JsonSchema(json::parse(schema)).violation(json::parse(value)).value_or("valid");
}

TEST(JsonSchema, RefusesUnknownKeywordsAndTypes) {
  for (const char* schema :
       {R"({"pattern": "a"})", R"({"items": {"uniqueItems": true}})",
        R"({"properties": {"a": {"multipleOf": 2}}})", R"({"if": {"not": {}}})",
        R"({"definitions": {"a": {"anyOf": []}}, "items": {"$ref": "#/definitions/a"}})",
        R"({"type": "null"})", R"({"type": ["number", "text"]})"})
    EXPECT_THROW(JsonSchema{json::parse(schema)}, std::invalid_argument) << schema;
}

TEST(JsonSchema, ExplainsEachKeyword) {
  struct Case {
    const char* schema;
    const char* valid;
    const char* invalid;
    const char* message;
  };
  for (const auto& [schema, valid, invalid, message] : std::initializer_list<Case>{
           {R"({"type": "integer"})", "1", "1.5", "the file: found 1.5, expected a whole number"},
           {R"({"type": ["number", "array"]})", "[]", R"("a")",
            R"(the file: found "a", expected a number or a list)"},
           {R"({"type": "boolean"})", "true", "null",
            "the file: found null, expected true or false"},
           {R"({"const": 2})", "2", "{}", "the file: found an object, expected 2"},
           {R"({"enum": ["a", "b"]})", R"("b")", "3",
            R"(the file: found 3, expected one of "a", "b")"},
           {R"({"minLength": 1})", R"("a")", R"("")",
            R"(the file: found "", expected a text that is not empty)"},
           {R"({"minimum": 1})", "1", "0", "the file: found 0, expected at least 1"},
           {R"({"exclusiveMinimum": 1})", "1.1", "1", "the file: found 1, expected more than 1"},
           {R"({"maximum": 0.5})", "0.5", "0.6", "the file: found 0.6, expected at most 0.5"},
           {R"({"minItems": 2})", "[1, 2]", "[1]",
            "the file: found a list of 1, expected at least 2 entries"},
           {R"({"maxItems": 1})", "[1]", "[1, 2]",
            "the file: found a list of 2, expected at most 1 entries"},
           {R"({"items": {"type": "number"}})", "[1, 2]", "[1, []]",
            "[1]: found a list of 0, expected a number"},
           {R"({"properties": {"a": {"type": "number"}}})", R"({"b": []})", R"({"a": []})",
            "a: found a list of 0, expected a number"},
           {R"({"properties": {"a": {}, "b": {}}, "additionalProperties": false})", R"({"a": 1})",
            R"({"c": 1})", R"(c: unknown key, expected one of "a", "b")"},
           {R"({"additionalProperties": {"maximum": 1}})", R"({"a": 1})", R"({"a": 2})",
            "a: found 2, expected at most 1"},
           {R"({"required": ["a"]})", R"({"a": 1})", "{}", "a: is missing"},
           {R"({"minProperties": 1, "properties": {"a": {}}})", R"({"a": 1})", "{}",
            R"(the file: found no key, expected exactly one of "a")"},
           {R"({"maxProperties": 1, "properties": {"a": {}, "b": {}}})", R"({"a": 1})",
            R"({"a": 1, "b": 2})", R"(the file: found "a", "b", expected exactly one of "a", "b")"},
           {R"({"allOf": [{"minimum": 1}, {"maximum": 2}]})", "2", "3",
            "the file: found 3, expected at most 2"},
           {R"({"oneOf": [{"description": "either", "minimum": 5}, {"maximum": 4}]})", "4", "4.5",
            "the file: expected either, found neither"},
           {R"({"oneOf": [{"description": "either", "minimum": 1}, {"maximum": 2}]})", "3", "1.5",
            "the file: expected either, found both"},
           {R"({"if": {"minimum": 1}, "then": {"maximum": 2}, "else": {"exclusiveMinimum": 0}})",
            "2", "3", "the file: found 3, expected at most 2"},
           {R"({"if": {"minimum": 1}, "then": {"maximum": 2}, "else": {"exclusiveMinimum": 0}})",
            "0.5", "0", "the file: found 0, expected more than 0"},
           {R"({"items": {"$ref": "#/definitions/a"}, "definitions": {"a": {"maximum": 1}}})",
            "[1]", "[2]", "[0]: found 2, expected at most 1"},
           {R"({"definitions": {"tree": {"items": {"$ref": "#/definitions/tree"}, "type": "array"}},
               "items": {"$ref": "#/definitions/tree"}})",
            "[[[]]]", "[[[1]]]", "[0][0][0]: found 1, expected a list"}}) {
    EXPECT_EQ(violation(schema, valid), "valid") << schema;
    EXPECT_EQ(violation(schema, invalid), message) << schema;
  }
}

TEST(JsonSchema, ResolvesReferencesIntoTheProjectSchema) {
  const json project = json::parse(
      R"({"definitions": {"a": {"items": {"$ref": "#/definitions/b"}}, "b": {"maximum": 1}}})");
  const JsonSchema schema(
      json::parse(R"({"items": {"$ref": "project.schema.json#/definitions/a"}})"), project);
  EXPECT_EQ(schema.violation(json::parse("[[1], [2]]")), "[1][0]: found 2, expected at most 1");
}

}  // namespace
}  // namespace palpa::modeling
