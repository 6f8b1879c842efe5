#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "modeling/shapes/profile.h"

// Closed profiles become the four sides of a square, so that a flat cap can be filled.
namespace palpa::modeling {

/// A closed profile cut into the four sides of a square, each cut again where it has a corner or
/// the side opposite has one.
struct ProfileCuts {
  /// Profile parameters of side k from its first to its last point, ascending; they may exceed 1
  /// (one round further). Opposite sides have equally many; side k ends where side k + 1 begins.
  std::array<std::vector<double>, 4> side;
};

/// Cuts profiles that belong together (the sections of a loft, counter-clockwise) at corresponding
/// places. Every corner sharper than kSharpAngle becomes a cut. With four or more corners the
/// square's corners are chosen among them, with fewer they are completed by points at sixteenths of
/// the length; without any, four equal lengths are tried first, from the seam on. Of several
/// choices that which distorts the caps least is taken. All profiles must have equally many corners
/// or none. @throws ModelingError: they have not; or every cap would fold (beginning with `shape`)
std::vector<ProfileCuts> cutProfiles(const std::vector<Profile>& profiles,
                                     const std::string& shape);

/// The Coons patch between the four sides, in its pieces: piece (i, j), 0 ≤ s, t ≤ 1 within it.
/// Bilinear blending of opposite sides; (s, t) is right-handed for counter-clockwise profiles.
class FlatCap {
 public:
  FlatCap(const Profile& profile, const ProfileCuts& cuts);

  int pieces(int direction) const { return static_cast<int>(fractions_[direction].size()) - 1; }
  Eigen::Vector2d point(int i, int j, double s, double t) const;

  /// Smallest sine between the two families of lines over a grid of cells; not positive where the
  /// cap folds. `cells` per direction.
  double quality(int cells) const;

 private:
  Eigen::Vector2d onSide(int side, int piece, double x) const;

  Profile profile_;
  ProfileCuts cuts_;
  std::array<std::vector<double>, 2> fractions_;  // of the square's sides, where pieces meet
  std::array<Eigen::Vector2d, 4> corners_;
};

}  // namespace palpa::modeling
