#include "app/gui/simulate/sample_words.h"

#include <QStringList>
#include <cmath>

#include "base/text.h"

#include "app/gui/base/translate.h"

namespace palpa::gui {
namespace {

constexpr int kSampleDigits = 4;
constexpr int kMaxDecimals = 7;  // more are harder to read than a power of ten

/// Numbers in the chosen unit. Several have the decimals of the largest one; those far below it are
/// rounding errors.
QString numbers(std::initializer_list<double> values, Quantity quantity, const ShownUnits& units) {
  const double factor = units.of(quantity).factor;
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  const int decimals =
      largest > 0 ? kSampleDigits - 1 - static_cast<int>(std::floor(std::log10(largest / factor)))
                  : 0;
  const bool isPlain = values.size() > 1 && decimals >= 0 && decimals <= kMaxDecimals;
  const double noise =
      std::max(1e-6 * largest, isPlain ? 0.5 * factor * std::pow(10, -decimals) : 0.0);
  QStringList texts;
  for (const double value : values) {
    const double cleaned = std::abs(value) < noise ? 0 : value / factor;
    texts << (isPlain && cleaned != 0 ? QString::number(cleaned, 'f', decimals)
                                      : QString::number(cleaned, 'g', kSampleDigits));
  }
  return texts.size() == 1 ? texts.front() : "(" + texts.join(", ") + ")";
}

QString vector(const Eigen::Vector3d& value, Quantity quantity, const ShownUnits& units) {
  return numbers({value.x(), value.y(), value.z()}, quantity, units);
}

QString withUnit(const QString& name, Quantity quantity, const ShownUnits& units) {
  const QString symbol = units.of(quantity).symbol;
  return symbol.isEmpty() ? name : name + ", " + symbol;
}

}  // namespace

std::vector<SampleRow> sampleRows(const app::PointSample& sample, const ShownUnits& units) {
  using enum Quantity;
  std::vector<SampleRow> rows;
  const auto add = [&](const QString& name, Quantity quantity, const QString& value,
                       bool isBrief = false) {
    rows.push_back({withUnit(name, quantity, units), value, isBrief});
  };
  const Eigen::Matrix3d &s = sample.stress, &e = sample.strain;
  add(tr("Position at rest"), kLength, vector(sample.at, kLength, units), true);
  add(tr("Displacement"), kLength, vector(sample.displacement, kLength, units), true);
  add(tr("|u|"), kLength, numbers({sample.displacement.norm()}, kLength, units), true);
  add(tr("Traction"), kStress,
      sample.traction ? vector(*sample.traction, kStress, units) : tr("inside"),
      sample.traction.has_value());
  add(tr("von Mises stress"), kStress, numbers({sample.numbers.vonMises}, kStress, units), true);
  add(tr("Pressure"), kStress, numbers({-sample.numbers.mean}, kStress, units), true);
  add(tr("Principal stresses"), kStress, vector(sample.numbers.principal, kStress, units), true);
  for (int k = 0; k < 3; ++k)
    add(tr("Direction %1").arg(k + 1), kNumber,
        vector(sample.numbers.directions.col(k), kNumber, units));
  add(tr("Stress xx, yy, zz"), kStress, numbers({s(0, 0), s(1, 1), s(2, 2)}, kStress, units));
  add(tr("Stress xy, yz, zx"), kStress, numbers({s(0, 1), s(1, 2), s(2, 0)}, kStress, units));
  add(tr("Strain xx, yy, zz"), kNumber, numbers({e(0, 0), e(1, 1), e(2, 2)}, kNumber, units));
  add(tr("Strain xy, yz, zx"), kNumber, numbers({e(0, 1), e(1, 2), e(2, 0)}, kNumber, units));
  return rows;
}

QString plateText(const app::PointSample& sample, const ShownUnits& units) {
  QStringList lines;
  for (const SampleRow& row : sampleRows(sample, units))
    if (row.isBrief) {
      const auto comma = row.name.lastIndexOf(", ");
      lines << row.name.left(comma) + "  " + row.value + " " + row.name.mid(comma + 2);
    }
  return lines.join('\n');
}

QString sampleTable(const std::vector<app::PointSample>& samples) {
  QString table =
      "sample,x_mm,y_mm,z_mm,displacement_x_mm,displacement_y_mm,displacement_z_mm,"
      "displacement_mm,traction_x_MPa,traction_y_MPa,traction_z_MPa,"
      "stress_xx_MPa,stress_yy_MPa,stress_zz_MPa,stress_xy_MPa,stress_yz_MPa,stress_zx_MPa,"
      "strain_xx,strain_yy,strain_zz,strain_xy,strain_yz,strain_zx,"
      "principal_1_MPa,principal_2_MPa,principal_3_MPa,mean_stress_MPa,von_Mises_MPa\n";
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const app::PointSample& sample = samples[i];
    QStringList cells{QString::number(i + 1)};
    const auto add = [&](double value) { cells << QString::fromStdString(numberText(value)); };
    const auto addTensor = [&](const Eigen::Matrix3d& t) {
      for (const double value : {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(2, 0)}) add(value);
    };
    for (const double value : sample.at) add(value);
    for (const double value : sample.displacement) add(value);
    add(sample.displacement.norm());
    for (int k = 0; k < 3; ++k)
      if (sample.traction)
        add((*sample.traction)[k]);
      else
        cells << QString();
    addTensor(sample.stress);
    addTensor(sample.strain);
    for (const double value : sample.numbers.principal) add(value);
    add(sample.numbers.mean);
    add(sample.numbers.vonMises);
    table += cells.join(',') + '\n';
  }
  return table;
}

}  // namespace palpa::gui
