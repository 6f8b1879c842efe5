#include <QLabel>
#include <QTableWidget>

#include "app/gui/simulate/sample_words.h"
#include "app/view/camera/view_cube.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using Eigen::Vector3d;

/// Pins at rest: the sphere without a touch.
class SamplePins : public WindowTest {
 protected:
  Samples& samples() { return window_->samples(); }

  void enter() {
    ASSERT_TRUE(window_->openFile(kSphere));
    waitForModel();
    action("Simulate")->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return window_->simulation().drawn() != nullptr; }, 20000));
    QTest::qWait(50);
    action("Sample")->trigger();
    view().setFocus();
  }
  /// Presses at one place and moves to another with the button pressed.
  void pull(const Vector3d& from, const Vector3d& to) {
    const QPoint a = pixelOf(from), b = pixelOf(to);
    moveTo(a);
    QTest::mousePress(&view(), Qt::LeftButton, {}, a);
    for (int i = 1; i <= 4; ++i) moveTo(a + (b - a) * i / 4, Qt::LeftButton);
  }
  void release(const Vector3d& at) {
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, pixelOf(at));
  }
};

const Vector3d kFirst(18, -14, 8), kSecond(10, -20, -5);

TEST_F(SamplePins, ADragMovesAPin) {
  enter();
  QTest::mouseClick(&view(), Qt::LeftButton, {}, pixelOf(kFirst));
  ASSERT_EQ(samples().count(), 1);
  const Vector3d before = samples().values()[0].at;
  pull(before, kSecond);
  keepPicture("sample-dragged");
  release(kSecond);
  ASSERT_EQ(samples().count(), 1);
  const Vector3d after = samples().values()[0].at;
  EXPECT_LE((pixelOf(after) - pixelOf(kSecond)).manhattanLength(), 4);
  EXPECT_NEAR(after.norm(), 25, 0.3) << "on the surface";
  // Beside the body the pin stays where it was last.
  pull(after, {0, 0, 90});
  const Vector3d last = samples().values()[0].at;
  EXPECT_NEAR(last.norm(), 25, 0.3);
  release({0, 0, 90});
  // A motion without a button does nothing.
  moveTo(pixelOf(kFirst));
  EXPECT_EQ(samples().values()[0].at, last);
}

TEST_F(SamplePins, EscapeAndDeleteEndADrag) {
  enter();
  QTest::mouseClick(&view(), Qt::LeftButton, {}, pixelOf(kFirst));
  const Vector3d before = samples().values()[0].at;
  pull(before, kSecond);
  EXPECT_NE(samples().values()[0].at, before);
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_EQ(samples().values()[0].at, before);
  moveTo(pixelOf({5, -22, 5}), Qt::LeftButton);
  EXPECT_EQ(samples().values()[0].at, before);
  release(kSecond);
  pull(before, kSecond);
  QTest::keyClick(&view(), Qt::Key_Delete);
  EXPECT_EQ(samples().count(), 0);
  moveTo(pixelOf(kFirst), Qt::LeftButton);
  release(kFirst);
  EXPECT_EQ(samples().count(), 0);
  // The mode changes in the middle.
  QTest::mouseClick(&view(), Qt::LeftButton, {}, pixelOf(kFirst));
  pull(samples().values()[0].at, kSecond);
  action("Model")->trigger();
  release(kSecond);
  action("Simulate")->trigger();
  EXPECT_EQ(samples().count(), 1);
}

TEST_F(SamplePins, TheViewCubeWorksBesideThem) {
  enter();
  moveTo(pixelOf(kFirst));
  const QPoint cube(view().width() - 50, 50);
  ASSERT_TRUE(view().viewport().cubePartAt({cube.x(), cube.y()}));
  const Vector3d before = view().viewport().camera().direction;
  moveTo(cube);
  QTest::mouseClick(&view(), Qt::LeftButton, {}, cube);
  EXPECT_NE(view().viewport().camera().direction, before);
}

TEST_F(SamplePins, ComponentsHaveTheDecimalsOfTheLargest) {
  app::PointSample sample{};
  sample.at = {43.8712, 0.001, -1.80349};
  sample.displacement.setZero();
  sample.stress.setZero();
  sample.strain.setZero();
  sample.numbers.principal = {9.5641e-4, 8.924e-5, -6.732e-4};
  sample.numbers.directions.setIdentity();
  const std::vector<SampleRow> rows = sampleRows(sample, {});
  const auto valueOf = [&](const QString& name) {
    for (const SampleRow& row : rows)
      if (row.name.startsWith(name)) return row.value.toStdString();
    return std::string();
  };
  EXPECT_EQ(valueOf("Position"), "(43.87, 0, -1.80)");
  EXPECT_EQ(valueOf("Displacement"), "(0, 0, 0)");
  EXPECT_EQ(valueOf("Principal"), "(0.0009564, 0.0000892, -0.0006732)");
}

TEST_F(SamplePins, ThePanelAndTheKeySayWhatIsNeeded) {
  ASSERT_TRUE(window_->openFile(kSphere));
  auto* hint = find<QLabel>("samplesHint");
  EXPECT_FALSE(hint->isHidden());
  EXPECT_TRUE(hint->text().contains("Simulate mode (F5)"));
  view().setFocus();
  QTest::keyClick(&view(), Qt::Key_I);
  EXPECT_TRUE(window_->messages().messages().contains(
      "Sample is a tool of Simulate mode: change to it with F5"));
  enter();
  QTest::mouseClick(&view(), Qt::LeftButton, {}, pixelOf(kFirst));
  EXPECT_TRUE(hint->isHidden());
  EXPECT_FALSE(find<QTableWidget>("samplesTable")->isHidden());
}

}  // namespace
}  // namespace palpa::gui
