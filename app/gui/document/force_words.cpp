#include "app/gui/document/force_words.h"

#include <QStringList>
#include <algorithm>
#include <cmath>

#include "app/core/model/contact_kind.h"
#include "app/gui/base/translate.h"
#include "base/number_with_error.h"

namespace palpa::gui {
namespace {

using Status = app::TouchSnapshot::Status;

constexpr double kVectorNoise = 1e-9;  // N, N mm: shorter vectors are rounding errors

}  // namespace

QString kindText(bem::ContactTool::Kind kind) {
  return tr(app::infoOf(kind).label);
}

QString statusText(Status status) {
  switch (status) {
    case Status::kWaiting:
      return tr("waits for its place to be solved");
    case Status::kFixed:
      return tr("on a support: no force");
    case Status::kOpen:
      return tr("does not touch");
    case Status::kGrabbed:
      return tr("holds");
    case Status::kSticking:
      return tr("sticks");
    case Status::kSlipping:
      return tr("slips");
  }
  return {};
}

QString vectorText(const Eigen::Vector3d& vector, const Unit& unit, double error) {
  const double size = vector.norm() < kVectorNoise ? 0 : vector.norm() / unit.factor;
  const int digits =
      error > 0 ? std::min(kForceDigits, digitsFor(size, error * size)) : kForceDigits;
  const int decimals =
      size > 0 ? std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(size))), 0, 9) : 0;
  QStringList parts;
  for (int k = 0; k < 3; ++k) {
    const double value = vector[k] / unit.factor;
    // Avoid "-0".
    const bool isZero = std::abs(value) < 0.5 * std::pow(10.0, -decimals);
    parts << QString::number(isZero ? 0.0 : value, 'f', decimals);
  }
  return parts.join(", ") + " " + unit.symbol;
}

QString forceWithError(double force, const Unit& unit, double error) {
  if (!(error > 0) || force < kVectorNoise) {
    const double value = force < kVectorNoise ? 0 : force / unit.factor;
    return QString::number(value, 'g', kForceDigits) + " " + unit.symbol;
  }
  const double value = force / unit.factor;
  // An error of less than the last digit that is shown is not stated.
  const int most = decimalsFor(value, value * std::pow(10.0, -kForceDigits));
  const int decimals = decimalsFor(value, error * value);
  if (decimals > most) return QString::fromStdString(withDecimals(value, most)) + " " + unit.symbol;
  // Above that an estimate says only that the number is of no use.
  if (error > 1)
    return QString::fromStdString(withDecimals(value, decimals)) + " " + unit.symbol +
           " ± more than 100 %";
  return QString::fromStdString(withDecimals(value, decimals) + " ± " +
                                errorText(error * value, decimals)) +
         " " + unit.symbol;
}

}  // namespace palpa::gui
