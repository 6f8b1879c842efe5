#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/core/results/comparison.h"
#include "app/report/touch_report.h"
#include "modeling/project/project.h"

// Comparison of two variants as pictures and as one HTML document.
namespace palpa::report {

/// Two variants, A and B, and the states to compare.
struct ComparedVariants {
  std::array<std::string, 2> files;
  std::array<modeling::Project, 2> projects;
  std::array<std::shared_ptr<const app::TouchModel>, 2> models;
  app::Comparison comparison;
  double share = 0, reach = 0;  ///< of app::SurfaceCorrespondence
};

/// A and B under the touches, with one camera, one scale of colours and one scale of arrows.
std::array<view::Picture, 2> comparisonPictures(const ComparedVariants& variants);

/// Pixels of each picture.
inline constexpr view::PictureSize kComparedPictureSize{1000, 900};

/// An HTML document that needs no other file, as reportDocument(): both pictures, variants,
/// touches, all rows of the comparison. `pictures`: of comparisonPictures(), as bytes of PNG files.
/// `source.file` is not used.
std::string comparisonDocument(const ComparedVariants& variants, const ReportSource& source,
                               const std::array<std::string, 2>& pictures);

}  // namespace palpa::report
