#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QPushButton>
#include <QTableWidget>

#include "app/gui/dialogs/colour_range_dialog.h"
#include "app/gui/widgets/quantity_edit.h"
#include "bem/triangle/results.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using Eigen::Vector3d;

class Sections : public WindowTest {
 protected:
  Simulation& simulation() { return window_->simulation(); }
  SectionView& section() { return window_->section(); }
  Samples& samples() { return window_->samples(); }

  void enter(const QString& project = kSphere) {
    ASSERT_TRUE(window_->openFile(project));
    waitForModel();
    action("Simulate")->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().drawn() != nullptr; }, 20000));
    QTest::qWait(50);
    moveTo(QPoint(10, 10));
  }
  /// A pull that stays.
  void pull() {
    const QPoint at = pixelOf({15, -15, 13});
    QTest::mousePress(&view(), Qt::LeftButton, {}, at);
    for (int i = 1; i <= 8; ++i) {
      moveTo(at + QPoint(8, -4) * i, Qt::LeftButton);
      QTest::qWait(15);
    }
    QTest::mouseRelease(&view(), Qt::LeftButton, Qt::ShiftModifier, at + QPoint(64, -32));
    ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().snapshot().contactCount == 1; }, 10000));
  }
  void key(int code) {
    view().setFocus();
    QTest::keyClick(&view(), static_cast<Qt::Key>(code));
  }
  bool waitForSection() {
    return QTest::qWaitFor(
        [&] {
          return section().section() && !section().isComputing() && !section().states().empty();
        },
        20000);
  }
  double largestInside() {
    double largest = 0;
    for (const auto& state : section().states())
      largest = std::max(largest, state.displacement.norm());
    return largest;
  }
};

TEST_F(Sections, ThePlaneIsMovedByKeysDragsAndNumbers) {
  enter();
  pull();
  key(Qt::Key_K);
  EXPECT_EQ(window_->tools().activeTitle(), "Section plane");
  ASSERT_TRUE(waitForSection());
  EXPECT_GT(largestInside(), 0.01) << "the field of the pull";
  key(Qt::Key_Y);
  key(Qt::Key_X);
  ASSERT_TRUE(waitForSection());
  EXPECT_EQ(section().plane().normal, Vector3d::UnitX());
  keepPicture("section-x");
  key(Qt::Key_X);
  EXPECT_EQ(section().plane().normal, -Vector3d::UnitX());
  key(Qt::Key_Z);
  ASSERT_TRUE(waitForSection());
  const double before = section().plane().offset;
  key(Qt::Key_Up);
  EXPECT_GT(section().plane().offset, before);
  // A drag upwards along z.
  const QPoint from = pixelOf(section().middle());
  const double start = section().plane().offset;
  drag(from, from - QPoint(0, 40));
  EXPECT_GT(section().plane().offset, start + 1);
  ASSERT_TRUE(waitForSection());
  EXPECT_NEAR(section().section()->plane().offset, section().plane().offset, 1e-12);
  // Typed numbers; beyond the body they are limited.
  auto* offset = find<QuantityEdit>("sectionOffset");
  ASSERT_TRUE(offset);
  offset->setFocus();
  offset->selectAll();
  QTest::keyClicks(offset, "5");
  QTest::keyClick(offset, Qt::Key_Return);
  EXPECT_NEAR(section().plane().offset, 5, 1e-12);
  offset->setFocus();
  offset->selectAll();
  QTest::keyClicks(offset, "500");
  QTest::keyClick(offset, Qt::Key_Return);
  EXPECT_LE(section().plane().offset, 26);
  ASSERT_TRUE(find<QPushButton>("sectionFlip"));
  find<QPushButton>("sectionFlip")->click();
  EXPECT_EQ(section().plane().normal, -Vector3d::UnitZ());
  // Other tools leave it; Delete removes it.
  key(Qt::Key_H);
  EXPECT_TRUE(section().isShown());
  EXPECT_TRUE(action("Section")->isChecked());
  key(Qt::Key_K);
  key(Qt::Key_Delete);
  EXPECT_FALSE(section().isShown());
  EXPECT_FALSE(action("Section")->isChecked());
}

