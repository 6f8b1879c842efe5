#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/core/page/touch_places.h"

namespace palpa::app {

/// Forces at some touch places that replace a force at another point: W_k, 3 x 3 for each place, so
/// that a force f at the point acts like the forces W_k f at the places. 16-bit numbers with one
/// scale.
struct PlaceWeights {
  static constexpr std::size_t kCount = 16;
  std::array<std::uint16_t, kCount> places{};  ///< in the list of all places
  float scale = 0;
  /// Row by row for each place: the row is the direction of the force at the place.
  std::array<std::int16_t, 9 * kCount> numbers{};

  Eigen::Matrix3d at(std::size_t k) const;
};

/// The forces at the places nearest to a point (orientedDistance() with `scale`, mm) that move
/// these places as a unit force at the point does:
///   C_LL W = C_Ly,
/// with C the compliance between masks, L the nearest places, y the point. This is the Nyström
/// approximation of a symmetric kernel (Williams & Seeger, Using the Nyström method to speed up
/// kernel machines, NIPS 2000) on a local set. Its error is the compliance of the body when the
/// places of L are held, so that it ends near the places: beyond them the forces have the same
/// effect. Weights that are fitted to the geometry, such as moving least squares, err by ten times
/// as much on slender bodies, because they do not know how these bend.
///
/// `between`: C of all places, 3 N x 3 N, mm/N, symmetric; `toPoint`: displacement of the mask at
/// the point per force at each place, 3 x 3 N.
PlaceWeights placeWeights(const OrientedPoint& point, std::span<const OrientedPoint> places,
                          double scale, const Eigen::MatrixXd& between,
                          const Eigen::Ref<const Eigen::MatrixXd>& toPoint);

}  // namespace palpa::app
