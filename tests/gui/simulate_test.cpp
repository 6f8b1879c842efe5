#include <QAction>
#include <QFontMetrics>
#include <QHeaderView>
#include <QLabel>
#include <QSignalSpy>
#include <QTreeWidget>

#include "app/core/live/touch_recording_file.h"
#include "app/core/results/touch.h"
#include "app/gui/docks/forces_dock.h"
#include "app/gui/simulate/simulate_tool.h"
#include "modeling/project/project_file.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using Status = app::TouchSnapshot::Status;

class Simulate : public WindowTest {
 protected:
  Simulation& simulation() { return window_->simulation(); }
  ForcesDock& forces() { return *find<ForcesDock>("forces"); }

  void enter() {
    ASSERT_TRUE(window_->openFile(kSphere));
    waitForModel();
    action("Simulate")->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().drawn() != nullptr; }, 20000));
    QTest::qWait(50);
  }
  /// A clearly visible point of the sphere.
  QPoint onBody() { return pixelOf({15, -15, 13}); }
  const app::TouchSnapshot::Contact* contact() {
    const auto touched = simulation().snapshot().touched();
    return touched.empty() ? nullptr : &touched.front();
  }
  bool waitForForce() {
    return QTest::qWaitFor([&] { return contact() && contact()->force.norm() > 1e-6; }, 20000);
  }
  void slowly(QPoint from, QPoint to, Qt::KeyboardModifiers modifiers = {}) {
    for (int i = 1; i <= 8; ++i) {
      moveTo(from + (to - from) * i / 8, Qt::LeftButton, modifiers);
      QTest::qWait(15);
    }
  }
};

TEST_F(Simulate, AGrabPullsAndTheDockSaysWithHowManyNewtons) {
  enter();
  const QPoint at = onBody();
  QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  slowly(at, at + QPoint(60, -30));
  ASSERT_TRUE(waitForForce());
  QTest::qWait(300);
  const auto held = *contact();
  EXPECT_EQ(held.status, Status::kGrabbed);
  EXPECT_GT(held.displacement.norm(), 1.0);
  // The panel shows the result of the loop.
  EXPECT_TRUE(forces().text(0, 0).startsWith("Grab 1"));
  EXPECT_EQ(forces().text(0, 1), shown(held.force.norm(), Quantity::kForce, {}, 4));
  EXPECT_TRUE(forces().text(1, 0).contains("base"));
  keepPicture("simulate-grab");
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, at + QPoint(60, -30));
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().snapshot().contactCount == 0; }, 5000));
  QTest::qWait(200);
  EXPECT_TRUE(forces().text(0, 0).contains("base"));
  EXPECT_EQ(simulation().displacementAt(held.point).norm(), 0.0);
}

TEST_F(Simulate, AHeldTouchIsNotDrawnAgain) {
  enter();
  const QPoint at = onBody();
  QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  slowly(at, at + QPoint(40, -20));
  ASSERT_TRUE(waitForForce());
  int painted = 0;
  QObject::connect(&view(), &ViewportWidget::framePainted, &view(), [&] { ++painted; });
  const auto isStill = [&] {
    painted = 0;
    QTest::qWait(400);
    return painted == 0;
  };
  EXPECT_TRUE(QTest::qWaitFor(isStill, 20000));
  // It is drawn again as soon as it moves.
  moveTo(at + QPoint(60, -30), Qt::LeftButton);
  EXPECT_TRUE(QTest::qWaitFor([&] { return painted > 0; }, 5000));
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, at + QPoint(60, -30));
}

TEST_F(Simulate, EnlargedDisplacementsFollowThePointer) {
  enter();
  const double scale = 5;
  simulation().setScale(scale);
  const QPoint at = onBody(), to = at + QPoint(60, -30);
  QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  slowly(at, to);
  ASSERT_TRUE(waitForForce());
  const auto drawn = [&] {
    const auto& point = contact()->point;
    return view().viewport().toPixel(point.position + scale * contact()->displacement);
  };
  // The place is drawn under the pointer: the motion was divided by the scale.
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return (drawn() - Eigen::Vector2d(to.x(), to.y())).norm() < 2.5; }, 3000))
      << drawn().transpose() << " is not " << to.x() << ' ' << to.y();
  keepPicture("simulate-enlarged");
  // A notch of the wheel presses as far as it does without enlargement: 5 % of the radius.
  const Eigen::Vector3d before = contact()->value;
  QWheelEvent event(to, view().mapToGlobal(to), {}, {0, 120}, Qt::LeftButton, {}, Qt::NoScrollPhase,
                    false);
  QApplication::sendEvent(&view(), &event);
  EXPECT_TRUE(QTest::qWaitFor(
      [&] {
        const double pressed = (contact()->value - before).norm();
        return std::abs(pressed - 0.05 * contact()->tool.radius) < 1e-6;
      },
      3000));
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, to);
}