// Default numbers in fields have few digits.
TEST_F(Sections, FieldsBeginWithReadableNumbers) {
  ASSERT_TRUE(window_->openFile(kSphere));
  editor().perform(modeling::TransformSolid{
      modeling::Scaling{Vector3d::Constant(1.0 / 3), Vector3d(20, 21, 23)}});
  waitForModel();
  action("Simulate")->trigger();
  ASSERT_TRUE(QTest::qWaitFor([&] { return simulation().drawn() != nullptr; }, 20000));
  moveTo(QPoint(10, 10));
  key(Qt::Key_K);
  ASSERT_TRUE(waitForSection());
  constexpr int kMaxLength = 9;  // "-13.333 mm" has 10
  const auto text = [this](const char* name) { return find<QuantityEdit>(name)->text(); };
  EXPECT_LE(text("sectionOffset").size(), kMaxLength) << text("sectionOffset").toStdString();
  for (const int axis : {Qt::Key_X, Qt::Key_Y, Qt::Key_Z, Qt::Key_Up}) {
    key(axis);
    EXPECT_LE(text("sectionOffset").size(), kMaxLength) << text("sectionOffset").toStdString();
  }
  const QPoint from = pixelOf(section().middle());
  drag(from, from - QPoint(0, 17));
  EXPECT_LE(text("sectionOffset").size(), kMaxLength) << text("sectionOffset").toStdString();
  key(Qt::Key_H);
  QTest::keyClick(&view(), Qt::Key_X);
  ASSERT_EQ(window_->tools().activeTitle(), "Exact touch");
  QTest::qWait(50);
  EXPECT_EQ(text("exactRadius").size(), 6) << text("exactRadius").toStdString();  // "3.1 mm"
  EXPECT_EQ(text("exactDepth").size(), 7) << text("exactDepth").toStdString();
}

TEST_F(Sections, EscapePutsADraggedPlaneBack) {
  enter();
  key(Qt::Key_K);
  key(Qt::Key_Z);
  ASSERT_TRUE(waitForSection());
  const double before = section().plane().offset;
  const QPoint from = pixelOf(section().middle());
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  moveTo(from - QPoint(0, 50), Qt::LeftButton);
  EXPECT_GT(section().plane().offset, before);
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_DOUBLE_EQ(section().plane().offset, before);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, from - QPoint(0, 50));
  EXPECT_EQ(window_->tools().activeTitle(), "Section plane");
}

TEST_F(Sections, TheFieldFollowsTheTouch) {
  enter();
  key(Qt::Key_K);
  ASSERT_TRUE(waitForSection());
  EXPECT_EQ(largestInside(), 0) << "nothing moves";
  key(Qt::Key_H);
  key(Qt::Key_X);  // not a tool's key now: the exact touch of the menu
  key(Qt::Key_H);
  pull();
  EXPECT_TRUE(QTest::qWaitFor([&] { return largestInside() > 0.05; }, 20000));
  for (const char* quantity : {"von Mises stress", "Normal traction", "Stiffness", "Plain"}) {
    action(quantity)->trigger();
    QTest::qWait(120);
  }
  action("Release all")->trigger();
  EXPECT_TRUE(QTest::qWaitFor([&] { return largestInside() < 1e-6; }, 20000));
}

TEST_F(Sections, SurvivesARebuildAndLeavingTheMode) {
  enter();
  key(Qt::Key_K);
  ASSERT_TRUE(waitForSection());
  const auto before = section().section();
  editor().perform(modeling::SetMaterial{{"other", 0.5, 0.4}});
  waitForModel();
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return section().section() && section().section() != before; }, 20000));
  action("Model")->trigger();
  EXPECT_FALSE(section().section());
  QTest::qWait(100);
  action("Simulate")->trigger();
  EXPECT_TRUE(waitForSection()) << "the section is shown again";
  // Another project, in the middle of the computation.
  key(Qt::Key_X);
  ASSERT_TRUE(window_->openFile(PALPA_PROJECTS "/box.json"));
  waitForModel();
  QTest::qWait(100);
}

