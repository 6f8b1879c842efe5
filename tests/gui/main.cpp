#include <gtest/gtest.h>

#include <QApplication>

#include "app/gui/appearance.h"
#include "app/gui/viewport_widget.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (testing::GTEST_FLAG(list_tests)) return RUN_ALL_TESTS();  // needs no display
  // Mesa would keep shaders in the cache folder, which is another one for each test.
  qputenv("MESA_SHADER_CACHE_DISABLE", "true");
  palpa::gui::setDefaultSurfaceFormat();
  QApplication application(argc, argv);
  palpa::gui::applyTheme(application, palpa::gui::Theme::kLight);
  return RUN_ALL_TESTS();
}
