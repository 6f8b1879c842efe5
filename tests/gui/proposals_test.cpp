// The support and the touch that the window proposes, and the support of an imported body.
#include "modeling/exchange/cad_export.h"
#include "modeling/exchange/mesh_writer.h"
#include "modeling/shapes/primitives.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

class Proposals : public WindowTest {
 protected:
  /// Opens a box of 20 x 16 x 12 mm from a STEP file.
  void openBox() {
    const QString file = folder_.filePath("box.step");
    modeling::exportCad(modeling::makeBox({20, 16, 12}), file.toStdString(), "box");
    QObject::connect(&editor(), &Editor::said, &editor(),
                     [this](const QString& text) { said_ += text; });
    ASSERT_TRUE(window_->openFile(file));
  }

  void removeSupports() {
    while (!editor().project().supports.empty())
      editor().perform(modeling::RemoveSupport{editor().project().supports.front().name});
  }

  QString said_;
};

TEST_F(Proposals, AnImportedBodyIsHeldOnItsLargestFlatFace) {
  openBox();
  ASSERT_EQ(editor().project().supports.size(), 1u);
  EXPECT_EQ(editor().project().supports[0].where, modeling::Region::ofPatches({"bottom"}));
  EXPECT_TRUE(said_.contains("held on the largest flat face, \"bottom\"")) << said_.toStdString();
}

TEST_F(Proposals, TheSupportIsTheSelectedFaceOrTheLargestFlatOne) {
  openBox();
  removeSupports();
  action("Propose a support")->trigger();
  ASSERT_EQ(editor().project().supports.size(), 1u);
  EXPECT_EQ(editor().project().supports[0].where, modeling::Region::ofPatches({"bottom"}));
  EXPECT_EQ(editor().selection(), Selection::of(Selection::Kind::kSupport, "base"));
  editor().undo();
  EXPECT_TRUE(editor().project().supports.empty());

  const int side = *modeling::findPatch(editor().project().body, "side_xmin");
  editor().select(Selection::ofPatches({side}));
  action("Propose a support")->trigger();
  action("Propose a support")->trigger();
  ASSERT_EQ(editor().project().supports.size(), 2u) << "a second one has another name";
  EXPECT_EQ(editor().project().supports[0].where, modeling::Region::ofPatches({"side_xmin"}));
}

TEST_F(Proposals, TheTouchIsOppositeToTheSupport) {
  openBox();
  action("Propose a touch")->trigger();
  ASSERT_EQ(editor().project().touches.size(), 1u);
  const modeling::Touch& touch = editor().project().touches[0];
  EXPECT_NEAR(touch.at.z(), 12, 1e-9);
  EXPECT_LT(touch.vector.z(), 0);
  EXPECT_NEAR(touch.vector.norm(), 0.01 * std::sqrt(400 + 256 + 144), 1e-9);
  EXPECT_EQ(editor().selection(), Selection::of(Selection::Kind::kTouch, touch.name));
  removeSupports();
  EXPECT_FALSE(action("Propose a touch")->isEnabled());
  EXPECT_EQ(action("Propose a touch")->toolTip(), "Add a support first.");
}

TEST_F(Proposals, TheMessageAboutAFreeBodyProposesASupport) {
  openBox();
  waitForModel();
  removeSupports();
  QTRY_VERIFY_WITH_TIMEOUT(editor().rebuildStatus().state == app::RebuildStatus::State::kFailed,
                           20000);
  action("Simulate")->trigger();
  QAbstractButton* button = nullptr;
  ASSERT_TRUE(QTest::qWaitFor([&] {
    for (auto* each : window_->findChildren<QAbstractButton*>())
      if (each->isVisible() && each->text() == "Propose a support") button = each;
    return button != nullptr;
  }));
  keepPicture("proposed-support");
  QTest::mouseClick(button, Qt::LeftButton);
  ASSERT_EQ(editor().project().supports.size(), 1u);
  EXPECT_EQ(editor().project().supports[0].where, modeling::Region::ofPatches({"bottom"}));
}

}  // namespace
}  // namespace palpa::gui