TEST_F(Simulate, TheSurfaceIsPlainUntilItIsTouched) {
  enter();
  ASSERT_FALSE(simulation().values().empty());
  for (const double value : simulation().values()) ASSERT_TRUE(std::isnan(value));
  const QPoint at = onBody();
  QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  slowly(at, at + QPoint(30, 0));
  ASSERT_TRUE(waitForForce());
  for (const double value : simulation().values()) ASSERT_TRUE(std::isfinite(value));
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, at + QPoint(30, 0));
  EXPECT_TRUE(QTest::qWaitFor([&] { return std::isnan(simulation().values().front()); }, 5000));
}

TEST_F(Simulate, TheSurfaceIsColouredByItsStiffness) {
  enter();
  action("Stiffness")->trigger();
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().stiffnessReady() >= 1; }, 60000));
  QTest::qWait(100);
  // The colour at a place equals the stiffness of a fingertip there.
  const auto& body = *simulation().drawn();
  std::size_t top = 0;
  for (std::size_t i = 0; i < body.mesh().positions.size(); ++i)
    if (body.mesh().positions[i].z() > body.mesh().positions[top].z()) top = i;
  const double stiffness = simulation().values()[top];
  EXPECT_GT(stiffness, simulation().range()[0]);
  EXPECT_LT(stiffness, simulation().range()[1]);
  const Eigen::Vector3d at = body.mesh().positions[top];
  const double radius = app::defaultTouchRadius(body.model().setup().mesh());
  const auto id = simulation().begin({bem::ContactTool::Kind::kPush, radius, 0}, at,
                                     at - Eigen::Vector3d(0, 0, 0.5));
  ASSERT_TRUE(id);
  ASSERT_TRUE(waitForForce());
  QTest::qWait(100);
  EXPECT_NEAR(contact()->stiffness, stiffness, 0.03 * stiffness);
  keepPicture("simulate-stiffness");
  // On a support the stiffness exceeds the range of the colours.
  double stiffest = 0;
  for (const double value : simulation().values()) stiffest = std::max(stiffest, value);
  EXPECT_EQ(stiffest, simulation().range()[1]);
  EXPECT_TRUE(simulation().stiffnessColours().isCapped);
  // The body is stiffer under a wider fingertip.
  simulation().setFingertip(1.5 * radius);
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().stiffnessReady() >= 1; }, 60000));
  QTest::qWait(100);
  EXPECT_GT(simulation().values()[top], 1.05 * stiffness);
}

TEST_F(Simulate, TheForcesPanelNeedsNoScrollingAndLetsGo) {
  enter();
  keepPicture("simulate-forces-empty");
  const QPoint at = onBody();
  QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  slowly(at, at + QPoint(40, 20));
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::ShiftModifier, at + QPoint(40, 20));
  ASSERT_TRUE(waitForForce());
  forces().setFloating(true);
  forces().resize(300, 500);
  QTest::qWait(300);
  auto* list = forces().findChild<QTreeWidget*>("contacts");
  ASSERT_TRUE(list);
  EXPECT_LE(list->header()->length(), list->viewport()->width());
  const QFontMetrics metrics(list->font());
  for (int row = 0; row < 2; ++row) {
    const int indent = 2 * list->indentation() + 12;
    EXPECT_LE(metrics.horizontalAdvance(forces().details(row)) + indent, list->viewport()->width())
        << forces().details(row).toStdString();
    for (int column = 0; column < list->columnCount(); ++column)
      EXPECT_LE(metrics.horizontalAdvance(forces().text(row, column)), list->columnWidth(column))
          << forces().text(row, column).toStdString();
  }
  EXPECT_TRUE(forces().details(0).startsWith("holds: "));
  if (const QString folder = qEnvironmentVariable("PALPA_PICTURES"); !folder.isEmpty())
    forces().grab().save(folder + "/simulate-forces-300.png");
  // Delete ends the selected pin and does not act on the project.
  const std::string before = text();
  list->setCurrentItem(list->topLevelItem(0));
  list->setFocus();
  QTest::keyClick(list, Qt::Key_Delete);
  EXPECT_TRUE(QTest::qWaitFor([&] { return simulation().snapshot().contactCount == 0; }, 5000));
  EXPECT_EQ(text(), before);
}

