#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/cli/section_options.h"
#include "app/report/state_picture.h"
#include "app/view/files/display.h"

namespace palpa::cli {

/// Options that say what a picture shows and how: colours, direction of view, section, size.
class DrawingOptions {
 public:
  void declare(CLI::App& options);

  /// Checks all that can be wrong without a model. `isReplay`: a recording is drawn; `isNode`: a
  /// single node is touched. Throws UsageError.
  report::PictureOptions read(bool isReplay, bool isNode) const;
  /// Throws UsageError.
  view::PictureSize size() const;

  /// True if a picture shows the gradient of a touch's stiffness.
  static bool needsGradient(const report::PictureOptions& options);
  /// Name of that touch; empty: the first.
  const std::string& gradientOf() const { return gradientOf_; }
  /// Radius of the fingertip of the stiffness colours, mm.
  double fingertip(const bem::BoundaryMesh& mesh) const;

 private:
  void checkGradient(const report::PictureOptions& options, bool isReplay, bool isNode) const;
  void readView(report::PictureOptions& options) const;

  report::PictureOptions options_;
  SectionOptions section_;
  std::string range_, field_ = "displacement", fingertip_, gradientOf_, view_, size_, scale_, zoom_;
  bool noGhost_ = false;
};

}  // namespace palpa::cli
