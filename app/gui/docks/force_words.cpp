#include "app/gui/docks/force_words.h"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <cmath>

#include "app/core/model/contact_kind.h"

namespace palpa::gui {
namespace {

using Status = app::TouchSnapshot::Status;

QString words(const char* text) {
  return QCoreApplication::translate("ForcesDock", text);
}

}  // namespace

QString kindText(bem::ContactTool::Kind kind) {
  return words(app::infoOf(kind).label);
}

QString statusText(Status status) {
  switch (status) {
    case Status::kWaiting:
      return words("waits for its place to be solved");
    case Status::kFixed:
      return words("on a support: no force");
    case Status::kOpen:
      return words("does not touch");
    case Status::kGrabbed:
      return words("holds");
    case Status::kSticking:
      return words("sticks");
    case Status::kSlipping:
      return words("slips");
  }
  return {};
}

QString vectorText(const Eigen::Vector3d& vector, const Unit& unit) {
  const double size = vector.norm() / unit.factor;
  const int decimals =
      size > 0 ? std::clamp(kForceDigits - 1 - static_cast<int>(std::floor(std::log10(size))), 0, 9)
               : 0;
  QStringList parts;
  for (int k = 0; k < 3; ++k) {
    const double value = vector[k] / unit.factor;
    // Avoid "-0".
    const bool isZero = std::abs(value) < 0.5 * std::pow(10.0, -decimals);
    parts << QString::number(isZero ? 0.0 : value, 'f', decimals);
  }
  return parts.join(", ") + " " + unit.symbol;
}

}  // namespace palpa::gui
