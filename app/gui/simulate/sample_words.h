#pragma once

#include <QCoreApplication>
#include <QString>
#include <vector>

#include "app/core/results/point_sample.h"
#include "app/gui/base/units.h"

namespace palpa::gui {

/// A field of a sample, in words and numbers.
struct SampleRow {
  QString name;   ///< "Displacement", with its unit
  QString value;  ///< in the chosen unit, for example "(1.2, 0, -3.1)"
  bool isBrief;   ///< also on the plate under the pointer
};

/// All fields of a sample, the same rows for every sample.
std::vector<SampleRow> sampleRows(const app::PointSample& sample, const ShownUnits& units);

/// Lines for a plate in the view: the brief rows.
QString plateText(const app::PointSample& sample, const ShownUnits& units);

/// Table of samples as comma-separated values in mm and MPa.
QString sampleTable(const std::vector<app::PointSample>& samples);

}  // namespace palpa::gui
