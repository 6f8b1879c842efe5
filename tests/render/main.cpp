// Regression test of the pictures:
//   CASE BASELINES OUTPUT   draws one case and compares it with BASELINES/CASE.png
//   --cases NAME…           fails unless these are all the cases
//   --notices OUTPUT        fails unless the comparison detects visible changes
//   --reused OUTPUT         fails unless a window shows the same after showing something else
//   --moving OUTPUT         fails unless a large body has fewer triangles while it moves
//   --no-display            fails unless drawing without a display throws
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "app/view/files/errors.h"
#include "tests/render/compare.h"
#include "tests/render/moving_body.h"
#include "tests/render/picture_scenes.h"
#include "tests/render/simulate_scenes.h"
#include "tests/render/viewport_scenes.h"

namespace palpa::render_tests {
namespace {

namespace fs = std::filesystem;

/// Functions that draw the cases.
std::map<std::string, std::function<void(const fs::path&)>> pictures() {
  std::map<std::string, std::function<void(const fs::path&)>> all;
  for (const auto& [name, scene] : pictureCases()) {
    all[name] = [scene](const fs::path& path) {
      view::writePicture(scene.picture, scene.size, path);
    };
  }
  for (const auto& cases : {viewportCases(), simulateCases()}) {
    for (const auto& [name, scene] : cases) {
      all[name] = [scene](const fs::path& path) { draw(scene, path); };
    }
  }
  return all;
}

int drawAndCompare(const std::string& name, const fs::path& baselines, const fs::path& output) {
  const auto cases = pictures();
  const auto found = cases.find(name);
  if (found == cases.end()) {
    std::cerr << name << ": there is no such scene\n";
    return 1;
  }
  fs::create_directories(output);
  const fs::path picture = output / (name + ".png");
  const fs::path baseline = baselines / (name + ".png");
  const fs::path difference = output / (name + ".difference.png");
  fs::remove(difference);
  found->second(picture);
  if (!fs::exists(baseline)) {
    std::cerr << name << ": no baseline; look at " << picture << " and copy it to " << baseline
              << " if it is right\n";
    return 1;
  }
  const Difference result = compare(picture, baseline, difference);
  std::cout << name << ": " << result.text() << '\n';
  if (result.acceptable()) {
    fs::remove(difference);
    return 0;
  }
  std::cerr << name << ": differs from " << baseline << "; see " << picture << " and " << difference
            << '\n';
  return 1;
}

int requireAllCases(const std::vector<std::string>& names) {
  const std::set<std::string> listed(names.begin(), names.end());
  std::set<std::string> scenes;
  for (const auto& [name, unused] : pictures()) scenes.insert(name);
  if (listed == scenes) return 0;
  std::cerr << "the scenes and the list in CMakeLists.txt differ\n";
  return 1;
}

/// Number of changes of a case, whose picture is `base`, that the comparison does not detect;
/// `same` changes nothing.
int countUnnoticed(const ViewportCase& original, const fs::path& base, const std::string& same,
                   const std::map<std::string, std::function<void(view::Viewport&)>>& changes,
                   const fs::path& output) {
  int failures = 0;
  for (const auto& [name, change] : changes) {
    ViewportCase changed = original;
    changed.setUp = [&](view::Viewport& viewport) {
      original.setUp(viewport);
      change(viewport);
    };
    const fs::path picture = output / ("notices_" + name + ".png");
    draw(changed, picture);
    const Difference result = compare(picture, base, {});
    const bool right = result.acceptable() == (name == same);
    std::cout << name << ": " << result.text() << (right ? "" : "  <- wrong") << '\n';
    failures += !right;
  }
  return failures;
}

/// Small but visible changes of a viewport; each must be found.
int requireViewportChangesNoticed(const fs::path& output) {
  const ViewportCase original = viewportCases().at("viewport_selection_gizmo");
  const fs::path base = output / "notices_viewport.png";
  draw(original, base);
  const std::map<std::string, std::function<void(view::Viewport&)>> changes{
      {"viewport_same", [](view::Viewport&) {}},
      {"viewport_no_gizmo", [](view::Viewport& v) { v.setGizmo({}); }},
      {"viewport_no_net", [](view::Viewport& v) { v.setControlNetVisible(false); }},
      {"viewport_no_grid", [](view::Viewport& v) { v.setGridVisible(false); }},
      {"viewport_no_axes", [](view::Viewport& v) { v.setAxesVisible(false); }},
      {"viewport_no_lines", [](view::Viewport& v) { v.setShading(view::Shading::kShaded); }},
      {"viewport_turned",
       [](view::Viewport& v) {
         v.orbit({4, 0});
       }},
  };
  return countUnnoticed(original, base, "viewport_same", changes, output);
}

/// The same for contents of a simulation.
int requireTouchChangesNoticed(const fs::path& output) {
  const ViewportCase original = simulateCases().at("simulate_pull_ghost");
  const fs::path base = output / "notices_touch.png";
  draw(original, base);
  const std::map<std::string, std::function<void(view::Viewport&)>> changes{
      {"touch_same", [](view::Viewport&) {}},
      {"touch_no_arrow", [](view::Viewport& v) { v.setLiveArrows({}); }},
      {"touch_no_ring", [](view::Viewport& v) { v.setContactRings({}); }},
      {"touch_no_ghost", [](view::Viewport& v) { v.setGhost({}); }},
      {"touch_no_field", [](view::Viewport& v) { v.setField({}); }},
      {"touch_a_ball",
       [](view::Viewport& v) {
         v.setBalls({{{12, -25, 8}, 5}});
       }},
  };
  return countUnnoticed(original, base, "touch_same", changes, output);
}

/// A window that has shown another case shows the same as a new one.
int requireNothingLeftBehind(const fs::path& output) {
  fs::create_directories(output);
  std::map<std::string, ViewportCase> cases = viewportCases();
  cases.merge(simulateCases());
  const fs::path fresh = output / "fresh.png";
  const fs::path reused = output / "reused.png";
  int failures = 0;
  for (const auto& [first, last] : {std::pair{"viewport_knot_lines", "viewport_high_dpi"},
                                    std::pair{"viewport_high_dpi", "viewport_selection_gizmo"},
                                    std::pair{"viewport_knot_lines", "viewport_close_up"},
                                    std::pair{"simulate_many_contacts", "simulate_push"},
                                    std::pair{"simulate_traction", "simulate_updated"},
                                    std::pair{"simulate_pull_ghost", "viewport_close_up"}}) {
    ViewportCase before = cases.at(first);
    ViewportCase after = cases.at(last);
    // Cases do not set visibilities again.
    after.setUp = [setUp = after.setUp](view::Viewport& viewport) {
      viewport.setControlNetVisible(true);
      viewport.setGridVisible(true);
      viewport.setGhost({});
      viewport.setLiveArrows({});
      viewport.setContactRings({});
      setUp(viewport);
    };
    draw(after, fresh);
    drawAfter(before, after, reused);
    const Difference result = compare(reused, fresh, {});
    std::cout << first << ", " << last << ": " << result.text() << '\n';
    failures += !(result.sameSize && result.largestBlock == 0);
  }
  return failures == 0 ? 0 : 1;
}

/// Draws one scene with small but visible changes; each must be found.
int requireChangesNoticed(const fs::path& output) {
  fs::create_directories(output);
  PictureCase original = pictureCases().at("picture_push");
  original.size = {1200, 900};
  const fs::path base = output / "notices.png";
  view::writePicture(original.picture, original.size, base);

  std::map<std::string, view::Picture> changed;
  for (const char* name : {"same", "other_number", "no_arrow", "no_ring", "no_ghost", "other_range",
                           "no_title", "no_supports", "turned_by_two_degrees"}) {
    changed[name] = original.picture;
  }
  changed["other_number"].arrows.arrows[0].label = "7.00 N";
  changed["no_arrow"].arrows.arrows.pop_back();
  changed["no_ring"].rings.clear();
  changed["no_ghost"].hasGhost = false;
  changed["other_range"].field->range = {0.0, 6.0};
  changed["no_title"].caption.title.clear();
  changed["no_supports"].supports.clear();
  changed["turned_by_two_degrees"].camera.direction += Eigen::Vector3d(0.02, 0.03, 0);

  int failures = 0;
  for (const auto& [name, scene] : changed) {
    const fs::path picture = output / ("notices_" + name + ".png");
    view::writePicture(scene, original.size, picture);
    const Difference result = compare(picture, base, {});
    const bool right = result.acceptable() == (name == "same");
    std::cout << name << ": " << result.text() << (right ? "" : "  <- wrong") << '\n';
    failures += !right;
  }
  failures += requireViewportChangesNoticed(output);
  failures += requireTouchChangesNoticed(output);
  return failures == 0 ? 0 : 1;
}

int requireDisplayError() {
  unsetenv("DISPLAY");
  try {
    view::writePicture(pictureCases().begin()->second.picture, {}, "never-written.png");
  } catch (const view::NoDisplayError& error) {
    const std::string message = error.what();
    std::cout << message << '\n';
    return message.find("xvfb-run") != std::string::npos ? 0 : 1;
  }
  std::cerr << "drew without a display\n";
  return 1;
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() == 1 && arguments[0] == "--no-display") return requireDisplayError();
  if (arguments.size() == 2 && arguments[0] == "--notices") {
    return requireChangesNoticed(arguments[1]);
  }
  if (arguments.size() == 2 && arguments[0] == "--reused") {
    return requireNothingLeftBehind(arguments[1]);
  }
  if (arguments.size() == 2 && arguments[0] == "--moving") {
    return requireFewerTrianglesWhileMoving(arguments[1]);
  }
  if (!arguments.empty() && arguments[0] == "--cases") {
    return requireAllCases({arguments.begin() + 1, arguments.end()});
  }
  if (arguments.size() == 3) return drawAndCompare(arguments[0], arguments[1], arguments[2]);
  std::cerr << "usage: palpa_render_tests CASE BASELINES OUTPUT\n";
  return 2;
}

}  // namespace
}  // namespace palpa::render_tests

int main(int argc, char** argv) {
  try {
    return palpa::render_tests::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "palpa_render_tests: " << error.what() << '\n';
    return 1;
  }
}
