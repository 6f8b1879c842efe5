#include "app/gui/saved_view.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using View = WindowTest;

TEST_F(View, StandardViewsAndTheOppositeSide) {
  ASSERT_TRUE(window_->openFile(kSphere));
  const auto direction = [&] { return view().viewport().camera().direction; };
  const std::vector<std::pair<QString, Eigen::Vector3d>> views{
      {"Front", {0, 1, 0}},  {"Back", {0, -1, 0}}, {"Left", {1, 0, 0}},
      {"Right", {-1, 0, 0}}, {"Top", {0, 0, -1}},  {"Bottom", {0, 0, 1}}};
  for (const auto& [name, expected] : views) {
    action(name)->trigger();
    EXPECT_NEAR((direction() - expected).norm(), 0, 1e-9) << name.toStdString();
    action("Opposite side")->trigger();
    EXPECT_NEAR((direction() + expected).norm(), 0, 1e-9) << name.toStdString();
  }
}

TEST_F(View, FitsTheSelection) {
  ASSERT_TRUE(window_->openFile(kSphere));
  editor().select(Selection::ofPatches({0}));
  const double all = view().viewport().camera().zoom;
  action("Fit selection")->trigger();
  EXPECT_GT(view().viewport().camera().zoom, 1.05 * all);
  keepPicture("view-fit-selection");
  action("Fit all")->trigger();
  EXPECT_NEAR(view().viewport().camera().zoom, 1, 1e-6);
}

TEST_F(View, IsSavedWithTheProjectAndRestored) {
  const QString file = folder_.filePath("view.json");
  action("Top")->trigger();
  action("Grid")->setChecked(false);
  action("Wire")->setChecked(true);
  action("Parallel projection")->setChecked(true);
  ASSERT_TRUE(editor().saveAs(file));
  restart();
  EXPECT_TRUE(action("Grid")->isChecked());
  ASSERT_TRUE(window_->openFile(file));
  EXPECT_FALSE(action("Grid")->isChecked());
  EXPECT_TRUE(action("Control net")->isChecked());
  EXPECT_TRUE(action("Wire")->isChecked());
  EXPECT_TRUE(view().viewport().parallelProjection());
  EXPECT_NEAR(view().viewport().camera().direction.z(), -1, 1e-9);
  EXPECT_FALSE(window_->isWindowModified());
  keepPicture("view-restored");
}

TEST_F(View, DamagedTextIsNoView) {
  SavedView saved;
  saved.showsNet = false;
  saved.camera.zoom = 2.5;
  const auto read = viewFromText(viewText(saved));
  ASSERT_TRUE(read);
  EXPECT_FALSE(read->showsNet);
  EXPECT_EQ(read->camera.zoom, 2.5);
  for (const char* text :
       {"", "{", "[]", "{}", R"({"direction":[0,0,0],"up":[0,0,1]})",
        R"({"direction":["a",0,1],"up":[0,0,1]})", R"({"direction":[0,1],"up":[0,0,1]})",
        R"({"direction":[0,1,0],"up":[0,0,1],"zoom":-1})",
        R"({"direction":[0,1,0],"up":[0,0,1],"zoom":1e300})"}) {
    EXPECT_FALSE(viewFromText(text)) << text;
  }
  EXPECT_TRUE(viewFromText(R"({"direction":[0,1,0],"up":[0,0,1],"shading":"odd","new":1})"));
}

}  // namespace
}  // namespace palpa::gui
