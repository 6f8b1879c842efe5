// palpa-cli touch --recording: the report, the table, and refused files.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

const std::string kSphere = Runner::example("sphere.json");
const std::string kHand =
    std::string(PALPA_PROJECTS) + "/../tests/data/recordings/sphere-hand.json";

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(CliRecording, SaysWhatEveryContactDid) {
  const Runner cli;
  const Json report = cli.runJson("touch " + kSphere + " --recording " + kHand);
  EXPECT_EQ(report.at("model"), report.at("recorded_model"));
  EXPECT_TRUE(report.at("warnings").empty());
  EXPECT_EQ(report.at("steps"), 400);
  EXPECT_EQ(report.at("unconverged_steps"), 0);
  const Json& contacts = report.at("contacts");
  ASSERT_EQ(contacts.size(), 3u);
  const char* kinds[] = {"grab", "push", "ball"};
  for (int k = 0; k < 3; ++k) EXPECT_EQ(contacts[k].at("kind"), kinds[k]);
  // In the recording a push begins before step 60 and ends before step 345.
  EXPECT_DOUBLE_EQ(contacts[1].at("from_s").get<double>(), 0.06);
  EXPECT_DOUBLE_EQ(contacts[1].at("to_s").get<double>(), 0.344);
  EXPECT_EQ(contacts[1].at("friction"), 0.3);
  for (const char* status : {"sticking", "slipping"}) {
    const auto& seen = contacts[1].at("statuses");
    EXPECT_NE(std::find(seen.begin(), seen.end(), status), seen.end()) << status;
  }
  for (const Json& contact : contacts) {
    const Json& largest = contact.at("largest_force");
    EXPECT_NEAR(norm(largest.at("force_N")), largest.at("N").get<double>(), 1e-9);
    EXPECT_GT(largest.at("N").get<double>(), 1);
  }
}

TEST(CliRecording, TheTableHasTheSameBytesOnAnyNumberOfThreads) {
  const Runner cli;
  std::string first;
  for (const char* threads : {"1", "2", "3"}) {
    const std::string name = std::string("f") + threads + ".csv";
    const Outcome outcome = cli.run("touch " + kSphere + " --recording " + kHand + " --threads " +
                                    threads + " -o " + name);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const std::string table = cli.read(name);
    if (first.empty()) first = table;
    EXPECT_TRUE(table == first) << threads << " threads";
  }
  const auto lines = linesOf(first);
  // One line for every contact of every step: 400 + (345 - 60) + (380 - 200), and the header.
  EXPECT_EQ(lines.size(), 866u);
  EXPECT_EQ(lines[0].find("time_s,contact,kind,status,"), 0u);
  EXPECT_EQ(lines[1].find("0,1,grab,holding,"), 0u) << lines[1];
  EXPECT_EQ(lines.back().find("0.399,1,grab,holding,"), 0u) << lines.back();
}

TEST(CliRecording, ASeriesHasAMeshForEveryPicture) {
  const Runner cli;
  const std::string replay = "touch " + kSphere + " --recording " + kHand;
  EXPECT_EQ(cli.runJson(replay + " --fps 10 -o hand.pvd").at("meshes"), 4);
  const std::string collection = cli.read("hand.pvd");
  for (const char* entry : {"timestep=\"0\"", "timestep=\"0.3\"", "file=\"hand/hand_00003.vtp\""})
    EXPECT_NE(collection.find(entry), std::string::npos) << entry;
  EXPECT_NE(cli.read("hand/hand_00003.vtp").find("displacement_mm"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(cli.path("hand/hand_00004.vtp")));

  EXPECT_EQ(cli.runJson("touch " + kSphere + " --sweep 2 -o sweep.pvd").at("sweep").size(), 3u);
  EXPECT_TRUE(std::filesystem::exists(cli.path("sweep/sweep_00002.vtp")));
  EXPECT_NE(cli.read("sweep.pvd").find("timestep=\"0.5\""), std::string::npos);

  for (const std::string& wrong : {replay + " --fps 10 -o a.csv", replay + " --fps 0 -o a.pvd",
                                   "touch " + kSphere + " --sweep 2 --fps 10 -o a.pvd"})
    EXPECT_EQ(cli.run(wrong).exitCode, 2) << wrong;
  EXPECT_EQ(cli.run("touch " + kSphere + " -o a.pvd").exitCode, 3) << "one state is no series";
  EXPECT_EQ(cli.run(replay + " -o no/such/folder/a.pvd").exitCode, 3);
  EXPECT_FALSE(std::filesystem::exists(cli.path("a.pvd")));
}

TEST(CliRecording, AnotherModelIsWarnedOf) {
  const Runner cli;
  const Json report =
      cli.runJson("touch " + kSphere + " --edge-length 6 --recording " + kHand + " -o r.json");
  ASSERT_EQ(report.at("warnings").size(), 1u);
  EXPECT_NE(report.at("warnings")[0].get<std::string>().find("another model"), std::string::npos);
  EXPECT_NE(report.at("model").at("key"), report.at("recorded_model").at("key"));
  EXPECT_EQ(cli.readJson("r.json").at("warnings"), report.at("warnings"));
}

TEST(CliRecording, WhatIsWrongIsRefusedWithThePlace) {
  const Runner cli;
  std::ifstream file(kHand);
  std::ostringstream text;
  text << file.rdbuf();
  std::string broken = text.str();
  broken.replace(broken.find("\"radius_mm\": 8"), 14, "\"radius_mm\": 0");
  cli.write("broken.json", broken);
  cli.write("cut.json", text.str().substr(0, text.str().size() / 2));
  const auto refusal = [&](const std::string& options, int code) {
    const Outcome outcome = cli.run("touch " + kSphere + " " + options);
    EXPECT_EQ(outcome.exitCode, code) << options << "\n" << outcome.err;
    return outcome.err;
  };
  EXPECT_NE(refusal("--recording broken.json", 3)
                .find("broken.json: commands[0].radius_mm: found 0, expected more than 0"),
            std::string::npos);
  EXPECT_NE(refusal("--recording cut.json", 3).find("cut.json"), std::string::npos);
  EXPECT_NE(refusal("--recording none.json", 3).find("none.json"), std::string::npos);
  EXPECT_NE(refusal("--recording " + kSphere, 3).find("not a recording"), std::string::npos);
  EXPECT_NE(refusal("--recording " + kHand + " --at 0,0,25 --displace 0,0,-1", 2)
                .find("--recording says itself"),
            std::string::npos);
  EXPECT_NE(refusal("--recording " + kHand + " -o f.vtp", 2).find(".csv, .pvd or .json"),
            std::string::npos);
  EXPECT_EQ(refusal("--recording " + kHand + " -o no/such/folder/f.csv", 3).empty(), false);
}

}  // namespace
}  // namespace palpa::cli_tests
