// Messages of palpa-cli to new users.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

struct Slip {
  const char* name;
  const char* arguments;
  std::vector<const char*> words;  ///< that the message must contain
};

void PrintTo(const Slip& slip, std::ostream* stream) {
  *stream << slip.name;
}

class CliSlip : public testing::TestWithParam<Slip> {};

TEST_P(CliSlip, IsAnsweredWithWhatWasMeant) {
  const Runner cli;
  cli.run("new sphere -o ball.json");
  const Outcome outcome = cli.run(GetParam().arguments);
  EXPECT_EQ(outcome.exitCode, 2);
  EXPECT_EQ(outcome.err.rfind("palpa-cli: ", 0), 0u) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  for (const char* word : GetParam().words)
    EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " in " << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, CliSlip,
    testing::Values(
        Slip{"command", "tuoch ball.json", {"'tuoch'", "mean 'touch'?"}},
        Slip{"nothing_near", "frobnicate", {"'frobnicate'", "see palpa-cli --help"}},
        Slip{"no_command", "", {"name a command", "touch", "render"}},
        Slip{"option_first", "--json touch ball.json", {"--json stands where the command belongs"}},
        Slip{"option",
             "touch ball.json --displce 1,0,0",
             {"--displce", "mean '--displace'?", "palpa-cli touch --help"}},
        Slip{"option_with_value", "new sphere --raduis=3", {"--raduis", "mean '--radius'?"}},
        Slip{"negative_value",
             "touch ball.json --at 0,0,25 --displace -1,0,0 --radiu 3",
             {"no option --radiu", "mean '--radius'?"}},
        Slip{"one_too_many", "info ball.json other.json", {"does not expect 'other.json'"}},
        Slip{"no_file", "touch", {"touch needs a file", "palpa-cli touch --help"}},
        Slip{"no_output", "export ball.json", {"export needs --output"}},
        Slip{"shape", "new spher", {"'spher'", "mean 'sphere'?"}},
        Slip{"shape_unknown", "new dodecahedron", {"known are", "torus"}},
        Slip{"material", "new box --material steel", {"mean 'Structural steel'?"}},
        Slip{"kind", "touch ball.json --at 0,0,25 --kind bal --displace 0,0,-1", {"mean 'ball'?"}},
        Slip{"view", "render ball.json -o x.png --view up", {"no view 'up'", "front", "x,y,z"}}),
    [](const auto& slip) { return std::string(slip.param.name); });

TEST(CliUsage, HelpFitsATerminal) {
  const Runner cli;
  for (const char* arguments : {"--help", "touch --help", "render --help", "new --help"}) {
    std::istringstream help(cli.run(arguments).out);
    bool isExample = false;
    for (std::string line; std::getline(help, line);) {
      isExample = isExample || line.rfind("Example", 0) == 0;
      std::size_t columns = 0;
      for (const char c : line) columns += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
      if (isExample) continue;
      EXPECT_LE(columns, 80u) << arguments << ": " << line;
    }
    EXPECT_TRUE(isExample || arguments == std::string("--help"));
  }
}

TEST(CliUsage, VectorsMayHaveSpaces) {
  const Runner cli;
  cli.run("new box -o b.json");
  const Outcome outcome = cli.run("touch b.json --at '0, 0, 20' --displace '0, 0, -1'");
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
}

TEST(CliUsage, ABodyAtRestIsCalledSo) {
  const Runner cli;
  cli.run("new box -o b.json");
  EXPECT_NE(cli.run("solve b.json").out.find("no load acts"), std::string::npos);
}

TEST(CliUsage, NoiseBesideAForceIsZero) {
  const Runner cli;
  cli.run("new box --edge-length 6 -o b.json");
  const std::string out = cli.run("touch b.json --at 0,0,20 --displace 0,0,-1").out;
  // A symmetric body: across its force there is only the error of the method.
  const std::size_t from = out.find("force (");
  ASSERT_NE(from, std::string::npos) << out;
  const std::string vector = out.substr(from, out.find(')', from) - from);
  EXPECT_EQ(vector.find("e-"), std::string::npos) << vector;
}

}  // namespace
}  // namespace palpa::cli_tests
