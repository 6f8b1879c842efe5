#include <gtest/gtest.h>

#include <QApplication>
#include <QStandardPaths>

#include "app/gui/appearance.h"
#include "app/gui/viewport_widget.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  palpa::gui::setDefaultSurfaceFormat();
  QApplication application(argc, argv);
  palpa::gui::applyTheme(application, palpa::gui::Theme::kLight);
  return RUN_ALL_TESTS();
}