TEST_F(Simulate, ABallIsPushedInWithTheWheel) {
  enter();
  action("Ball")->trigger();
  const QPoint at = onBody();
  QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  const auto push = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      QWheelEvent event(at, view().mapToGlobal(at), {}, {0, 120}, Qt::LeftButton, {},
                        Qt::NoScrollPhase, false);
      QApplication::sendEvent(&view(), &event);
      QTest::qWait(60);
    }
  };
  push(8);
  ASSERT_TRUE(waitForForce());
  const double before = contact()->force.norm();
  push(4);
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return contact() && contact()->force.norm() > before; }, 10000));
  EXPECT_TRUE(contact()->status == Status::kSticking || contact()->status == Status::kSlipping);
  // The contact presses: its force points into the body.
  EXPECT_LT(contact()->force.dot(contact()->point.position), 0);
  keepPicture("simulate-ball");
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, at);
}

TEST_F(Simulate, ShiftLeavesAPinAndEscapeLetsGo) {
  enter();
  const QPoint at = onBody();
  QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  slowly(at, at + QPoint(40, 20));
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::ShiftModifier, at + QPoint(40, 20));
  ASSERT_TRUE(waitForForce());
  // A second contact.
  const QPoint other = at + QPoint(-150, 40);
  action("Force")->trigger();
  QTest::mousePress(&view(), Qt::LeftButton, {}, other);
  slowly(other, other + QPoint(-40, 0));
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().snapshot().contactCount == 2; }, 5000));
  QTest::qWait(300);
  keepPicture("simulate-pin");
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, other + QPoint(-40, 0));
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().snapshot().contactCount == 1; }, 5000));
  QTest::keyClick(&view(), Qt::Key_Escape);
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().snapshot().contactCount == 0; }, 5000));
}

TEST_F(Simulate, AnEditDuringATouchSwapsTheModel) {
  enter();
  const QPoint at = onBody();
  QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  slowly(at, at + QPoint(40, 20));
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::ShiftModifier, at + QPoint(40, 20));
  ASSERT_TRUE(waitForForce());
  QTest::qWait(200);  // until the last motion has arrived
  const double before = contact()->force.norm();
  const std::uint64_t model = simulation().snapshot().model;
  modeling::Material stiffer = editor().project().material;
  stiffer.youngsModulus *= 2;
  ASSERT_TRUE(editor().perform(modeling::SetMaterial{stiffer}));
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().snapshot().model > model; }, 20000));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !simulation().isBehind(); }, 20000));
  QTest::qWait(100);
  ASSERT_TRUE(contact());
  EXPECT_NEAR(contact()->force.norm(), 2 * before, 1e-3 * before);
}