TEST_F(Sections, SamplesArePinnedFollowTheTouchAndAreCopied) {
  enter();
  key(Qt::Key_I);
  EXPECT_EQ(window_->tools().activeTitle(), "Sample");
  const QPoint at = pixelOf({18, -14, 8});
  moveTo(at);
  QTest::qWait(100);
  keepPicture("sample-pointer");
  QTest::mouseClick(&view(), Qt::LeftButton, {}, at);
  ASSERT_EQ(samples().count(), 1);
  moveTo(pixelOf({10, -20, -5}));
  key(Qt::Key_Return);
  ASSERT_EQ(samples().count(), 2);
  EXPECT_EQ(samples().values()[0].displacement.norm(), 0);
  key(Qt::Key_H);
  pull();
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return samples().values()[0].displacement.norm() > 0.05; }, 10000));
  QTest::qWait(400);
  const app::PointSample sample = samples().values()[0];
  EXPECT_NEAR(sample.numbers.vonMises, bem::vonMises(sample.stress), 1e-12);
  EXPECT_LE((sample.displacement -
             simulation().displacementAt(simulation().body()->surface().tree().nearest(sample.at)))
                .norm(),
            0.02 * sample.displacement.norm());
  action("Minimum and maximum")->trigger();
  QTest::qWait(100);
  keepPicture("samples");
  auto* table = find<QTableWidget>("samplesTable");
  ASSERT_EQ(table->columnCount(), 2);
  find<QPushButton>("copySamples")->click();
  const QString text = QApplication::clipboard()->text();
  EXPECT_EQ(text.count('\n'), 3);
  EXPECT_TRUE(text.startsWith("sample,x_mm"));
  // Delete removes the selected one, in the table and in the view.
  table->selectColumn(0);
  QTest::keyClick(table, Qt::Key_Delete);
  EXPECT_EQ(samples().count(), 1);
  key(Qt::Key_I);
  key(Qt::Key_Delete);
  EXPECT_EQ(samples().count(), 0);
  EXPECT_EQ(table->columnCount(), 0);
}

TEST_F(Sections, SamplesInsideAreReadOnTheSection) {
  enter();
  pull();
  key(Qt::Key_K);
  key(Qt::Key_Y);
  key(Qt::Key_X);
  view().viewport().lookFrom(view::StandardView::kRight);
  view().update();
  ASSERT_TRUE(waitForSection());
  QTest::qWait(100);
  key(Qt::Key_I);
  const QPoint at = pixelOf({section().plane().offset, 2, 3});
  moveTo(at);
  QTest::mouseClick(&view(), Qt::LeftButton, {}, at);
  ASSERT_EQ(samples().count(), 1);
  const app::PointSample& sample = samples().values()[0];
  EXPECT_FALSE(sample.traction) << "inside";
  EXPECT_NEAR(sample.at.x(), section().plane().offset, 0.3);
  EXPECT_LT(sample.at.norm(), 24);
  EXPECT_GT(sample.displacement.norm(), 0);
  keepPicture("sample-inside");
  // Another project removes the pins.
  ASSERT_TRUE(window_->openFile(PALPA_PROJECTS "/box.json"));
  EXPECT_EQ(samples().count(), 0);
}

TEST_F(Sections, TheColourRangeIsFixedHeldAndRemembered) {
  enter();
  pull();
  QTest::qWait(200);
  withDialog<ColourRangeDialog>([&] { action("Fixed")->trigger(); },
                                [&](ColourRangeDialog& dialog) {
                                  const auto fields = dialog.findChildren<QuantityEdit*>();
                                  ASSERT_EQ(fields.size(), 2);
                                  fields[0]->selectAll();
                                  QTest::keyClicks(fields[0], "1");
                                  fields[1]->selectAll();
                                  QTest::keyClicks(fields[1], "3");
                                  dialog.accept();
                                });
  const std::array<double, 2> fixed{1, 3};
  EXPECT_TRUE(QTest::qWaitFor([&] { return simulation().range() == fixed; }, 10000));
  restart();
  enter();
  pull();
  EXPECT_TRUE(QTest::qWaitFor([&] { return simulation().range() == fixed; }, 10000))
      << "remembered";
  action("Symmetric")->trigger();
  EXPECT_TRUE(QTest::qWaitFor(
      [&] {
        return simulation().range()[0] < 0 && simulation().range()[0] == -simulation().range()[1];
      },
      10000));
  action("Hold")->trigger();
  const auto held = simulation().range();
  action("Release all")->trigger();
  QTest::qWait(200);
  EXPECT_EQ(simulation().range(), held);
  action("Automatic")->trigger();
  EXPECT_TRUE(QTest::qWaitFor([&] { return simulation().range()[0] == 0; }, 10000));
  // Cancelling the dialog leaves the range as it was.
  withDialog<ColourRangeDialog>([&] { action("Fixed")->trigger(); },
                                [](ColourRangeDialog& dialog) { dialog.reject(); });
  EXPECT_EQ(simulation().rangeMode(), Simulation::RangeMode::kAutomatic);
  EXPECT_TRUE(action("Automatic")->isChecked());
}

}  // namespace
}  // namespace palpa::gui
