#pragma once

namespace palpa::gui {

/// Resolution of the pictures drawn during motion: full where they are drawn in time, less where
/// the processor draws large ones. A picture at rest always has the full resolution.
class QuickResolution {
 public:
  /// Share of the device pixels in each direction, 0.5 … 1.
  double share() const { return share_; }

  /// A picture of this share took so long, ms.
  void drawn(double milliseconds);

 private:
  double share_ = 1;
  double full_ = 0;      // ms, estimate for a picture with all pixels; 0: unknown
  bool isFirst_ = true;  // of this share: buffers and texts were made for it
};

}  // namespace palpa::gui
