#include <QApplication>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTreeWidget>

#include "app/gui/dialogs/material_dialog.h"
#include "app/gui/document/own_materials.h"
#include "modeling/project/shore_hardness.h"
#include "tests/gui/window_fixture.h"

// Density, hardness and own materials.
namespace palpa::gui {
namespace {

class Materials : public WindowTest {
 protected:
  Materials() { EXPECT_TRUE(window_->openFile(kSphere)); }

  void inDialog(const std::function<void(MaterialDialog&)>& act) {
    withDialog<MaterialDialog>([&] { action("Material")->trigger(); }, act);
  }
  static void enter(MaterialDialog& dialog, const QString& field, const QString& text) {
    auto* edit = dialog.findChild<QLineEdit*>(field);
    ASSERT_TRUE(edit) << field.toStdString();
    edit->setFocus();
    edit->selectAll();
    QTest::keyClick(edit, Qt::Key_Delete);
    QTest::keyClicks(edit, text);
  }
  static QString shownIn(MaterialDialog& dialog, const QString& field) {
    return dialog.findChild<QLineEdit*>(field)->text();
  }
  static QPushButton& button(MaterialDialog& dialog, const QString& name) {
    return *dialog.findChild<QPushButton*>(name);
  }
  static QTreeWidget& list(MaterialDialog& dialog) {
    return *dialog.findChild<QTreeWidget*>("library");
  }
  static QString source(MaterialDialog& dialog) {
    return dialog.findChild<QLabel*>("source")->text();
  }
  const modeling::Material& material() { return editor().project().material; }
};

TEST_F(Materials, DensityIsTypedInAnyUnitAndMayBeUnknown) {
  const modeling::Material before = material();
  inDialog([&](MaterialDialog& dialog) {
    enter(dialog, "density", "0");
    EXPECT_FALSE(dialog.findChild<QPushButton*>("saveOwn")->isEnabled());
    enter(dialog, "density", "1.1 g/cm³");
    keepPicture("material-density", &dialog);
    QTest::keyClick(dialog.findChild<QLineEdit*>("density"), Qt::Key_Return);
  });
  ASSERT_TRUE(material().densityKgPerM3);
  EXPECT_NEAR(*material().densityKgPerM3, 1100, 1e-9);
  EXPECT_EQ(material().youngsModulus, before.youngsModulus);
  inDialog([&](MaterialDialog& dialog) {
    enter(dialog, "density", "");
    dialog.accept();
  });
  EXPECT_FALSE(material().densityKgPerM3);
  editor().undo();
  EXPECT_TRUE(material().densityKgPerM3);
  // The same in the Properties panel.
  auto* density = find<QDockWidget>("properties")->findChild<QLineEdit*>("density");
  ASSERT_TRUE(density);
  density->setFocus();
  density->selectAll();
  QTest::keyClicks(density, "950");
  QTest::keyClick(density, Qt::Key_Return);
  EXPECT_EQ(material().densityKgPerM3, 950);
  density->selectAll();
  QTest::keyClick(density, Qt::Key_Delete);
  QTest::keyClick(density, Qt::Key_Return);
  EXPECT_FALSE(material().densityKgPerM3);
}

TEST_F(Materials, ShoreHardnessGivesAnEstimateAndSaysSo) {
  const std::string before = text();
  inDialog([&](MaterialDialog& dialog) {
    enter(dialog, "hardness", "90");
    EXPECT_FALSE(source(dialog).contains("Gent"));
    enter(dialog, "hardness", "60");
    EXPECT_TRUE(source(dialog).startsWith("Estimate"));
    EXPECT_TRUE(source(dialog).contains("Gent"));
    EXPECT_EQ(shownIn(dialog, "note"), "estimated from 60 Shore A (Gent 1958)");
    EXPECT_NEAR(dialog.material().youngsModulus, modeling::youngsModulusOfShoreA(60), 1e-3);
    keepPicture("material-shore", &dialog);
    // Another modulus no longer comes from the hardness.
    enter(dialog, "modulus", "3");
    EXPECT_TRUE(shownIn(dialog, "hardness").isEmpty());
    EXPECT_FALSE(source(dialog).contains("Gent"));
    enter(dialog, "hardness", "40");
    QTest::keyClick(&dialog, Qt::Key_Escape);
  });
  EXPECT_EQ(text(), before);
}

TEST_F(Materials, OwnOnesAreSavedRenamedAndDeletedForAllProjects) {
  const std::string before = text();
  inDialog([&](MaterialDialog& dialog) {
    EXPECT_FALSE(button(dialog, "renameOwn").isEnabled());
    EXPECT_FALSE(button(dialog, "deleteOwn").isEnabled());
    enter(dialog, "name", "Structural steel");
    EXPECT_FALSE(button(dialog, "saveOwn").isEnabled()) << "a name of the library";
    enter(dialog, "name", "Lab rubber");
    enter(dialog, "modulus", "850 kPa");
    enter(dialog, "ratio", "0.49");
    enter(dialog, "density", "1130");
    enter(dialog, "note", "tension test, batch 7");
    QTest::mouseClick(&button(dialog, "saveOwn"), Qt::LeftButton);
    EXPECT_EQ(list(dialog).topLevelItem(0)->text(0), "Lab rubber");
    EXPECT_FALSE(button(dialog, "saveOwn").isEnabled()) << "nothing to save";
    EXPECT_EQ(dialog.material().youngsModulus, 0.85) << "saving keeps the fields";
    keepPicture("material-own", &dialog);
    window_->settings().setTheme(Theme::kDark);
    keepPicture("material-dark", &dialog);
    QTest::keyClick(&dialog, Qt::Key_Escape);
  });
  EXPECT_EQ(text(), before) << "saving does not change the project";
  restart();
  ASSERT_TRUE(window_->openFile(kSphere));
  inDialog([&](MaterialDialog& dialog) {
    QTreeWidget& materials = list(dialog);
    materials.setFocus();
    materials.setCurrentItem(materials.topLevelItem(0));
    EXPECT_EQ(dialog.material().youngsModulus, 0.85);
    EXPECT_EQ(dialog.material().densityKgPerM3, 1130);
    EXPECT_EQ(shownIn(dialog, "note"), "tension test, batch 7");
    // Renamed in the list by F2; Escape there keeps the dialog and the name.
    const auto rename = [&](const QString& to, Qt::Key end) {
      QTest::keyClick(&materials, Qt::Key_F2);
      auto* edit = materials.findChild<QLineEdit*>();
      ASSERT_TRUE(edit);
      edit->selectAll();
      QTest::keyClicks(edit, to);
      QTest::keyClick(edit, end);
      ASSERT_TRUE(QTest::qWaitFor([&] { return !materials.findChild<QLineEdit*>(); }));
      QTest::qWait(20);  // the list is filled after its editor was closed
    };
    rename("Nothing", Qt::Key_Escape);
    EXPECT_TRUE(dialog.isVisible());
    EXPECT_EQ(materials.topLevelItem(0)->text(0), "Lab rubber");
    rename("Liver", Qt::Key_Return);
    EXPECT_EQ(materials.topLevelItem(0)->text(0), "Lab rubber");
    EXPECT_TRUE(source(dialog).contains("already"));
    rename("Batch 7", Qt::Key_Return);
    EXPECT_EQ(materials.topLevelItem(0)->text(0), "Batch 7");
    EXPECT_EQ(shownIn(dialog, "name"), "Batch 7");
    // Other values under the same name are saved again.
    enter(dialog, "modulus", "0.9");
    QTest::mouseClick(&button(dialog, "saveOwn"), Qt::LeftButton);
    dialog.accept();
  });
  EXPECT_EQ(material().name, "Batch 7");
  EXPECT_EQ(material().youngsModulus, 0.9);
  inDialog([&](MaterialDialog& dialog) {
    EXPECT_EQ(list(dialog).currentItem()->text(0), "Batch 7");
    QApplication::setActiveWindow(&dialog);  // shortcuts need an active window
    list(dialog).setFocus();
    ASSERT_TRUE(QTest::qWaitFor([&] { return list(dialog).hasFocus(); }));
    QTest::keyClick(&list(dialog), Qt::Key_Delete);
    EXPECT_NE(list(dialog).topLevelItem(0)->text(0), "Batch 7");
    EXPECT_EQ(shownIn(dialog, "name"), "Batch 7");
    dialog.reject();
  });
  EXPECT_TRUE(OwnMaterials(window_->settings()).list().empty());
  EXPECT_EQ(material().name, "Batch 7") << "the project keeps its material";
}

TEST_F(Materials, DamagedOwnOnesAreLeftOut) {
  window_->settings().setOwnMaterials(
      R"([{"name":"a","youngs_modulus_MPa":1,"poisson_ratio":0.4},
          {"name":"b","youngs_modulus_MPa":-1,"poisson_ratio":0.4},
          {"name":"c","youngs_modulus_MPa":1},
          {"name":"a","youngs_modulus_MPa":2,"poisson_ratio":0.4},
          {"name":"d","youngs_modulus_MPa":1,"poisson_ratio":0.4,"density_kg_per_m3":"x"}, 7])");
  const OwnMaterials own(window_->settings());
  ASSERT_EQ(own.list().size(), 1u);
  EXPECT_EQ(own.list()[0].material.youngsModulus, 1);
  window_->settings().setOwnMaterials("nonsense");
  EXPECT_TRUE(OwnMaterials(window_->settings()).list().empty());
}

}  // namespace
}  // namespace palpa::gui
