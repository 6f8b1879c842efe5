#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QPushButton>
#include <QTableWidget>
#include <QToolButton>

#include "app/gui/dialogs/import_profile_dialog.h"
#include "app/gui/dialogs/new_solid_dialog.h"
#include "app/gui/dialogs/profile_dialog.h"
#include "modeling/shapes/make_primitive.h"
#include "modeling/shapes/outer_size.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using Eigen::Vector2d;
using PointKind = modeling::SketchPointKind;

class Profiles : public WindowTest {
 protected:
  static constexpr int kExtruded = 8, kRevolved = 7, kLofted = 9;

  /// Opens the profile editor from the dialog for new solids, lets `act` work in it and close it,
  /// and then makes the solid, or not if the editor was cancelled.
  void inEditor(int kind, const std::function<void(ProfileDialog&)>& act) {
    withDialog<NewSolidDialog>([&] { action("New")->trigger(); },
                               [&](NewSolidDialog& dialog) {
                                 dialog.findChild<QListWidget*>("shapes")->setCurrentRow(kind);
                                 auto* edit = dialog.findChild<QPushButton*>("editProfile");
                                 ASSERT_NE(edit, nullptr);
                                 withDialog<ProfileDialog>(
                                     [&] { edit->click(); },
                                     [&](ProfileDialog& profile) {
                                       // There is no window manager to do it, and shortcuts need
                                       // it.
                                       QApplication::setActiveWindow(&profile);
                                       act(profile);
                                     });
                                 keepPicture("new-solid-with-profile", &dialog);
                                 dialog.accept();
                               });
  }

  static ProfileCanvas& canvasOf(ProfileDialog& dialog) {
    return *dialog.findChild<ProfileCanvas*>("canvas");
  }
  static SketchEditor& editorOf(ProfileDialog& dialog) {
    return *dialog.findChild<SketchEditor*>();
  }
  static QPoint pixel(ProfileCanvas& canvas, const Vector2d& at) {
    return canvas.pixelOf(at).toPoint();
  }
  static void clickAt(ProfileCanvas& canvas, const Vector2d& at,
                      Qt::KeyboardModifiers modifiers = {}) {
    QTest::mouseClick(&canvas, Qt::LeftButton, modifiers, pixel(canvas, at));
  }
  static void dragFrom(ProfileCanvas& canvas, const Vector2d& from, const Vector2d& to) {
    QTest::mousePress(&canvas, Qt::LeftButton, {}, pixel(canvas, from));
    const QPoint end = pixel(canvas, to), start = pixel(canvas, from);
    for (int k = 1; k <= 4; ++k) QTest::mouseMove(&canvas, start + (end - start) * k / 4);
    QTest::mouseRelease(&canvas, Qt::LeftButton, {}, end);
  }
  static void press(ProfileDialog& dialog, const QString& button) {
    for (auto* each : dialog.findChildren<QToolButton*>())
      if (each->text() == button) {
        each->click();
        return;
      }
    FAIL() << "no button " << button.toStdString();
  }
  /// Removes the curve and draws another.
  static void draw(ProfileDialog& dialog, const std::vector<Vector2d>& clicks, bool corners) {
    ProfileCanvas& canvas = canvasOf(dialog);
    if (editorOf(dialog).sketch().pointCount() > 0) {
      editorOf(dialog).selectAll();
      QTest::keyClick(&canvas, Qt::Key_Delete);
    }
    QTest::keyClick(&canvas, Qt::Key_D);
    for (const Vector2d& at : clicks)
      clickAt(canvas, at, corners ? Qt::ShiftModifier : Qt::NoModifier);
  }
  static bool isUsable(ProfileDialog& dialog) {
    for (auto* button : dialog.findChildren<QPushButton*>())
      if (button->text() == "&Use profile") return button->isEnabled();
    return false;
  }
  static QString problemOf(ProfileDialog& dialog) {
    return dialog.findChild<QLabel*>("problem")->text();
  }
};

