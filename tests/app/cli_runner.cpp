#include "tests/app/cli_runner.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace palpa::cli_tests {
namespace fs = std::filesystem;

Json Outcome::json() const {
  try {
    return Json::parse(out);
  } catch (const Json::parse_error& error) {
    ADD_FAILURE() << "standard output is not JSON: " << error.what() << "\n" << out << err;
    return {};
  }
}

Runner::Runner() {
  std::string pattern = (fs::temp_directory_path() / "palpa-cli-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("cannot make a temporary folder");
  folder_ = pattern;
}

Runner::~Runner() {
  fs::remove_all(folder_);
}

Outcome Runner::run(const std::string& arguments, const std::string& prefix) const {
  const std::string command = "cd '" + folder_.string() + "' && " + prefix +
                              " "
                              "'" PALPA_CLI "' " +
                              arguments + " >.stdout 2>.stderr";
  const int status = std::system(command.c_str());
  Outcome outcome;
  outcome.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = read(".stdout");
  outcome.err = read(".stderr");
  return outcome;
}

Json Runner::runJson(const std::string& arguments) const {
  const Outcome outcome = run(arguments + " --json");
  EXPECT_EQ(outcome.exitCode, 0) << arguments << "\n" << outcome.err;
  return outcome.json();
}

std::string Runner::read(const std::string& name) const {
  std::ifstream file(path(name), std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

void Runner::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
}

std::string Runner::example(const std::string& name) {
  return "'" PALPA_PROJECTS "/" + name + "'";
}

std::set<std::string> Runner::exampleNames() {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(PALPA_PROJECTS))
    if (entry.path().extension() == ".json") names.insert(entry.path().stem());
  return names;
}

double norm(const Json& vector) {
  return std::hypot(vector.at(0).get<double>(), vector.at(1).get<double>(),
                    vector.at(2).get<double>());
}

}  // namespace palpa::cli_tests
