#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace palpa::cli_tests {

using Json = nlohmann::ordered_json;

/// Result of one call of palpa-cli.
struct Outcome {
  int exitCode = -1;
  std::string out;
  std::string err;

  /// The standard output as JSON; a failed test (and null) if it is not one object.
  Json json() const;
};

/// A temporary folder and calls of the built palpa-cli in it.
class Runner {
 public:
  Runner();
  ~Runner();
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  /// Runs palpa-cli in the folder; `arguments` are quoted as in a shell; `prefix` precedes the
  /// program: variables or a wrapper.
  Outcome run(const std::string& arguments, const std::string& prefix = "") const;

  /// Runs with --json, expects exit code 0 and returns the object.
  Json runJson(const std::string& arguments) const;

  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  std::string read(const std::string& name) const;
  void write(const std::string& name, const std::string& text) const;

  Json readJson(const std::string& name) const { return Json::parse(read(name)); }
  void writeJson(const std::string& name, const Json& json) const { write(name, json.dump(1)); }

  /// Path of an example project.
  static std::string example(const std::string& name);
  /// Names of all example projects, without the ending.
  static std::set<std::string> exampleNames();

 private:
  std::filesystem::path folder_;
};

/// Components of a JSON list of three numbers, and their norm.
double norm(const Json& vector);

}  // namespace palpa::cli_tests
