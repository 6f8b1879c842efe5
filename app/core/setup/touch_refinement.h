#pragma once

#include <vector>

#include "app/core/setup/knot_chains.h"
#include "modeling/project/project.h"

namespace palpa::app {

/// Where the touches of a project are to be resolved by the functions of an analysis net.
class TouchRefinement {
 public:
  /// Places within half a touch's radius, on all patches that are near. About 1 µs per sample of a
  /// grid of 13 x 13 on each patch, and touch. All but the project must outlive it.
  TouchRefinement(const modeling::Project& project, const KnotChains& strips,
                  const modeling::SurfaceEvaluator& surface);

  /// Divides elements around the touches, always the longest in the direction in which functions
  /// are widest, until the narrowest mask (bem::SplineMaskWidths) at each
  /// place is at most `part` of what its touch asks for. `ends`: per strip where its elements end;
  /// `degrees`: per strip.
  void resolve(double part, const std::vector<int>& degrees,
               std::vector<std::vector<double>>& ends) const;

 private:
  struct Place {
    int patch;
    std::array<double, 2> parameters;
    double radius;  ///< of the widest mask there, mm
  };
  void addPlaces(const Eigen::Vector3d& at, double radius, int patchCount);
  bool divideAt(const Place& place, double radius, const std::vector<int>& degrees,
                std::vector<std::vector<double>>& ends) const;

  const KnotChains& strips_;
  const modeling::SurfaceEvaluator& surface_;
  std::vector<Place> places_;
};

}  // namespace palpa::app
