// Recordings as files: every bit comes back, and broken files are refused with the place.
#include "app/core/live/touch_recording_file.h"
#include "app/core/model/build_touch_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "app/core/live/touch_replay.h"
#include "app/core/model/contact_kind.h"
#include "core_projects.h"
#include "modeling/error.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using Kind = bem::ContactTool::Kind;
using What = TouchCommand::Kind;

RecordingFile example() {
  RecordingFile file{{"Ball \"soft\"", "0123456789abcdef", 602}, {}};
  TouchRecording& recording = file.recording;
  recording.steps = 40;
  const Vector3d none = Vector3d::Zero();
  recording.entries = {{0, {What::kBegin, 1, {Kind::kPush, 8, 0.3}, {0, 0, 25}, {0, 0, 1.0 / 3.0}}},
                       {0, {What::kBegin, 2, {Kind::kGrab, 6.5, 0}, {25, 0, 0}, {-1, 0, 1e-17}}},
                       {7, {What::kBegin, 3, {Kind::kBall, 10, 0.1}, {0, 25, 0}, {0, 34, 0}}},
                       {7, {What::kBegin, 4, {Kind::kForce, 5, 0}, {0, -25, 0}, {0, 0.1, -0.2}}},
                       {9, {What::kSet, 1, {}, none, {1e-3, 2, 23.456789012345678}}},
                       {30, {What::kEnd, 2, {}, none, none}},
                       {40, {What::kEnd, 1, {}, none, none}}};
  return file;
}

std::string errorOf(const std::string& text) {
  try {
    parseRecording(text, "hand.json");
  } catch (const modeling::ModelingError& error) {
    return error.what();
  }
  return "no error";
}

std::string errorWith(const std::string& from, const std::string& to) {
  std::string text = toJson(example());
  const std::size_t at = text.find(from);
  if (at == std::string::npos) return "the text has no " + from;
  return errorOf(text.replace(at, from.size(), to));
}

/// The kinds of contact as the schema lists them: all kinds of touch except pins.
std::string kindNames() {
  std::string names;
  for (const modeling::TouchKindInfo& info : modeling::kTouchKinds)
    if (contactKindNamed(info.name))
      names += (names.empty() ? "\"" : ", \"") + std::string(info.name) + "\"";
  return names;
}

TEST(TouchRecordingFile, KeepsEveryBit) {
  RecordingFile before = example();
  before.recording.modelChanges = 2;
  before.recording.isFull = true;
  const std::string text = toJson(before);
  const RecordingFile after = parseRecording(text, "test");
  EXPECT_EQ(toJson(after), text);
  EXPECT_EQ(after.model.name, before.model.name);
  EXPECT_EQ(after.model.key, before.model.key);
  EXPECT_EQ(after.model.nodes, 602);
  EXPECT_EQ(after.recording.steps, 40u);
  EXPECT_EQ(after.recording.modelChanges, 2);
  EXPECT_TRUE(after.recording.isFull);
  ASSERT_EQ(after.recording.entries.size(), before.recording.entries.size());
  for (std::size_t k = 0; k < before.recording.entries.size(); ++k) {
    const auto& a = before.recording.entries[k];
    const auto& b = after.recording.entries[k];
    EXPECT_EQ(a.step, b.step);
    EXPECT_EQ(a.command.kind, b.command.kind);
    EXPECT_EQ(a.command.id, b.command.id);
    EXPECT_EQ(a.command.value, b.command.value);
    if (a.command.kind != What::kBegin) continue;
    EXPECT_EQ(a.command.tool.kind, b.command.tool.kind);
    EXPECT_EQ(a.command.tool.radius, b.command.tool.radius);
    EXPECT_EQ(a.command.tool.friction, b.command.tool.friction);
    EXPECT_EQ(a.command.at, b.command.at);
  }
}

TEST(TouchRecordingFile, ReadsVersion1WhichCalledABallAProbe) {
  const std::string text = toJson(example());
  std::string old = text;
  const auto replace = [&old](const std::string& from, const std::string& to) {
    ASSERT_NE(old.find(from), std::string::npos) << from;
    old.replace(old.find(from), from.size(), to);
  };
  replace("\"version\": 2", "\"version\": 1");
  replace("\"kind\": \"ball\"", "\"kind\": \"probe\"");
  EXPECT_EQ(toJson(parseRecording(old, "old.json")), text);
}