TEST_F(Simulate, ARecordingIsReplayedAndExported) {
  enter();
  action("Record")->trigger();
  const QPoint at = onBody();
  QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  slowly(at, at + QPoint(50, 10));
  ASSERT_TRUE(waitForForce());
  QTest::qWait(150);
  const Eigen::Vector3d force = contact()->force;
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, at + QPoint(50, 10));
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().snapshot().contactCount == 0; }, 5000));
  action("Record")->trigger();
  ASSERT_TRUE(action("Replay")->isEnabled());
  // In the window: the same force again.
  action("Replay")->trigger();
  double nearest = 1e9;
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        if (contact()) nearest = std::min(nearest, (contact()->force - force).norm());
        return action("Export forces")->isEnabled();
      },
      20000));
  EXPECT_LT(nearest, 1e-3 * force.norm());
  // The last contact line of the table before the release has the same force.
  const QString file = folder_.filePath("forces.csv");
  withDialog<QFileDialog>([&] { action("Export forces")->trigger(); },
                          [&](QFileDialog& dialog) { chooseFile(dialog, file); });
  QFile table(file);
  ASSERT_TRUE(table.open(QIODevice::ReadOnly));
  const QStringList lines = QString(table.readAll()).trimmed().split('\n');
  ASSERT_GT(lines.size(), 100);
  const int column = static_cast<int>(lines[0].split(',').indexOf("force_N"));
  EXPECT_NEAR(lines.back().split(',')[column].toDouble(), force.norm(), 1e-3 * force.norm());
  keepPicture("simulate-recorded");
  // A table of the saved recording has the same bytes.
  const QString kept = folder_.filePath("hand.json"), again = folder_.filePath("again.csv");
  withDialog<QFileDialog>([&] { action("Save recording")->trigger(); },
                          [&](QFileDialog& dialog) { chooseFile(dialog, kept); });
  const app::RecordingFile saved = app::readRecording(kept.toStdString());
  EXPECT_EQ(saved.model.name, window_->editor().project().name);
  EXPECT_GT(saved.recording.entries.size(), 2u);
  EXPECT_FALSE(saved.model.key.empty());
  withDialog<QFileDialog>([&] { action("Open recording")->trigger(); },
                          [&](QFileDialog& dialog) { chooseFile(dialog, kept); });
  withDialog<QFileDialog>([&] { action("Export forces")->trigger(); },
                          [&](QFileDialog& dialog) { chooseFile(dialog, again); });
  QFile second(again);
  ASSERT_TRUE(second.open(QIODevice::ReadOnly));
  table.seek(0);
  EXPECT_EQ(second.readAll(), table.readAll());
  // Not a recording: a message, and the present recording stays.
  const QString wrong = folder_.filePath("wrong.json");
  QFile broken(wrong);
  ASSERT_TRUE(broken.open(QIODevice::WriteOnly));
  broken.write("{\"format\": \"palpa-project\"}");
  broken.close();
  QSignalSpy refused(&window_->editor(), &Editor::refused);
  withDialog<QFileDialog>([&] { action("Open recording")->trigger(); },
                          [&](QFileDialog& dialog) { chooseFile(dialog, wrong); });
  ASSERT_EQ(refused.count(), 1);
  EXPECT_TRUE(refused[0][0].toString().contains("not a recording"));
  EXPECT_TRUE(action("Export forces")->isEnabled());
}

TEST_F(Simulate, ThePointerMovesWhileAnotherMeshTakesOver) {
  enter();
  const QPoint at = onBody();
  QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  slowly(at, at + QPoint(30, 0));
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::ShiftModifier, at + QPoint(30, 0));
  ASSERT_TRUE(waitForForce());
  // The finer mesh has triangle numbers that the old one lacks.
  const std::uint64_t model = simulation().snapshot().model;
  modeling::MeshSettings finer = editor().project().mesh;
  finer.edgeLength /= 1.6;
  ASSERT_TRUE(editor().perform(modeling::SetMesh{finer}));
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        moveTo(at + QPoint(35, 5));
        const auto& mesh = simulation().drawn()->model().setup().mesh();
        EXPECT_LT(contact()->point.triangle, static_cast<int>(mesh.triangles.size()));
        return simulation().snapshot().model > model;
      },
      120000));
}

TEST_F(Simulate, ClosingEndsAReplay) {
  enter();
  action("Record")->trigger();
  const QPoint at = onBody();
  QTest::mousePress(&view(), Qt::LeftButton, {}, at);
  slowly(at, at + QPoint(30, 0));
  QTest::qWait(500);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, at + QPoint(30, 0));
  QTest::qWait(50);
  action("Record")->trigger();
  action("Replay")->trigger();
  ASSERT_FALSE(action("Export forces")->isEnabled());  // running
  window_.reset();
}

TEST_F(Simulate, TheModelComesBackAsItWas) {
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  const std::string before = text();
  QTest::qWait(1200);  // until the fine picture is drawn
  const QImage picture = view().grab().toImage();
  action("Simulate")->trigger();
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().drawn() != nullptr; }, 20000));
  EXPECT_TRUE(action("Push")->isVisible());
  EXPECT_FALSE(action("Scale")->isVisible());
  keepPicture("simulate-rest");
  action("Model")->trigger();
  EXPECT_FALSE(simulation().isActive());
  EXPECT_TRUE(action("Scale")->isVisible());
  EXPECT_EQ(text(), before);
  EXPECT_TRUE(QTest::qWaitFor([&] { return view().grab().toImage() == picture; }, 10000));
}

}  // namespace
}  // namespace palpa::gui
