#pragma once

#include <array>

namespace palpa::gui {

/// Ends of the colours of a field, in the program's unit.
class ColourRange {
 public:
  /// How the ends follow the values.
  enum class Mode {
    kAutomatic,  ///< round numbers that enclose the values and change rarely
    kHold,       ///< as they are
    kSymmetric,  ///< as kAutomatic, about zero
    kManual,
  };

  /// Round ends for values up to `largest` > 0: from zero, or symmetric about zero.
  static std::array<double, 2> roundRange(double largest, bool isSymmetric);

  const std::array<double, 2>& ends() const { return ends_; }
  Mode mode() const { return mode_; }
  /// `manual`: first < second; only for kManual.
  void setMode(Mode mode, const std::array<double, 2>& manual);

  /// Begins with the values of another field, whose range is not known yet. Ends kHold.
  void startField();
  /// The next update() determines the ends again, as for another body.
  void restart() { ends_ = {0, 0}; }
  /// Sets the ends whatever the mode, for a field that brings its range.
  void setEnds(const std::array<double, 2>& ends) { ends_ = ends; }

  /// Largest absolute value on a section, and of another body beside this one: automatic ends
  /// enclose them, too.
  void setLargestInside(double largest) { largestInside_ = largest; }
  void setLargestBeside(double largest) { largestBeside_ = largest; }
  double largestBeside() const { return largestBeside_; }

  /// Adapts the ends to values up to `largest` (absolute, >= 0); `least` > 0 is the smallest upper
  /// end.
  void update(double largest, double least, bool isSigned);

 private:
  std::array<double, 2> ends_{0, 1};
  Mode mode_ = Mode::kAutomatic;
  std::array<double, 2> manual_{0, 1};
  double largestInside_ = 0, largestBeside_ = 0;
};

}  // namespace palpa::gui