TEST_F(Profiles, ADrawnCurveBecomesASolid) {
  inEditor(kExtruded, [&](ProfileDialog& dialog) {
    draw(dialog, {{-20, -10}, {20, -10}, {20, 10}, {-20, 10}}, true);
    EXPECT_FALSE(isUsable(dialog));  // open, which is no error yet
    EXPECT_TRUE(problemOf(dialog).isEmpty());
    EXPECT_EQ(canvasOf(dialog).mode(), ProfileCanvas::Mode::kDraw);
    keepPicture("profile-drawing", &dialog);
    clickAt(canvasOf(dialog), {-20, -10});
    EXPECT_EQ(canvasOf(dialog).mode(), ProfileCanvas::Mode::kSelect);
    EXPECT_TRUE(editorOf(dialog).sketch().isClosed());
    EXPECT_TRUE(isUsable(dialog)) << problemOf(dialog).toStdString();
    QTest::keyClick(&canvasOf(dialog), Qt::Key_Return);
    EXPECT_TRUE(dialog.isVisible());  // Enter alone does not end it
    QTest::keyClick(&canvasOf(dialog), Qt::Key_Return, Qt::ControlModifier);
  });
  const auto& primitive = *editor().project().primitive;
  EXPECT_EQ(std::get<modeling::ExtrudeShape>(primitive.shape).profile.degree, 1);
  EXPECT_LT((modeling::outerSize(primitive) - Eigen::Vector3d(40, 20, 20)).norm(), 1e-9);
}

