#include <QComboBox>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QTreeWidget>

#include "app/core/model/model_cache.h"
#include "app/gui/dialogs/material_dialog.h"
#include "app/gui/dialogs/new_solid_dialog.h"
#include "app/gui/dialogs/preferences_dialog.h"
#include "app/gui/dialogs/primitive_kinds.h"
#include "app/gui/dialogs/welcome_dialog.h"
#include "modeling/shapes/make_primitive.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

using Dialogs = WindowTest;

TEST_F(Dialogs, EveryShapeOfTheListCanBeMade) {
  for (const PrimitiveKind& kind : primitiveKinds()) {
    EXPECT_NO_THROW(modeling::makePrimitive(kind.primitive)) << kind.title.toStdString();
    for (const auto& profile : kind.profiles) {
      modeling::Primitive primitive;
      primitive.shape = profile.shape;
      EXPECT_NO_THROW(modeling::makePrimitive(primitive)) << profile.title.toStdString();
    }
  }
}

TEST_F(Dialogs, ANewSolidHasTheSizesThatWereTyped) {
  withDialog<NewSolidDialog>([&] { action("New")->trigger(); },
                             [&](NewSolidDialog& dialog) {
                               auto* list = dialog.findChild<QListWidget*>("shapes");
                               list->setCurrentRow(3);  // cylinder
                               auto* height = dialog.findChild<QLineEdit*>("the height");
                               height->selectAll();
                               QTest::keyClicks(height, "70");
                               keepPicture("new-solid", &dialog);
                               QTest::keyClick(height, Qt::Key_Return);
                             });
  const auto& cylinder = std::get<modeling::CylinderShape>(editor().project().primitive->shape);
  EXPECT_EQ(cylinder.height, 70);
}

TEST_F(Dialogs, AWrongSizeIsSaidAndCannotBeMade) {
  withDialog<NewSolidDialog>([&] { action("New")->trigger(); },
                             [&](NewSolidDialog& dialog) {
                               dialog.findChild<QListWidget*>("shapes")->setCurrentRow(6);  // torus
                               auto* minor = dialog.findChild<QLineEdit*>("the minor radius");
                               minor->selectAll();
                               QTest::keyClicks(minor, "300");
                               keepPicture("new-solid-wrong", &dialog);
                               QTest::keyClick(minor, Qt::Key_Return);
                               EXPECT_TRUE(dialog.isVisible());
                               dialog.reject();
                             });
  EXPECT_TRUE(std::holds_alternative<modeling::SphereShape>(editor().project().primitive->shape));
}

TEST_F(Dialogs, AMaterialOfTheLibraryBecomesTheProjects) {
  std::string name;
  withDialog<MaterialDialog>([&] { action("Material")->trigger(); },
                             [&](MaterialDialog& dialog) {
                               auto* list = dialog.findChild<QTreeWidget*>("library");
                               list->setCurrentItem(list->topLevelItem(2));
                               name = list->topLevelItem(2)->text(0).toStdString();
                               keepPicture("material", &dialog);
                               dialog.accept();
                             });
  EXPECT_EQ(editor().project().material.name, name);
}

TEST_F(Dialogs, CancelledPreferencesGiveTheThemeBack) {
  withDialog<PreferencesDialog>([&] { action("Preferences")->trigger(); },
                                [&](PreferencesDialog& dialog) {
                                  dialog.findChild<QComboBox*>("theme")->setCurrentIndex(1);
                                  EXPECT_EQ(window_->settings().theme(), Theme::kDark);
                                  keepPicture("preferences", &dialog);
                                  dialog.reject();
                                });
  EXPECT_EQ(window_->settings().theme(), Theme::kLight);
}

TEST_F(Dialogs, TheCacheCanBeClearedAndLimited) {
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  const app::ModelCache stored(app::defaultCacheFolder(), 0);
  ASSERT_TRUE(QTest::qWaitFor([&] { return stored.size() > 0; }, 20000));
  withDialog<PreferencesDialog>([&] { action("Preferences")->trigger(); },
                                [&](PreferencesDialog& dialog) {
                                  auto* clear = dialog.findChild<QPushButton*>("clearCache");
                                  ASSERT_TRUE(clear->isEnabled());
                                  keepPicture("preferences-cache", &dialog);
                                  clear->click();
                                  EXPECT_FALSE(clear->isEnabled());
                                  dialog.findChild<QDoubleSpinBox*>("cache")->setValue(2.5);
                                  dialog.accept();
                                });
  EXPECT_EQ(stored.size(), 0);
  EXPECT_EQ(editor().session().cache()->limit(), 2.5 * 1024 * 1024 * 1024);
}

TEST_F(Dialogs, TheWelcomeOpensAnExample) {
  withDialog<WelcomeDialog>([&] { action("Welcome")->trigger(); },
                            [&](WelcomeDialog& dialog) {
                              keepPicture("welcome", &dialog);
                              dialog.findChild<QAbstractButton*>("torus-seal")->click();
                            });
  EXPECT_TRUE(editor().fileName().isEmpty());
  EXPECT_NE(editor().project().name, "Untitled");
}

}  // namespace
}  // namespace palpa::gui