TEST(TouchRecordingFile, ErrorsNameThePlace) {
  EXPECT_EQ(errorOf(toJson(example())), "no error");
  EXPECT_EQ(errorWith("palpa-recording", "palpa-project"),
            "hand.json: this is not a recording of Palpa (format is not \"palpa-recording\")");
  EXPECT_EQ(errorWith("\"version\": 2", "\"version\": 3"),
            "hand.json: version: found 3; this program reads up to version 2; a newer Palpa is "
            "needed");
  EXPECT_EQ(errorWith("\"kind\": \"ball\"", "\"kind\": \"hammer\""),
            "hand.json: commands[2].kind: found \"hammer\", expected one of " + kindNames());
  EXPECT_EQ(errorWith("\"radius_mm\": 8", "\"radius_mm\": -8"),
            "hand.json: commands[0].radius_mm: found -8, expected more than 0");
  EXPECT_EQ(errorWith("\"friction\": 0.3", "\"friction\": 11"),
            "hand.json: commands[0].friction: found 11, expected at most 10");
  EXPECT_EQ(errorWith("\"at_mm\": [0, 0, 25], ", ""), "hand.json: commands[0].at_mm: is missing");
  EXPECT_EQ(errorWith("[0, 0.1, -0.2]", "[0, 0.1]"),
            "hand.json: commands[3].value: found a list of 2, expected 3 entries");
  EXPECT_EQ(errorWith("{\"step\": 30, \"do\": \"end\", \"contact\": 2}",
                      "{\"step\": 30, \"do\": \"end\", \"contact\": 2, \"value\": [1, 2, 3]}"),
            "hand.json: commands[5].value: unknown key, expected one of \"contact\", \"do\", "
            "\"step\"");
  EXPECT_EQ(errorWith("\"step\": 9", "\"step\": 5"),
            "hand.json: commands[4].step: found 5 after a command before step 7");
  EXPECT_EQ(errorWith("\"steps\": 40", "\"steps\": 20"),
            "hand.json: commands[5].step: found 30, but the recording has 20 steps");
  EXPECT_EQ(errorWith("\"do\": \"set\", \"contact\": 1", "\"do\": \"set\", \"contact\": 9"),
            "hand.json: commands[4].contact: 9 was not begun");
  EXPECT_EQ(errorWith("\"step\": 40, \"do\": \"end\", \"contact\": 1",
                      "\"step\": 40, \"do\": \"end\", \"contact\": 2"),
            "hand.json: commands[6].contact: 2 has ended before");
  EXPECT_EQ(errorWith("\"contact\": 4", "\"contact\": 2"),
            "hand.json: commands[3].contact: 2 was begun before");
  EXPECT_NE(errorWith("0.1, -0.2", "1e999, -0.2").find("hand.json: "), std::string::npos);
  EXPECT_NE(errorWith("0.1, -0.2", "1e999, -0.2"), "no error");
}

TEST(TouchRecordingFile, RefusesMoreContactsThanThereCanBe) {
  for (const auto& [kind, most] : {std::pair{Kind::kGrab, 64}, std::pair{Kind::kBall, 8}}) {
    RecordingFile file = example();
    file.recording.entries.clear();
    for (int k = 0; k < most; ++k)
      file.recording.entries.push_back(
          {0, {What::kBegin, TouchId(k + 1), {kind, 5, 0}, {0, 0, 25}, {0, 0, 0}}});
    EXPECT_EQ(errorOf(toJson(file)), "no error");
    file.recording.entries.push_back(
        {0, {What::kBegin, TouchId(most + 1), {kind, 5, 0}, {0, 0, 25}, {0, 0, 0}}});
    const std::string error = errorOf(toJson(file));
    EXPECT_EQ(error.find("hand.json: commands[" + std::to_string(most) + "]: more than"), 0u)
        << error;
  }
}