TEST_F(Profiles, PointsAreDraggedTypedInsertedAndDeleted) {
  inEditor(kExtruded, [&](ProfileDialog& dialog) {
    ProfileCanvas& canvas = canvasOf(dialog);
    SketchEditor& sketch = editorOf(dialog);
    draw(dialog, {{-20, -10}, {20, -10}, {20, 10}, {-20, 10}}, true);
    clickAt(canvas, {-20, -10});
    // Dragged points snap to the grid.
    dragFrom(canvas, {20, 10}, {25.2, 15.1});
    EXPECT_LT((sketch.sketch().points()[2].at - Vector2d(25, 15)).norm(), 1.01);
    const Vector2d dragged = sketch.sketch().points()[2].at;
    EXPECT_NEAR(std::remainder(dragged.x(), canvas.gridStep()), 0.0, 1e-9);
    // The field is shown and takes exact numbers; Enter leaves the dialog open.
    auto* x = dialog.findChild<QLineEdit*>("x");
    x->setFocus();
    x->selectAll();
    QTest::keyClicks(x, "31.25");
    QTest::keyClick(x, Qt::Key_Return);
    EXPECT_TRUE(dialog.isVisible());
    EXPECT_EQ(sketch.sketch().points()[2].at.x(), 31.25);
    // A double click on the curve inserts, Delete removes.
    QTest::mouseDClick(&canvas, Qt::LeftButton, {}, pixel(canvas, {0, -10}));
    EXPECT_EQ(sketch.sketch().pointCount(), 5);
    EXPECT_EQ(sketch.selection().size(), 1U);
    canvas.setFocus();
    QTest::keyClick(&canvas, Qt::Key_Delete);
    EXPECT_EQ(sketch.sketch().pointCount(), 4);
    // A corner becomes smooth by C, and is a corner again by undo.
    clickAt(canvas, {20, -10});
    ASSERT_EQ(sketch.selection(), std::vector<int>{1});
    QTest::keyClick(&canvas, Qt::Key_C);
    EXPECT_EQ(sketch.sketch().points()[1].kind, PointKind::kControl);
    EXPECT_FALSE(dialog.findChild<QCheckBox*>("corner")->isChecked());
    keepPicture("profile-smooth", &dialog);
    QTest::keyClick(&canvas, Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(sketch.sketch().points()[1].kind, PointKind::kCorner);
    QTest::keyClick(&canvas, Qt::Key_Y, Qt::ControlModifier);
    // Arrow keys move by a step of the grid.
    sketch.select({0});
    const Vector2d before = sketch.sketch().points()[0].at;
    QTest::keyClick(&canvas, Qt::Key_Left);
    EXPECT_NEAR(sketch.sketch().points()[0].at.x(), before.x() - canvas.gridStep(), 1e-9);
    QTest::keyClick(&canvas, Qt::Key_PageDown);
    EXPECT_EQ(sketch.selection(), std::vector<int>{1});
    dialog.accept();
  });
  EXPECT_TRUE(std::holds_alternative<modeling::ExtrudeShape>(editor().project().primitive->shape));
}

TEST_F(Profiles, EscapeCancelsTheDragThenTheSelectionThenAsks) {
  inEditor(kExtruded, [&](ProfileDialog& dialog) {
    ProfileCanvas& canvas = canvasOf(dialog);
    SketchEditor& sketch = editorOf(dialog);
    const modeling::ProfileSketch before = sketch.sketch();
    const Vector2d at = before.points()[2].at;
    QTest::mousePress(&canvas, Qt::LeftButton, {}, pixel(canvas, at));
    QTest::mouseMove(&canvas, pixel(canvas, at) + QPoint(40, 30));
    EXPECT_NE(sketch.sketch(), before);
    QTest::keyClick(&canvas, Qt::Key_Escape);
    EXPECT_EQ(sketch.sketch(), before);
    EXPECT_FALSE(sketch.canUndo());
    EXPECT_FALSE(sketch.canRedo());
    QTest::mouseRelease(&canvas, Qt::LeftButton, {}, pixel(canvas, at) + QPoint(40, 30));
    EXPECT_EQ(sketch.sketch(), before);
    EXPECT_FALSE(sketch.selection().empty());
    QTest::keyClick(&canvas, Qt::Key_Escape);
    EXPECT_TRUE(sketch.selection().empty());
    EXPECT_TRUE(dialog.isVisible());
    dragFrom(canvas, at, at + Vector2d(4, 0));
    sketch.select({});
    withDialog<QMessageBox>(
        [&] { QTest::keyClick(&canvas, Qt::Key_Escape); },
        [](QMessageBox& question) { question.button(QMessageBox::Cancel)->click(); });
    EXPECT_TRUE(dialog.isVisible());
    withDialog<QMessageBox>(
        [&] { dialog.close(); },
        [](QMessageBox& question) { question.button(QMessageBox::Discard)->click(); });
  });
}

TEST_F(Profiles, WrongCurvesAreMarkedWithTheMessagesOfAFile) {
  inEditor(kExtruded, [&](ProfileDialog& dialog) {
    draw(dialog, {{-20, -10}, {20, 10}, {20, -10}, {-20, 10}}, true);
    clickAt(canvasOf(dialog), {-20, -10});
    EXPECT_TRUE(problemOf(dialog).startsWith("The curve crosses or touches itself near"));
    ASSERT_TRUE(editorOf(dialog).problem()->location);
    EXPECT_FALSE(isUsable(dialog));
    keepPicture("profile-crossing", &dialog);
    editorOf(dialog).undo();
    for (int i = 0; editorOf(dialog).canUndo() && i < 20; ++i) editorOf(dialog).undo();
    EXPECT_TRUE(isUsable(dialog));
    dialog.reject();
  });
  inEditor(kRevolved, [&](ProfileDialog& dialog) {
    keepPicture("profile-revolve", &dialog);
    SketchEditor& sketch = editorOf(dialog);
    sketch.edit("Move points", [](modeling::ProfileSketch& edited) { edited.move({3}, {-80, 0}); });
    EXPECT_TRUE(problemOf(dialog).startsWith("The curve crosses the axis near"))
        << problemOf(dialog).toStdString();
    EXPECT_FALSE(isUsable(dialog));
    keepPicture("profile-axis", &dialog);
    sketch.undo();
    dialog.reject();
  });
}

TEST_F(Profiles, SectionsOfALoftHaveHeights) {
  inEditor(kLofted, [&](ProfileDialog& dialog) {
    auto* table = dialog.findChild<QTableWidget*>("sections");
    ASSERT_NE(table, nullptr);
    EXPECT_EQ(table->rowCount(), 4);
    table->setCurrentCell(3, 0);
    EXPECT_EQ(editorOf(dialog).sectionIndex(), 3);
    dialog.findChild<QPushButton*>("addSection")->click();
    EXPECT_EQ(table->rowCount(), 5);
    EXPECT_EQ(editorOf(dialog).sectionIndex(), 4);
    table->item(4, 1)->setText("110 mm");
    EXPECT_EQ(editorOf(dialog).sections()[4].z, 110.0);
    editorOf(dialog).setExtent(0, 44.0);
    keepPicture("profile-loft", &dialog);
    EXPECT_TRUE(isUsable(dialog)) << problemOf(dialog).toStdString();
    dialog.accept();
  });
  const auto& loft = std::get<modeling::LoftShape>(editor().project().primitive->shape);
  ASSERT_EQ(loft.sections.size(), 5U);
  EXPECT_EQ(loft.sections[4].z, 110.0);
}

TEST_F(Profiles, TheProfileOfTheProjectIsEditedAgain) {
  EXPECT_FALSE(action("Edit profile")->isEnabled());  // a sphere has none
  inEditor(kExtruded, [](ProfileDialog& dialog) { dialog.accept(); });
  ASSERT_TRUE(action("Edit profile")->isEnabled());
  const modeling::Primitive before = *editor().project().primitive;
  withDialog<ProfileDialog>([&] { action("Edit profile")->trigger(); },
                            [&](ProfileDialog& dialog) {
                              editorOf(dialog).setExtent(0, 64.0);
                              dialog.accept();
                            });
  EXPECT_NEAR(modeling::outerSize(*editor().project().primitive).x(), 64.0, 1e-9);
  editor().undo();
  EXPECT_EQ(*editor().project().primitive, before);
  // Nothing changed: no step.
  const QString undoable = action("Undo")->text();
  withDialog<ProfileDialog>([&] { action("Edit profile")->trigger(); },
                            [](ProfileDialog& dialog) { dialog.accept(); });
  EXPECT_EQ(action("Undo")->text(), undoable);
}

TEST_F(Profiles, DrawingsAreImported) {
  inEditor(kExtruded, [&](ProfileDialog& dialog) {
    withDialog<ImportProfileDialog>(
        [&] {
          withDialog<QFileDialog>([&] { press(dialog, "Import …"); },
                                  [&](QFileDialog& chooser) {
                                    chooseFile(chooser, PALPA_TEST_DATA "/drawings/plate.dxf");
                                  });
        },
        [&](ImportProfileDialog& import) {
          auto* paths = import.findChild<QListWidget*>("paths");
          EXPECT_EQ(paths->count(), 2);
          EXPECT_TRUE(import.findChild<QLabel*>("result")->text().contains("within"));
          keepPicture("profile-import", &import);
          paths->setCurrentRow(1);
          EXPECT_TRUE(paths->item(1)->text().startsWith("closed, 10 × 10 mm"));
          import.findChild<QComboBox*>("layer")->setCurrentText("outline");
          EXPECT_EQ(paths->count(), 1);
          import.findChild<QComboBox*>("position")->setCurrentIndex(1);
          import.accept();
        });
    const auto [low, high] = editorOf(dialog).sketch().box();
    EXPECT_LT((low + high).norm(), 1e-3);
    EXPECT_TRUE(isUsable(dialog)) << problemOf(dialog).toStdString();
    keepPicture("profile-imported", &dialog);
    dialog.accept();
  });
  const Eigen::Vector3d size = modeling::outerSize(*editor().project().primitive);
  EXPECT_LT((size - Eigen::Vector3d(60, 40, 20)).norm(), 0.02);
}

TEST_F(Profiles, TheOuterSizeIsShownAndTyped) {
  withDialog<NewSolidDialog>([&] { action("New")->trigger(); },
                             [&](NewSolidDialog& dialog) {
                               QApplication::setActiveWindow(&dialog);
                               auto* list = dialog.findChild<QListWidget*>("shapes");
                               const auto* facts = dialog.findChild<QLabel*>("facts");
                               for (int kind = 0; kind < list->count(); ++kind) {
                                 list->setCurrentRow(kind);
                                 EXPECT_TRUE(facts->text().startsWith("Outer size ")) << kind;
                               }
                               list->setCurrentRow(5);  // capsule
                               auto* row = dialog.findChild<VectorEdit*>("outerSize");
                               ASSERT_NE(row, nullptr);
                               EXPECT_EQ(row->value(), Eigen::Vector3d(20, 20, 50));
                               QuantityEdit& height = row->component(2);
                               height.setFocus();
                               height.selectAll();
                               QTest::keyClicks(&height, "60");
                               QTest::keyClick(&height, Qt::Key_Tab);
                               EXPECT_EQ(dialog.findChild<QLineEdit*>("the length")->text(),
                                         "40 mm");
                               EXPECT_EQ(row->value(), Eigen::Vector3d(20, 20, 60));
                               // Typed lengths change it, too.
                               auto* radius = dialog.findChild<QLineEdit*>("the radius");
                               radius->setFocus();
                               radius->selectAll();
                               QTest::keyClicks(radius, "8");
                               EXPECT_EQ(row->value(), Eigen::Vector3d(16, 16, 56));
                               keepPicture("new-solid-outer-size", &dialog);
                               dialog.accept();
                             });
  EXPECT_EQ(std::get<modeling::CapsuleShape>(editor().project().primitive->shape),
            (modeling::CapsuleShape{8, 40}));
}

TEST_F(Profiles, TheEditorSuitsTheDarkTheme) {
  window_->settings().setTheme(Theme::kDark);
  for (int kind : {kRevolved, kExtruded, kLofted})
    inEditor(kind, [&](ProfileDialog& dialog) {
      editorOf(dialog).select({2});
      QTest::qWait(400);
      keepPicture(QString("dark-profile-%1").arg(kind), &dialog);
      EXPECT_LT(dialog.grab().toImage().pixelColor(3, 3).lightness(), 128);
      EXPECT_LE(dialog.width(), 1280);
      EXPECT_LE(dialog.height(), 800);
      dialog.reject();
    });
}

}  // namespace
}  // namespace palpa::gui
