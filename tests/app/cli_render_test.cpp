// palpa-cli render, and the plot of verify. tests/render tests the contents of pictures.
#include <gtest/gtest.h>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

class CliRender : public testing::Test {
 protected:
  CliRender() { cli_.run("new box --edge-length 8 -o p.json"); }

  Outcome draw(const std::string& arguments) const {
    return cli_.run("render p.json " + arguments, PALPA_WITH_DISPLAY);
  }

  Runner cli_;
};

std::pair<int, int> pngSize(const std::string& png) {
  if (png.size() < 24 || png.substr(1, 3) != "PNG") return {0, 0};
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t i = 0; i < 4; ++i)
      value = 256 * value + static_cast<unsigned char>(png[at + i]);
    return value;
  };
  return {number(16), number(20)};
}

TEST_F(CliRender, WritesAPicture) {
  const Outcome outcome = draw("--at 0,0,20 --displace 0,0,-2 -o a.png --json");
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_EQ(outcome.json().at("file"), "a.png");
  EXPECT_EQ(outcome.json().at("contacts").size(), 1u);
  EXPECT_EQ(pngSize(cli_.read("a.png")), std::pair(1200, 900));
}

TEST_F(CliRender, KnowsItsOptions) {
  for (const char* field : {"none", "displacement", "normal-traction", "von-mises", "stiffness"}) {
    const Outcome outcome =
        draw(std::string("--at 0,0,20 --force 0,0,-1 --size 320x240 --view front --parallel "
                         "--mesh-edges --reactions --no-ghost --scale 3 --zoom 1.2 -o a.png "
                         "--field ") +
             field);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(pngSize(cli_.read("a.png")), std::pair(320, 240));
  }
  for (const char* view : {"top", "bottom", "-1,0.5,-0.2"}) {
    EXPECT_EQ(draw(std::string("--size 200x150 -o a.png --view ") + view).exitCode, 0) << view;
  }
}

TEST_F(CliRender, RefusesWhatItCannotDo) {
  for (const char* arguments :
       {"", "-o a.png --size 12", "-o a.png --size 1x1", "-o a.png --field colour",
        "-o a.png --fingertip 3", "-o a.png --field stiffness --fingertip 0",
        "-o a.png --view behind", "-o a.png --view 0,0,0", "-o a.png --zoom 0"}) {
    EXPECT_EQ(draw(arguments).exitCode, 2) << arguments;
  }
  EXPECT_EQ(draw("-o no/such/folder/a.png").exitCode, 3);
}

TEST_F(CliRender, DrawsTheGradientOfAStiffness) {
  const std::string box = "render " + Runner::example("box.json") + " --size 320x240 -o a.png ";
  const auto drawn = [&](const std::string& arguments) {
    const Outcome outcome = cli_.run(box + arguments, PALPA_WITH_DISPLAY);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return cli_.read("a.png");
  };
  const std::string plain = drawn("--field none"), first = drawn("--field none --gradient");
  EXPECT_NE(first, plain);
  EXPECT_EQ(drawn("--field none --gradient --gradient-of \"press the top\""), first);
  EXPECT_NE(drawn("--field none --gradient --gradient-of \"pull the corner region\""), first);
  EXPECT_NE(drawn("--field stiffness-gradient"), plain);
  for (const char* wrong : {"--gradient --gradient-of nobody", "--gradient-of \"press the top\"",
                            "--gradient --recording r.json --at-time 0"})
    EXPECT_EQ(cli_.run(box + wrong, PALPA_WITH_DISPLAY).exitCode, 2) << wrong;
  EXPECT_EQ(draw("--gradient -o a.png").exitCode, 3) << "a project without touches";
}

TEST_F(CliRender, DrawsARecording) {
  const std::string recording =
      " --recording " PALPA_PROJECTS "/../tests/data/recordings/sphere-hand.json --size 240x180 ";
  const std::string render = "render " + Runner::example("sphere.json") + recording;
  const Outcome film = cli_.run(render + "--frames film/deep --fps 10 --json", PALPA_WITH_DISPLAY);
  ASSERT_EQ(film.exitCode, 0) << film.err;
  EXPECT_EQ(film.json().at("frames"), 4);  // 0, 0.1, 0.2, 0.3 s of 0.4 s
  for (const char* name : {"00000", "00001", "00002", "00003"})
    EXPECT_EQ(pngSize(cli_.read(std::string("film/deep/frame_") + name + ".png")),
              std::pair(240, 180));
  EXPECT_FALSE(std::filesystem::exists(cli_.path("film/deep/frame_00004.png")));
  EXPECT_NE(cli_.read("film/deep/frame_00000.png"), cli_.read("film/deep/frame_00003.png"));

  const Outcome one = cli_.run(render + "--at-time 0.28 -o at.png --json", PALPA_WITH_DISPLAY);
  ASSERT_EQ(one.exitCode, 0) << one.err;
  EXPECT_EQ(one.json().at("contacts").size(), 3u);
  EXPECT_EQ(pngSize(cli_.read("at.png")), std::pair(240, 180));

  for (const char* wrong :
       {"-o a.png", "--frames f -o a.png", "--at-time 0.1", "--at-time 0.1 -o a.png --fps 3",
        "--frames f --fps 0", "--frames f --at 0,0,25 --displace 0,0,-1", "--at-time -1 -o a.png"})
    EXPECT_EQ(cli_.run(render + wrong, PALPA_WITH_DISPLAY).exitCode, 2) << wrong;
  const Outcome late = cli_.run(render + "--at-time 0.4 -o a.png", PALPA_WITH_DISPLAY);
  EXPECT_EQ(late.exitCode, 3);
  EXPECT_NE(late.err.find("the recording lasts 0.400 s"), std::string::npos) << late.err;
}

TEST_F(CliRender, DrawsTheSeriesOfAVerification) {
  const std::string verify = "verify --quick --engine splines --case convergence_sphere --plot ";
  const Outcome drawn = cli_.run(verify + "a.png", PALPA_WITH_DISPLAY);
  EXPECT_EQ(drawn.exitCode, 0) << drawn.err;
  const auto [width, height] = pngSize(cli_.read("a.png"));
  EXPECT_GT(width, 1000);
  EXPECT_GT(height, 500);
  const Outcome nowhere = cli_.run(verify + "no/such/folder/a.png --json", PALPA_WITH_DISPLAY);
  EXPECT_EQ(nowhere.exitCode, 3);
  EXPECT_EQ(nowhere.json().at("pass"), true);
}

TEST_F(CliRender, SaysWhatToDoWithoutADisplay) {
  const Outcome outcome = cli_.run("render p.json -o a.png", "env -u DISPLAY");
  EXPECT_EQ(outcome.exitCode, 3);
  EXPECT_NE(outcome.err.find("xvfb-run"), std::string::npos) << outcome.err;
  const Outcome wrong = cli_.run("render p.json -o a.png", "env DISPLAY=:98765");
  EXPECT_EQ(wrong.exitCode, 3);
  EXPECT_NE(wrong.err.find(":98765"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace palpa::cli_tests