TEST(TouchRecordingFile, BrokenFilesNeverCrashAndWhatIsReadCanBeSavedAgain) {
  const std::string good = toJson(example());
  std::mt19937 random(7);
  const auto upTo = [&](std::size_t end) { return random() % end; };
  const std::string bits = "0123456789-+.eE[]{},:\"\\ \n\tabnrutf\x01\xff";
  int readable = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string text = good;
    if (round % 3 == 0) {
      text.resize(upTo(good.size()));
    } else {
      for (std::size_t k = 0; k <= upTo(3); ++k) text[upTo(text.size())] = bits[upTo(bits.size())];
    }
    try {
      const RecordingFile file = parseRecording(text, "x");
      const std::string again = toJson(file);
      EXPECT_EQ(toJson(parseRecording(again, "x")), again);
      for (const auto& entry : file.recording.entries) {
        EXPECT_TRUE(entry.command.value.allFinite() && entry.command.at.allFinite());
        EXPECT_LE(entry.step, file.recording.steps);
      }
      ++readable;
    } catch (const modeling::ModelingError& error) {
      EXPECT_EQ(std::string(error.what()).find("x: "), 0u) << error.what();
    }
  }
  EXPECT_GT(readable, 10);
}

TEST(TouchRecordingFile, HugeAndDeepFilesAreRefused) {
  EXPECT_NE(errorOf(std::string(200'000, '[')), "no error");
  const auto folder = std::filesystem::temp_directory_path();
  const auto path = folder / "palpa-recording-too-large.json";
  {
    std::ofstream file(path);
    file << "{";
  }
  std::filesystem::resize_file(path, kMaxRecordingFile + 1);  // sparse
  EXPECT_THROW(readRecording(path), modeling::ModelingError);
  std::filesystem::remove(path);
  EXPECT_THROW(readRecording(folder / "palpa-no-such-recording.json"), modeling::ModelingError);
}

TEST(TouchRecordingFile, WhatCouldNotBeReadIsNotSaved) {
  const auto path = std::filesystem::temp_directory_path() / "palpa-recording-not-saved.json";
  std::filesystem::remove(path);
  RecordingFile file = example();
  file.recording.entries[0].command.value[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(writeRecording(file, path), modeling::ModelingError);
  EXPECT_FALSE(std::filesystem::exists(path));
  writeRecording(example(), path);
  EXPECT_EQ(toJson(readRecording(path)), toJson(example()));
  std::filesystem::remove(path);
}

TEST(TouchRecordingFile, AFileReplaysLikeTheRecordingAndKnowsItsModel) {
  const auto build = [](const modeling::Project& project) {
    return buildTouchModel(project, {}, {});
  };
  modeling::Project project = test::clampedSphere(6);
  const auto model = build(project);
  RecordingFile file = example();
  file.model = recordedModelOf(*model, "ball");
  const RecordingFile read = parseRecording(toJson(file), "test");
  const auto forces = [&](const TouchRecording& recording) {
    std::vector<Vector3d> seen;
    replay(std::make_shared<TouchableModel>(model), recording, {},
           [&](const TouchSnapshot& snapshot) {
             for (const auto& contact : snapshot.touched()) seen.push_back(contact.force);
           });
    return seen;
  };
  const auto expected = forces(file.recording);
  EXPECT_EQ(forces(read.recording), expected);
  EXPECT_GT(expected.back().norm(), 0);

  EXPECT_EQ(differenceOf(read.model, recordedModelOf(*build(project), "ball")), "");
  project.loads = {{"wind", modeling::Bump{{25, 0, 0}, 15, 0.001, {-1, 0, 0}}}};
  EXPECT_NE(differenceOf(read.model, recordedModelOf(*build(project), "ball")), "");
  project.loads.clear();
  project.material.youngsModulus *= 1.01;
  EXPECT_NE(differenceOf(read.model, recordedModelOf(*build(project), "ball")), "");
  const std::string other =
      differenceOf(read.model, recordedModelOf(*build(test::clampedSphere(7)), "apple"));
  EXPECT_NE(other.find("another model (\"ball\")"), std::string::npos) << other;
  EXPECT_NE(other.find("nodes instead of"), std::string::npos) << other;
}

}  // namespace
}  // namespace palpa::app
