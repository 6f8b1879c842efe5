#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "modeling/shapes/profile.h"

// Division of closed profiles into the four sides of a square, so that a flat cap can fill them.
namespace palpa::modeling {

/// Closed profile cut into the four sides of a square; each side is also cut where it, or the
/// opposite side, has a corner.
struct ProfileCuts {
  /// Profile parameters of side k from its first to its last point, ascending; they may exceed 1
  /// (next round). Opposite sides have equally many; side k ends where side k + 1 begins.
  std::array<std::vector<double>, 4> side;
};

/// Cuts profiles that belong together (the sections of a loft, counter-clockwise) at corresponding
/// places. Every corner sharper than kSharpAngle becomes a cut. With four or more corners the
/// square's corners are chosen among them; fewer corners are completed by points at sixteenths of
/// the length. Without corners, four equal lengths from the seam on are tried first. Of several
/// choices the one with the least distortion of the caps is used. Throws ModelingError if the
/// profiles with corners do not have equally many, or if every cap would fold (the message begins
/// with `shape`).
std::vector<ProfileCuts> cutProfiles(const std::vector<Profile>& profiles,
                                     const std::string& shape);

/// Coons patch between the four sides, in pieces: piece (i, j) with 0 ≤ s, t ≤ 1. Bilinear blending
/// of opposite sides; (s, t) is right-handed for counter-clockwise profiles.
class FlatCap {
 public:
  FlatCap(const Profile& profile, const ProfileCuts& cuts);

  int pieces(int direction) const { return static_cast<int>(fractions_[direction].size()) - 1; }
  Eigen::Vector2d point(int i, int j, double s, double t) const;

  /// Smallest sine between the two families of lines over a grid of cells; zero or negative where
  /// the cap folds. `cells` per direction. Stops at a value of at most `floor`, which is then an
  /// upper limit: enough for a search that will not choose this cap.
  double quality(int cells, double floor = -1.0) const;

 private:
  Eigen::Vector2d onSide(int side, int piece, double x) const;

  Profile profile_;
  ProfileCuts cuts_;
  std::array<std::vector<double>, 2> fractions_;  // where pieces meet, on the square's sides
  std::array<Eigen::Vector2d, 4> corners_;
};

}  // namespace palpa::modeling
