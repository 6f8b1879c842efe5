// The example projects: reproducible from their scripts, valid, and touchable.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

namespace fs = std::filesystem;

TEST(CliExamples, AreWhatTheirScriptsMake) {
  const Runner cli;
  const std::string command = std::string("PALPA_CLI=") + PALPA_CLI + " " + PALPA_PROJECTS +
                              "/../scripts/make-projects " + cli.path(".").string();
  ASSERT_EQ(std::system(command.c_str()), 0);
  int made = 0;
  for (const auto& entry : fs::recursive_directory_iterator(cli.path("."))) {
    if (entry.is_directory()) continue;
    const std::string name = fs::relative(entry.path(), cli.path("."));
    std::ifstream committed(fs::path(PALPA_PROJECTS) / name);
    std::ostringstream text;
    text << committed.rdbuf();
    EXPECT_TRUE(cli.read(name) == text.str()) << name << ": run scripts/make-projects";
    ++made;
  }
  EXPECT_EQ(made, 8);
}

class CliExample : public testing::TestWithParam<std::string> {
 protected:
  Runner cli_;
};

TEST_P(CliExample, IsSoundAndInEquilibriumWhenTouched) {
  const std::string file = Runner::example(GetParam() + ".json");
  const Json check = cli_.runJson("check " + file);
  EXPECT_TRUE(check.at("valid"));
  EXPECT_GE(check.at("quality").at("smallest_angle_degrees").get<double>(), 15.0);
  const Json touched = cli_.runJson("touch " + file);
  ASSERT_GE(touched.at("contacts").size(), 1u);
  for (const Json& contact : touched.at("contacts")) EXPECT_GT(norm(contact.at("force_N")), 0.0);
  // The contacts and the supports balance up to the error of a coarse mesh. The finger is bent: the
  // couple of forces in its base is many times the force at its tip, the reference of the error.
  const double most = GetParam() == "gripper-finger" ? 0.05 : 0.01;
  EXPECT_LE(touched.at("relative_balance").get<double>(), most);
}

INSTANTIATE_TEST_SUITE_P(All, CliExample, testing::ValuesIn(Runner::exampleNames()),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace palpa::cli_tests
