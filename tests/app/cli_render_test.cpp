// palpa-cli render. What the pictures look like is tested in tests/render.
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
