#include <QAbstractButton>
#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QRegularExpression>
#include <QStatusBar>
#include <QToolBar>
#include <QToolButton>
#include <cmath>
#include <map>

#include "app/gui/base/appearance.h"
#include "app/gui/base/measures.h"
#include "app/gui/docks/forces_dock.h"
#include "app/gui/widgets/vector_edit.h"
#include "tests/gui/window_fixture.h"

// The first minutes of a user: menus, keys, tool bar, readable texts.
namespace palpa::gui {
namespace {

class FirstMinutes : public WindowTest {
 protected:
  /// Contrast of two colours after WCAG 2: 1 … 21.
  static double contrast(const QColor& a, const QColor& b) {
    const auto luminance = [](const QColor& colour) {
      const auto linear = [](double c) {
        return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
      };
      return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) +
             0.0722 * linear(colour.blueF());
    };
    const double la = luminance(a), lb = luminance(b);
    return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
  }
};

TEST_F(FirstMinutes, NoKeyMeansTwoThings) {
  for (const char* mode : {"Model", "Simulate"}) {
    action(mode)->trigger();
    std::map<QString, QString> owners;
    for (const QAction* each : window_->findChildren<QAction*>()) {
      if (!each->isVisible() || each->text().isEmpty()) continue;
      for (const QKeySequence& keys : each->shortcuts()) {
        const QString name = keys.toString();
        EXPECT_FALSE(owners.contains(name) && owners[name] != each->objectName())
            << mode << ": " << name.toStdString() << " is " << owners[name].toStdString() << " and "
            << each->objectName().toStdString();
        owners[name] = each->objectName();
      }
    }
    EXPECT_GT(owners.size(), 30u);
  }
}

TEST_F(FirstMinutes, WordsAreThoseOfOtherPrograms) {
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  action("Simulate")->trigger();
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->simulation().drawn() != nullptr; }, 20000));
  QStringList texts;
  const auto add = [&texts](QString text) { texts << text.remove('&'); };
  for (const QMenu* menu : window_->findChildren<QMenu*>()) add(menu->title());
  for (const QAction* each : window_->findChildren<QAction*>()) add(each->text());
  for (const auto* button : window_->findChildren<QAbstractButton*>()) add(button->text());
  for (const auto* label : window_->findChildren<QLabel*>()) add(label->text());
  for (const auto* box : window_->findChildren<QComboBox*>())
    for (int k = 0; k < box->count(); ++k) add(box->itemText(k));
  for (const char* wanted : {"Release all", "Orbit left", "Orbit and zoom", "Stiffness"})
    EXPECT_TRUE(texts.contains(wanted)) << wanted;
  // What the first versions said instead.
  const QRegularExpression former("^Make\\b|^Turn\\b|\\blet go\\b|\\bwish|under a fingertip|×10\\^",
                                  QRegularExpression::CaseInsensitiveOption);
  EXPECT_EQ(texts.filter(former).join(" | ").toStdString(), "");
  // With the shapes of "New …", too.
  withDialog<QDialog>([&] { action("New")->trigger(); },
                      [](QDialog& dialog) {
                        QStringList buttons;
                        for (const auto* button : dialog.findChildren<QAbstractButton*>())
                          buttons << button->text().remove('&');
                        EXPECT_TRUE(buttons.contains("Create")) << buttons.join(", ").toStdString();
                        dialog.reject();
                      });
}

TEST_F(FirstMinutes, OpenByTheirLettersWhateverThePanelsShow) {
  ASSERT_TRUE(window_->openFile(kSphere));
  const auto openAll = [&] {
    for (QAction* each : window_->menuBar()->actions()) {
      const QString title = each->text();
      const QChar letter = title[title.indexOf('&') + 1].toUpper();
      QTest::keyClick(window_.get(), static_cast<Qt::Key>(letter.unicode()), Qt::AltModifier);
      EXPECT_TRUE(QTest::qWaitFor([&] { return each->menu()->isVisible(); }, 1000))
          << title.toStdString();
      each->menu()->close();
      QTest::keyClick(window_->menuBar(), Qt::Key_Escape);
      view().setFocus();
    }
  };
  openAll();  // the project's numbers
  editor().select(Selection::ofPoints({0}));
  openAll();
  editor().select(Selection::of(Selection::Kind::kSupport, "base"));
  action("Paint support")->trigger();
  openAll();
}

TEST_F(FirstMinutes, TheSwitchOfTheModesIsSeenInNarrowWindows) {
  window_->resize(700, 500);
  QTest::qWait(50);
  auto* bar = find<QToolBar>("main");
  for (const char* mode : {"Model", "Simulate"}) {
    const QWidget* button = bar->widgetForAction(action(mode));
    EXPECT_TRUE(button->isVisible()) << mode;
  }
  EXPECT_LE(window_->width(), window_->screen()->availableSize().width());
}

