#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QPushButton>
#include <QSpinBox>
#include <QTreeWidget>

#include "app/gui/dialogs/export_dialog.h"
#include "app/gui/dialogs/keys_dialog.h"
#include "app/gui/dialogs/new_solid_dialog.h"
#include "app/gui/dialogs/picture_dialog.h"
#include "app/gui/dialogs/welcome_dialog.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

class FileDialogs : public WindowTest {
 protected:
  static void chooseRow(NewSolidDialog& dialog, const QString& title) {
    auto* list = dialog.findChild<QListWidget*>("shapes");
    const auto found = list->findItems(title, Qt::MatchExactly);
    ASSERT_EQ(found.size(), 1);
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {},
                      list->visualItemRect(found.front()).center());
  }
};

TEST_F(FileDialogs, ExportWritesTheFormatThatWasChosen) {
  ASSERT_TRUE(window_->openFile(kSphere));
  withDialog<QFileDialog>(
      [&] {
        withDialog<ExportDialog>(
            [&] { QTest::keyClick(window_.get(), Qt::Key_E, Qt::ControlModifier); },
            [&](ExportDialog& dialog) {
              auto* surface = dialog.findChild<QComboBox*>("surface");
              EXPECT_FALSE(surface->isEnabled());  // STEP has patches
              QTest::keyClicks(dialog.findChild<QComboBox*>("format"), "STL");
              EXPECT_TRUE(surface->isEnabled());
              keepPicture("export", &dialog);
              QTest::keyClick(&dialog, Qt::Key_Return);
            });
      },
      [&](QFileDialog& dialog) { chooseFile(dialog, folder_.filePath("ball.v2")); });
  EXPECT_GT(QFileInfo(folder_.filePath("ball.v2.stl")).size(), 1000);
}

TEST_F(FileDialogs, APictureKeepsTheShapeOfTheView) {
  withDialog<QFileDialog>(
      [&] {
        withDialog<PictureDialog>([&] { action("Save picture")->trigger(); },
                                  [&](PictureDialog& dialog) {
                                    auto* width = dialog.findChild<QSpinBox*>("width");
                                    width->selectAll();
                                    QTest::keyClicks(width, "400");
                                    keepPicture("picture", &dialog);
                                    QTest::keyClick(width, Qt::Key_Return);
                                  });
      },
      [&](QFileDialog& dialog) { chooseFile(dialog, folder_.filePath("view")); });
  const QImage picture(folder_.filePath("view.png"));
  EXPECT_EQ(picture.width(), 400);
  EXPECT_NEAR(picture.height(), 400.0 * view().height() / view().width(), 1);
}

TEST_F(FileDialogs, SizesOfTheShapeAreEdited) {
  withDialog<NewSolidDialog>([&] { action("Edit primitive")->trigger(); },
                             [&](NewSolidDialog& dialog) {
                               EXPECT_FALSE(dialog.findChild<QListWidget*>("shapes")->isVisible());
                               auto* radius = dialog.findChild<QLineEdit*>("the radius");
                               radius->selectAll();
                               QTest::keyClicks(radius, "12.5");
                               keepPicture("edit-primitive", &dialog);
                               QTest::keyClick(radius, Qt::Key_Return);
                             });
  EXPECT_EQ(std::get<modeling::SphereShape>(editor().project().primitive->shape).radius, 12.5);
  editor().undo();
  EXPECT_NE(std::get<modeling::SphereShape>(editor().project().primitive->shape).radius, 12.5);
}

TEST_F(FileDialogs, ProfilesComeFromFiles) {
  const auto fromFile = [&](NewSolidDialog& dialog, const QString& shape, const QString& file) {
    chooseRow(dialog, shape);
    auto* profile = dialog.findChild<QComboBox*>("profile");
    withDialog<QFileDialog>(
        [&] {
          profile->setFocus();
          QTest::keyClick(profile, Qt::Key_Home);  // from the last entry, End would do nothing
          QTest::keyClick(profile, Qt::Key_End);
        },
        [&](QFileDialog& chooser) { chooseFile(chooser, file); });
    auto* make = dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok);
    return make->isEnabled();
  };
  withDialog<NewSolidDialog>(
      [&] { action("New")->trigger(); },
      [&](NewSolidDialog& dialog) {
        EXPECT_TRUE(fromFile(dialog, "Lofted sections", PALPA_PROJECTS "/profiles/handle.json"));
        keepPicture("loft", &dialog);
        // A profile of another kind is refused with a message.
        EXPECT_FALSE(fromFile(dialog, "Extruded profile", PALPA_PROJECTS "/profiles/handle.json"));
        EXPECT_FALSE(dialog.findChild<QLabel*>("problem")->text().isEmpty());
        EXPECT_TRUE(fromFile(dialog, "Extruded profile", PALPA_PROJECTS "/profiles/sole.json"));
        EXPECT_TRUE(fromFile(dialog, "Revolved profile", PALPA_PROJECTS "/profiles/vase.json"));
        keepPicture("revolve", &dialog);
        dialog.accept();
      });
  EXPECT_TRUE(std::holds_alternative<modeling::RevolveShape>(editor().project().primitive->shape));
}

TEST_F(FileDialogs, HelpSaysWhatThereIs) {
  withDialog<KeysDialog>(
      [&] { QTest::keyClick(window_.get(), Qt::Key_F1, Qt::ControlModifier); },
      [&](KeysDialog& dialog) {
        auto* table = dialog.findChild<QTreeWidget*>("table");
        EXPECT_FALSE(table->findItems("Save", Qt::MatchExactly | Qt::MatchRecursive).isEmpty());
        EXPECT_FALSE(table->findItems("Zoom at the pointer", Qt::MatchExactly | Qt::MatchRecursive)
                         .isEmpty());
        keepPicture("keys", &dialog);
        QTest::keyClick(&dialog, Qt::Key_Escape);
      });
  withDialog<QMessageBox>([&] { action("About Palpa")->trigger(); },
                          [&](QMessageBox& about) {
                            EXPECT_TRUE(about.text().contains("GPL"));
                            keepPicture("about", &about);
                            QTest::keyClick(&about, Qt::Key_Escape);
                          });
}

TEST_F(FileDialogs, AllOfThemSuitTheDarkTheme) {
  window_->settings().setTheme(Theme::kDark);
  const auto look = [&](auto type, const QString& name) {
    using Dialog = typename decltype(type)::type;
    withDialog<Dialog>([&] { action(name)->trigger(); },
                       [&](Dialog& dialog) {
                         keepPicture("dark-" + name.toLower().replace(' ', '-'), &dialog);
                         // No part kept a light background.
                         EXPECT_LT(dialog.grab().toImage().pixelColor(3, 3).lightness(), 128);
                         dialog.reject();
                       });
  };
  look(std::type_identity<NewSolidDialog>(), "New");
  look(std::type_identity<ExportDialog>(), "Export");
  look(std::type_identity<PictureDialog>(), "Save picture");
  look(std::type_identity<KeysDialog>(), "Keyboard and mouse");
  look(std::type_identity<WelcomeDialog>(), "Welcome");
}

}  // namespace
}  // namespace palpa::gui
