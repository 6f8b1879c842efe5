#include <QComboBox>
#include <QLabel>

#include "app/gui/dialogs/transform_dialog.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

class SolidMenu : public WindowTest {
 protected:
  SolidMenu() { EXPECT_TRUE(window_->openFile(kSphere)); }
};

TEST_F(SolidMenu, SaysWhyItCannot) {
  for (const char* name : {"Elevate degree in u", "Smooth edges", "Sharp edges"}) {
    EXPECT_FALSE(action(name)->isEnabled());
    EXPECT_TRUE(action(name)->toolTip().contains("elect")) << name;
  }
  editor().select(Selection::ofPatches({0}));
  EXPECT_TRUE(action("Elevate degree in u")->isEnabled());
}

TEST_F(SolidMenu, RaisesTheDegreeOfSelectedPatchesInOneStep) {
  const std::string text0 = text();
  const int before = editor().solid()->patches()[0].degree[0];
  editor().select(Selection::ofPatches({0, 1}));
  QObject::connect(&editor(), &Editor::refused, &editor(),
                   [](const QString& message) { ADD_FAILURE() << message.toStdString(); });
  action("Elevate degree in u")->trigger();
  EXPECT_EQ(editor().solid()->patches()[0].degree[0], before + 1);
  EXPECT_EQ(editor().solid()->patches()[1].degree[0], before + 1);
  EXPECT_EQ(editor().selection(), Selection::ofPatches({0, 1}));
  for (int i = before + 1; i < 5; ++i) action("Elevate degree in u")->trigger();
  EXPECT_EQ(editor().solid()->patches()[0].degree[0], 5);
  EXPECT_FALSE(action("Elevate degree in u")->isEnabled());
  for (int i = before; i < 5; ++i) editor().undo();
  EXPECT_EQ(text(), text0);
}

TEST_F(SolidMenu, MakesEdgesSharpAndSmooth) {
  const bool smooth = editor().solid()->edges()[0].smooth;
  editor().select(Selection::ofEdges({0, 1}));
  action(smooth ? "Sharp edges" : "Smooth edges")->trigger();
  EXPECT_EQ(editor().solid()->edges()[0].smooth, !smooth);
  EXPECT_EQ(editor().solid()->edges()[1].smooth, !smooth);
  EXPECT_FALSE(action(smooth ? "Sharp edges" : "Smooth edges")->isEnabled());
  action(smooth ? "Smooth edges" : "Sharp edges")->trigger();
  EXPECT_EQ(editor().solid()->edges()[1].smooth, smooth);
}

TEST_F(SolidMenu, TransformsByNumbersAndSaysWhatIsWrong) {
  const auto before = modeling::boundingBox(editor().project().body);
  withDialog<TransformDialog>(
      [&] { action("Transform solid")->trigger(); },
      [&](TransformDialog& dialog) {
        auto* kind = dialog.findChild<QComboBox*>("transformation");
        kind->setCurrentIndex(2);
        auto* factors = dialog.findChild<VectorEdit*>("factors");
        factors->setValue({0, 1, 1});
        dialog.accept();
        EXPECT_TRUE(dialog.isVisible());
        EXPECT_FALSE(dialog.findChild<QLabel*>("problem")->text().isEmpty());
        keepPicture("transform-refused", &dialog);
        factors->setValue({2, 1, 1});
        keepPicture("transform", &dialog);
        dialog.accept();
      });
  const auto after = modeling::boundingBox(editor().project().body);
  EXPECT_NEAR(after[1].x() - after[0].x(), 2 * (before[1].x() - before[0].x()), 1e-9);
  EXPECT_NEAR(after[1].y() - after[0].y(), before[1].y() - before[0].y(), 1e-9);
}

}  // namespace
}  // namespace palpa::gui