TEST_F(FirstMinutes, WordsCanBeReadInBothThemes) {
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    window_->settings().setTheme(theme);
    const QPalette palette = QApplication::palette();
    for (const auto role : {QPalette::Text, QPalette::PlaceholderText})
      for (const auto ground : {QPalette::Window, QPalette::Base})
        EXPECT_GE(contrast(palette.color(role), palette.color(ground)), 4.5) << role << ground;
    // The colour of refusals comes from the style sheet.
    QLabel refusal("no", window_.get());
    refusal.setObjectName("refusal");
    refusal.ensurePolished();
    const QColor red = refusal.palette().color(QPalette::WindowText);
    EXPECT_NE(red, palette.color(QPalette::WindowText));
    EXPECT_GE(contrast(red, palette.color(QPalette::Window)), 4.5);
  }
}

TEST_F(FirstMinutes, ACheckedItemWithAPictureIsMarked) {
  // The drawn row of a checked item differs from the same row unchecked.
  QMenu* menu = nullptr;
  for (QAction* each : window_->menuBar()->actions())
    if (each->text().contains("View")) menu = each->menu();
  ASSERT_TRUE(menu);
  const auto picture = [&] {
    menu->ensurePolished();
    menu->resize(menu->sizeHint());
    const QRect row = menu->actionGeometry(action("Grid"));
    return menu->grab(QRect(row.left(), row.top(), row.height() + 16, row.height())).toImage();
  };
  ASSERT_TRUE(action("Grid")->isChecked());
  const QImage on = picture();
  action("Grid")->setChecked(false);
  EXPECT_NE(on, picture());
}

TEST_F(FirstMinutes, CoordinatesFitIntoTheirFields) {
  ASSERT_TRUE(window_->openFile(kSphere));
  editor().select(Selection::ofPoints({67}));
  QTest::qWait(100);
  auto* position = find<VectorEdit>("position");
  ASSERT_TRUE(position);
  const double exact = editor().solid()->controlPoints()[67].x();
  QuantityEdit& x = position->component(0);
  EXPECT_LT(x.fontMetrics().horizontalAdvance(x.text()), x.width() - 8) << x.text().toStdString();
  EXPECT_EQ(x.value(), exact);
  // With focus the field shows all digits; focus alone changes no value.
  x.setFocus();
  EXPECT_NEAR(parsed(x.text(), Quantity::kLength, {}).value(), exact, 1e-7);
  view().setFocus();
  EXPECT_EQ(x.value(), exact);
  EXPECT_FALSE(editor().session().isModified());
}

TEST_F(FirstMinutes, MeasuresFollowTheUnits) {
  EXPECT_EQ(shownVolume(1e6, {}), "1,000,000 mm³");
  EXPECT_EQ(shownArea(7854.1816, {}), "7,854.2 mm²");
  EXPECT_EQ(shownArea(0.25, {}), "0.25 mm²");
  ShownUnits centimetres;
  centimetres.chosen[static_cast<std::size_t>(Quantity::kLength)] = 1;
  EXPECT_EQ(shownVolume(65452.3, centimetres), "65.452 cm³");
  EXPECT_EQ(shownVolume(0, centimetres), "0 cm³");
}

TEST_F(FirstMinutes, AModelThatCannotBeBuiltSaysWhyOverTheView) {
  ASSERT_TRUE(window_->openFile(kSphere));
  waitForModel();
  // Two supports on the same patch that contradict each other.
  modeling::Support second = editor().project().supports.front();
  second.name = "second";
  second.displacement.z() += 1;
  ASSERT_TRUE(editor().perform(modeling::AddSupport{second}));
  const auto isSaid = [&] {
    const QStringList messages = window_->messages().messages();
    return std::any_of(messages.begin(), messages.end(),
                       [](const QString& each) { return each.contains("overlap"); });
  };
  EXPECT_TRUE(QTest::qWaitFor(isSaid, 20000));
  keepPicture("cannot-be-built");
  // The message disappears with its reason.
  editor().undo();
  waitForModel();
  EXPECT_TRUE(QTest::qWaitFor([&] { return !isSaid(); }, 5000));
}

TEST_F(FirstMinutes, SavingIsSaid) {
  ASSERT_TRUE(window_->openFile(kSphere));
  ASSERT_TRUE(editor().saveAs(folder_.filePath("kept.json")));
  EXPECT_TRUE(window_->statusBar()->currentMessage().contains("kept.json"));
}

TEST_F(FirstMinutes, TheCopyOfBeforeTheLastSaveCanBeOpened) {
  ASSERT_TRUE(window_->openFile(kSphere));
  const QString file = folder_.filePath("ball.json");
  ASSERT_TRUE(editor().saveAs(file));
  const std::string before = text();
  ASSERT_TRUE(editor().perform(modeling::RenameProject{"other"}));
  ASSERT_TRUE(editor().save());
  ASSERT_TRUE(window_->openFile(file + ".bak"));
  EXPECT_EQ(text(), before);
  // The project has no file: saving must not overwrite the copy.
  EXPECT_TRUE(editor().fileName().isEmpty());
}

TEST_F(FirstMinutes, EscapeClosesMessages) {
  window_->messages().showError("something");
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_TRUE(window_->messages().messages().isEmpty());
}

}  // namespace
}  // namespace palpa::gui
