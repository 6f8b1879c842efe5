#pragma once

#include <filesystem>
#include <string>

namespace palpa::render_tests {

/// Difference of two pictures, in steps of an 8-bit channel.
struct Difference {
  bool sameSize = false;
  double largestBlock = 0;  ///< largest mean over a block of 6 × 6 pixels
  double mean = 0;          ///< over the whole picture

  bool acceptable() const;
  std::string text() const;
};

/// Compares block averages. Drivers differ in which pixels an edge or a glyph covers, by fractions
/// of a pixel along lines one or two pixels wide: this hardly changes an average over a block of
/// 6 × 6 (below 12 steps). A missing label, arrow, tick or a changed colour moves blocks by 40 and
/// more. Writes an amplified picture of the differences to `differencePath` unless it is empty.
Difference compare(const std::filesystem::path& picture, const std::filesystem::path& baseline,
                   const std::filesystem::path& differencePath);

}  // namespace palpa::render_tests
