#include "app/core/setup/support_conflict.h"

#include <utility>

#include "base/text.h"

namespace palpa::app {
namespace {

std::string messageOf(const SupportConflict& conflict) {
  const std::string names = "supports \"" + conflict.first + "\" and \"" + conflict.second + "\" ";
  const std::string place = placeText(conflict.at);
  return conflict.overlaps
             ? names + "overlap near " + place +
                   " and prescribe different displacements there; give the overlap to one of them "
                   "or make their displacements agree"
             : names + "meet at " + place +
                   " and prescribe different displacements there; separate them or make them "
                   "agree";
}

}  // namespace

SupportConflictError::SupportConflictError(SupportConflict conflict)
    : SolverError(Kind::kBadCondition, messageOf(conflict)), conflict_(std::move(conflict)) {}

modeling::TakeOverlap resolution(const SupportConflict& conflict, bool firstKeeps,
                                 const modeling::Project& project) {
  // Meshes cannot resolve gaps below a quarter of an edge length.
  constexpr double kGap = 0.5;  // of the edge length
  return {firstKeeps ? conflict.first : conflict.second,
          firstKeeps ? conflict.second : conflict.first, kGap * project.mesh.edgeLength};
}

}  // namespace palpa::app
