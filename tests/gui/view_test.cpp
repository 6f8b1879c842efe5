#include <cmath>
#include <numbers>

#include "app/gui/view/saved_view.h"
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

TEST_F(View, TurnsAndZoomsByKeys) {
  ASSERT_TRUE(window_->openFile(kSphere));
  view().setFocus();
  const auto camera = [&] { return view().viewport().camera(); };
  const auto press = [&](Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    const view::CameraView before = camera();
    QTest::keyClick(&view(), key, modifiers);
    return before;
  };
  constexpr double kStep = std::numbers::pi / 12;
  const auto heading = [](const view::CameraView& of) {
    return std::atan2(of.direction.y(), of.direction.x());
  };
  view::CameraView before = press(Qt::Key_Right, Qt::AltModifier);
  EXPECT_NEAR(heading(before) - heading(camera()), kStep, 1e-3);
  before = press(Qt::Key_Left, Qt::AltModifier);
  EXPECT_NEAR(heading(camera()) - heading(before), kStep, 1e-3);
  before = press(Qt::Key_Down, Qt::AltModifier);
  EXPECT_LT(camera().direction.z(), before.direction.z() - 0.1);
  before = press(Qt::Key_Up, Qt::AltModifier);
  EXPECT_GT(camera().direction.z(), before.direction.z() + 0.1);

  before = press(Qt::Key_Plus);
  EXPECT_NEAR(camera().zoom, 1.25 * before.zoom, 1e-6);
  before = press(Qt::Key_Plus, Qt::KeypadModifier);
  EXPECT_NEAR(camera().zoom, 1.25 * before.zoom, 1e-6);
  before = press(Qt::Key_Minus);
  EXPECT_NEAR(camera().zoom, before.zoom / 1.25, 1e-6);
  before = press(Qt::Key_Equal);
  EXPECT_NEAR(camera().zoom, 1.25 * before.zoom, 1e-6);
  press(Qt::Key_F);
  EXPECT_NEAR(camera().zoom, 1, 1e-6);

  press(Qt::Key_1);
  EXPECT_NEAR(camera().direction.y(), 1, 1e-9);
  press(Qt::Key_1, Qt::ControlModifier);
  EXPECT_NEAR(camera().direction.y(), -1, 1e-9);
  press(Qt::Key_7, Qt::KeypadModifier);
  EXPECT_NEAR(camera().direction.z(), -1, 1e-9);
  press(Qt::Key_9);
  EXPECT_NEAR(camera().direction.z(), 1, 1e-9);
  press(Qt::Key_5);
  EXPECT_TRUE(camera().parallel);
}

TEST_F(View, KeysOfTheMenuAndOfTheSelectionKeepApart) {
  ASSERT_TRUE(window_->openFile(kSphere));
  view().setFocus();
  // Z and G are shortcuts of the menu without a selection, and begin a motion with one.
  QTest::keyClick(&view(), Qt::Key_Z);
  EXPECT_TRUE(action("Wire")->isChecked());
  QTest::keyClick(&view(), Qt::Key_G);
  EXPECT_FALSE(action("Grid")->isChecked());
  editor().select(Selection::ofPatches({0}));
  const std::string before = text();
  QTest::keyClick(&view(), Qt::Key_F, Qt::ShiftModifier);
  EXPECT_GT(view().viewport().camera().zoom, 1.05);
  QTest::keyClick(&view(), Qt::Key_Right, Qt::AltModifier);
  EXPECT_EQ(text(), before);
  QTest::keyClick(&view(), Qt::Key_Right);
  EXPECT_NE(text(), before);
  QTest::keyClick(&view(), Qt::Key_Z);
  QTest::keyClick(&view(), Qt::Key_1);
  QTest::keyClick(&view(), Qt::Key_F);
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_TRUE(action("Wire")->isChecked());
  EXPECT_GT(std::abs(view().viewport().camera().direction.x()), 0.1);
}

TEST_F(View, SurvivesANewContext) {
  ASSERT_TRUE(window_->openFile(kSphere));
  const QSize size = view().size();
  const QImage before = view().grab().toImage();
  const auto differing = [&] {
    const QImage now = view().grab().toImage();
    if (now.size() != before.size()) return 1.0;
    int count = 0;
    for (int y = 0; y < now.height(); ++y)
      for (int x = 0; x < now.width(); ++x)
        if (std::abs(qGray(now.pixel(x, y)) - qGray(before.pixel(x, y))) > 8) ++count;
    return count / static_cast<double>(now.width() * now.height());
  };
  EXPECT_LT(differing(), 1e-3);
  QWidget* central = window_->takeCentralWidget();
  central->setParent(nullptr);
  central->resize(size);
  central->show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(central));
  EXPECT_LT(differing(), 1e-3);
  // The scene changes while the view is hidden.
  editor().select(Selection::ofPatches({0}));
  EXPECT_GT(differing(), 1e-3);
  editor().select({});
  QWidget other;
  other.resize(size);
  central->setParent(&other);
  central->show();
  other.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&other));
  EXPECT_LT(differing(), 1e-3);
  window_->setCentralWidget(central);
  QTest::qWait(100);
  keepPicture("view-new-context");
}

TEST_F(View, AProjectWithoutAViewIsShownAsUsual) {
  ASSERT_TRUE(window_->openFile(kSphere));
  const view::CameraView usual = view().viewport().camera();
  action("Top")->trigger();
  action("Grid")->setChecked(false);
  action("Wire")->setChecked(true);
  action("Parallel projection")->setChecked(true);
  ASSERT_TRUE(window_->openFile(kSphere));
  EXPECT_TRUE(action("Grid")->isChecked());
  EXPECT_TRUE(action("Shaded with edges")->isChecked());
  EXPECT_FALSE(view().viewport().parallelProjection());
  EXPECT_NEAR((view().viewport().camera().direction - usual.direction).norm(), 0, 1e-9);
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
