#include "app/gui/widgets/curve_swatch.h"

#include <QPixmap>

#include "app/view/charts/force_plot.h"

namespace palpa::gui {

QIcon curveSwatch(int curve) {
  const auto [red, green, blue] = view::ForcePlot::colour(curve);
  QPixmap square(kCurveSwatch, kCurveSwatch);
  square.fill(QColor(red, green, blue));
  return square;
}

}  // namespace palpa::gui
