#pragma once

#include <filesystem>
#include <string>

namespace palpa::render_tests {

/// How far two pictures are apart, in steps of an 8-bit channel.
struct Difference {
  bool sameSize = false;
  double largestBlock = 0;  ///< largest mean over a block of 6 × 6 pixels
  double mean = 0;          ///< over the whole picture

  bool acceptable() const;
  std::string text() const;
};

/// Compares block averages. Drivers differ in which pixels an edge or a glyph covers, by fractions
/// of a pixel along lines one or two pixels wide: an average over a block of 6 × 6 hardly sees that
/// (below 12 steps). A missing label, arrow, tick or a changed colour moves blocks by 40 and more.
/// When `differencePath` is not empty, an enlarged picture of the differences is written there.
Difference compare(const std::filesystem::path& picture, const std::filesystem::path& baseline,
                   const std::filesystem::path& differencePath);

}  // namespace palpa::render_tests
