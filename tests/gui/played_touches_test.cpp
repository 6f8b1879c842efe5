#include <QLabel>
#include <QTreeWidget>

#include "app/core/results/touch.h"
#include "app/gui/docks/forces_dock.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

/// Stored touches played in Simulate mode, and the Forces panel with several contacts.
class PlayedTouches : public WindowTest {
 protected:
  Simulation& simulation() { return window_->simulation(); }
  ForcesDock& forces() { return *find<ForcesDock>("forces"); }

  void simulate() {
    waitForModel();
    action("Simulate")->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().drawn() != nullptr; }, 20000));
    QTest::qWait(50);
  }
  std::optional<app::TouchId> pull(const Eigen::Vector3d& at, const Eigen::Vector3d& by) {
    const auto id = simulation().begin({bem::ContactTool::Kind::kGrab, 6, 0}, at, by);
    EXPECT_TRUE(id && QTest::qWaitFor(
                          [&] {
                            const auto* found = simulation().snapshot().find(*id);
                            return found && found->force.norm() > 0;
                          },
                          20000));
    QTest::qWait(200);
    return id;
  }
};

TEST_F(PlayedTouches, ArePlayedAsTheCommandLinePlaysThem) {
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  ASSERT_TRUE(editor().perform(
      modeling::AddTouch{{"side", {25, 0, 0}, modeling::TouchKind::kForce, {-0.3, 0, 0}, 6.0}}));
  ASSERT_TRUE(editor().perform(
      modeling::AddTouch{{"ball", {0, -25, 0}, modeling::TouchKind::kBall, {0, 1.5, 0}, 8.0}}));
  simulate();
  QTest::keyClick(&view(), Qt::Key_T);
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().snapshot().contactCount == 3; }, 20000));
  // A second, and the time for their columns.
  const auto model = editor().model();
  const app::TouchState exact = app::playTouches(*model, editor().project().touches);
  const auto differs = [&](std::size_t k) {
    const auto touched = simulation().snapshot().touched();
    return touched.size() <= k ? 1.0
                               : (touched[k].force - exact.contacts[k].force).norm() /
                                     exact.contacts[k].force.norm();
  };
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_TRUE(QTest::qWaitFor([&] { return differs(k) < 0.02; }, 20000))
        << k << ' ' << differs(k);
  keepPicture("project-touches");
}

TEST_F(PlayedTouches, WaitUntilThereIsSomethingToPlay) {
  ASSERT_TRUE(window_->openFile(kSphere));
  QAction* play = action("Play the touches of the project");
  EXPECT_FALSE(play->isVisible());
  simulate();
  EXPECT_TRUE(play->isEnabled());
  ASSERT_TRUE(editor().perform(modeling::RemoveTouch{"press the pole"}));
  EXPECT_FALSE(play->isEnabled());
}

TEST_F(PlayedTouches, DeleteOverTheViewLeavesTheProjectAlone) {
  ASSERT_TRUE(window_->openFile(kSphere));
  simulate();
  editor().select(Selection::of(Selection::Kind::kSupport, "base"));
  const std::string before = text();
  const auto pin = pull({15, -15, 13}, {0.5, -0.5, 0.5});
  view().setFocus();
  moveTo({5, 5});
  QTest::keyClick(&view(), Qt::Key_Delete);
  EXPECT_EQ(text(), before);
  EXPECT_TRUE(simulation().snapshot().find(*pin));
  // Delete over a pin removes it.
  const auto& contact = *simulation().snapshot().find(*pin);
  moveTo(pixelOf(contact.point.position + simulation().displacementAt(contact.point)));
  QTest::keyClick(&view(), Qt::Key_Delete);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !simulation().snapshot().find(*pin); }, 5000));
  EXPECT_EQ(text(), before);
}

TEST_F(PlayedTouches, ContactsKeepTheirNumbers) {
  ASSERT_TRUE(window_->openFile(kSphere));
  simulate();
  const auto first = pull({15, -15, 13}, {0.5, -0.5, 0.5});
  pull({0, -25, 0}, {0, -0.5, 0});
  QTest::qWait(200);
  EXPECT_EQ(forces().text(0, 0), "Grab 1");
  EXPECT_EQ(forces().text(1, 0), "Grab 2");
  simulation().end(*first);
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().snapshot().contactCount == 1; }, 5000));
  QTest::qWait(300);
  EXPECT_EQ(forces().text(0, 0), "Grab 2");
  // The row has the colour of its curve.
  const QIcon spot = find<QTreeWidget>("contacts")->topLevelItem(0)->icon(0);
  const auto [red, green, blue] = view::ForcePlot::colour(1);
  EXPECT_EQ(spot.pixmap(8, 8).toImage().pixelColor(4, 4), QColor(red, green, blue));
}

TEST_F(PlayedTouches, LoadsAreListedAmongTheForces) {
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  modeling::Load load;
  load.name = "wind";
  load.what = modeling::UniformTraction{modeling::Region::ofPatches({"side_xmax"}), {0.001, 0, 0}};
  ASSERT_TRUE(editor().perform(modeling::AddLoad{load}));
  simulate();
  QTest::qWait(300);
  EXPECT_EQ(forces().text(0, 0), "Load wind");
  EXPECT_EQ(forces().text(1, 0), "Support base");
}

TEST_F(PlayedTouches, LargeDeformationsAreCalledSo) {
  ASSERT_TRUE(window_->openFile(kSphere));
  simulate();
  const auto says = [&] { return find<QLabel>("forcesSummary")->text().contains("linear"); };
  const auto small = pull({15, -15, 13}, {0.5, -0.5, 0.5});
  EXPECT_FALSE(says());
  simulation().move(*small, {12, -12, 12});
  EXPECT_TRUE(QTest::qWaitFor(says, 5000));
}

}  // namespace
}  // namespace palpa::gui
