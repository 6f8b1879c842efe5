#pragma once

#include <vector>

#include "app/core/setup/knot_chains.h"
#include "modeling/project/project.h"

namespace palpa::app {

/// Places around a project's touches that the functions of an analysis net must resolve.
class TouchRefinement {
 public:
  /// Collects places within half the radius of each touch, on all patches nearby. About 1 µs per
  /// sample; each patch has 13 x 13 samples per touch. `chains` and `surface` must outlive it.
  TouchRefinement(const modeling::Project& project, const KnotChains& chains,
                  const modeling::SurfaceEvaluator& surface);

  /// Divides elements around the touches, always the longest in the direction with the widest
  /// functions, until the narrowest mask (bem::SplineMaskWidths) at each place is at most `part` of
  /// the radius that its touch asks for. `ends`: per chain, where its elements end; `degrees`: per
  /// chain.
  void resolve(double part, const std::vector<int>& degrees,
               std::vector<std::vector<double>>& ends) const;

 private:
  struct Place {
    int patch;
    std::array<double, 2> parameters;
    double radius;  ///< of the widest mask allowed there, mm
  };
  void addPlaces(const Eigen::Vector3d& at, double radius, int patchCount);
  bool divideAt(const Place& place, double radius, const std::vector<int>& degrees,
                std::vector<std::vector<double>>& ends) const;

  const KnotChains& chains_;
  const modeling::SurfaceEvaluator& surface_;
  std::vector<Place> places_;
};

}  // namespace palpa::app
