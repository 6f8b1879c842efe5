#include <QComboBox>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QTreeWidget>

#include "app/gui/dialogs/import_dialog.h"
#include "modeling/project/project_file.h"
#include "tests/gui/window_fixture.h"

namespace palpa::gui {
namespace {

/// Files with several solids, and the unit, scale and orientation of any file.
class Importing : public WindowTest {
 protected:
  /// A block of 20 × 12 × 8 mm and a pin of radius 3 mm and height 20 mm.
  static inline const QString kTwo = PALPA_TEST_DATA "/cad/block_and_pin.step";

  static QTreeWidget& solidsOf(ImportDialog& dialog) {
    return *dialog.findChild<QTreeWidget*>("solids");
  }
  static QString labelOf(ImportDialog& dialog, const char* name) {
    return dialog.findChild<QLabel*>(name)->text();
  }
  QString messages() { return window_->messages().messages().join('\n'); }

  void expectSize(double x, double y, double z) {
    const auto [low, high] = modeling::boundingBox(editor().project().body);
    EXPECT_LT((high - low - Eigen::Vector3d(x, y, z)).norm(), 0.5) << (high - low).transpose();
  }
};

TEST_F(Importing, AFileWithSeveralSolidsAsksForOne) {
  withDialog<ImportDialog>([&] { EXPECT_TRUE(window_->openFile(kTwo)); },
                           [&](ImportDialog& dialog) {
                             QTreeWidget& solids = solidsOf(dialog);
                             ASSERT_EQ(solids.topLevelItemCount(), 2);
                             EXPECT_EQ(solids.topLevelItem(0)->text(1), "block");
                             EXPECT_EQ(solids.topLevelItem(0)->text(2), "20 × 12 × 8 mm");
                             EXPECT_EQ(solids.topLevelItem(0)->text(3), "6");
                             EXPECT_EQ(labelOf(dialog, "result"), "Size: 20 × 12 × 8 mm");
                             EXPECT_TRUE(labelOf(dialog, "problem").isEmpty());
                             QTest::qWait(50);
                             keepPicture("import-solids", &dialog);
                             EXPECT_TRUE(QTest::qWaitFor([&] { return solids.hasFocus(); }, 5000));
                             QTest::keyClick(&solids, Qt::Key_Down);
                             EXPECT_EQ(labelOf(dialog, "result"), "Size: 6 × 6 × 20 mm");
                             QTest::keyClick(&solids, Qt::Key_Return);
                           });
  EXPECT_EQ(editor().project().name, "pin");
  expectSize(6, 6, 20);
  EXPECT_EQ(window_->settings().recentFiles().value(0), kTwo);
  EXPECT_TRUE(messages().contains("Read solid 2 of 2, \"pin\".")) << messages().toStdString();
}

TEST_F(Importing, EscapeLeavesTheProjectAsItWas) {
  const std::string before = text();
  withDialog<ImportDialog>([&] { EXPECT_FALSE(window_->openFile(kTwo)); },
                           [&](ImportDialog& dialog) { QTest::keyClick(&dialog, Qt::Key_Escape); });
  withDialog<ImportDialog>([&] { EXPECT_FALSE(window_->openFile(kTwo)); },
                           [&](ImportDialog& dialog) { dialog.close(); });
  EXPECT_EQ(text(), before);
  EXPECT_TRUE(messages().isEmpty()) << messages().toStdString();
  EXPECT_TRUE(window_->settings().recentFiles().isEmpty());
}

TEST_F(Importing, AClickInThePicturePicksASolid) {
  withDialog<ImportDialog>(
      [&] { window_->openFile(kTwo); },
      [&](ImportDialog& dialog) {
        auto* preview = dialog.findChild<BodiesPreview*>("preview");
        EXPECT_TRUE(QTest::qWaitForWindowExposed(&dialog));
        const auto click = [&](const Eigen::Vector3d& place) {
          const Eigen::Vector2d pixel =
              preview->viewport().toPixel(place) / preview->devicePixelRatioF();
          QTest::mouseClick(preview, Qt::LeftButton, {},
                            {static_cast<int>(pixel.x()), static_cast<int>(pixel.y())});
        };
        click({30, 0, 20});  // the end of the pin
        EXPECT_EQ(dialog.current(), 1U);
        click({10, 6, 8});
        EXPECT_EQ(dialog.current(), 0U);
        dialog.reject();
      });
}

TEST_F(Importing, UnitScaleAndUpDirectionAreChosen) {
  const QString pipe = PALPA_TEST_DATA "/cad/quarter_pipe_inch.step";
  withDialog<QFileDialog>(
      [&] {
        withDialog<ImportDialog>(
            [&] { action("Import with options")->trigger(); },
            [&](ImportDialog& dialog) {
              EXPECT_EQ(solidsOf(dialog).topLevelItemCount(), 1);
              EXPECT_EQ(dialog.findChild<QPushButton*>("all"), nullptr);
              auto* unit = dialog.findChild<QComboBox*>("unit");
              EXPECT_EQ(unit->currentText(), "in, as in the file");
              EXPECT_EQ(labelOf(dialog, "result"), "Size: 16 × 16 × 25 mm");
              unit->setCurrentIndex(unit->findText("m"));
              EXPECT_EQ(labelOf(dialog, "result"), "Size: 629.9 × 629.9 × 984.3 mm");
              unit->setCurrentIndex(0);
              auto* scale = dialog.findChild<QLineEdit*>("scale");
              dialog.activateWindow();
              scale->setFocus();
              EXPECT_TRUE(QTest::qWaitFor([&] { return scale->hasFocus(); }, 5000));
              scale->selectAll();
              QTest::keyClicks(scale, "1000");
              QTest::keyClick(scale, Qt::Key_Tab);
              EXPECT_TRUE(
                  QTest::qWaitFor([&] { return !labelOf(dialog, "problem").isEmpty(); }, 5000));
              EXPECT_EQ(labelOf(dialog, "result"), "Size: 16,000 × 16,000 × 25,000 mm");
              EXPECT_TRUE(labelOf(dialog, "problem").contains("check the unit"));
              QTest::qWait(50);
              keepPicture("import-suspicious", &dialog);
              scale->setFocus();
              scale->selectAll();
              QTest::keyClicks(scale, "2");
              QTest::keyClick(scale, Qt::Key_Tab);
              dialog.findChild<QComboBox*>("up")->setCurrentIndex(2);  // +y
              EXPECT_EQ(labelOf(dialog, "result"), "Size: 32 × 50 × 32 mm");
              EXPECT_TRUE(labelOf(dialog, "problem").isEmpty());
              QTest::keyClick(&dialog, Qt::Key_Return);
            });
      },
      [&](QFileDialog& dialog) { chooseFile(dialog, pipe); });
  EXPECT_TRUE(editor().solid());
  EXPECT_EQ(editor().project().name, "quarter_pipe_inch");
  expectSize(32, 50, 32);
}

TEST_F(Importing, AllSolidsBecomeProjectFiles) {
  const auto importAll = [&] {
    withDialog<QFileDialog>(
        [&] {
          withDialog<ImportDialog>(
              [&] { window_->openFile(kTwo); },
              [&](ImportDialog& dialog) {
                solidsOf(dialog).setCurrentItem(solidsOf(dialog).topLevelItem(1));
                dialog.findChild<QPushButton*>("all")->click();
              });
        },
        [&](QFileDialog& dialog) { chooseFile(dialog, folder_.path()); });
  };
  importAll();
  EXPECT_EQ(editor().fileName(), folder_.filePath("pin.json"));
  EXPECT_EQ(modeling::readProject(folder_.filePath("block.json").toStdString()).name, "block");
  EXPECT_TRUE(messages().contains("2 of 2 solids were written to")) << messages().toStdString();
  // The files are there now: a question, and No leaves them.
  QFile block(folder_.filePath("block.json"));
  ASSERT_TRUE(block.remove());
  withDialog<QMessageBox>(importAll, [&](QMessageBox& question) {
    EXPECT_TRUE(question.text().startsWith("1 of the 2 project files exist already"));
    question.button(QMessageBox::No)->click();
  });
  EXPECT_FALSE(block.exists());
}

TEST_F(Importing, AMeshFileHasTheUnitThatIsChosen) {
  QFile file(folder_.filePath("tetrahedron.obj"));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("v 0 0 0\nv 0.03 0 0\nv 0 0.02 0\nv 0 0 0.01\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  file.close();
  // Without a question it is read in mm, and the note says so.
  ASSERT_TRUE(window_->openFile(file.fileName()));
  EXPECT_TRUE(messages().contains("The body is only 0.03 mm in size: check the unit"));
  withDialog<QFileDialog>(
      [&] {
        withDialog<ImportDialog>([&] { action("Import with options")->trigger(); },
                                 [&](ImportDialog& dialog) {
                                   EXPECT_EQ(solidsOf(dialog).topLevelItem(0)->text(3), "4");
                                   auto* unit = dialog.findChild<QComboBox*>("unit");
                                   EXPECT_EQ(unit->currentText(), "mm");
                                   EXPECT_FALSE(labelOf(dialog, "problem").isEmpty());
                                   unit->setFocus();
                                   unit->setCurrentIndex(unit->findText("m"));
                                   EXPECT_TRUE(labelOf(dialog, "problem").isEmpty());
                                   QTest::keyClick(unit, Qt::Key_Return);
                                 });
      },
      [&](QFileDialog& dialog) { chooseFile(dialog, file.fileName()); });
  expectSize(30, 20, 10);
}

TEST_F(Importing, TheDialogSuitsTheDarkTheme) {
  window_->settings().setTheme(Theme::kDark);
  withDialog<ImportDialog>([&] { window_->openFile(kTwo); },
                           [&](ImportDialog& dialog) {
                             QTest::qWait(50);
                             keepPicture("import-solids-dark", &dialog);
                             EXPECT_LE(dialog.width(), 1280);
                             EXPECT_LE(dialog.height(), 720);
                             dialog.reject();
                           });
  window_->settings().setTheme(Theme::kLight);
}

}  // namespace
}  // namespace palpa::gui
