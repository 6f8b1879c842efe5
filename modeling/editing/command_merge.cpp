#include "modeling/editing/command.h"
#include "modeling/editing/command_file.h"

namespace palpa::modeling {
namespace {

bool sameFrame(const Reach& a, const Reach& b) {
  if (a.falloff != b.falloff || a.mirror.has_value() != b.mirror.has_value()) return false;
  return !a.mirror || (a.mirror->point == b.mirror->point && a.mirror->normal == b.mirror->normal);
}

template <class Motion>
bool sameTarget(const Motion& a, const Motion& b) {
  return sameFrame(a.reach, b.reach) && toJson(a.points) == toJson(b.points);
}

bool merge(MovePoints& earlier, const MovePoints& later) {
  if (!sameTarget(earlier, later)) return false;
  if (auto* from = std::get_if<MoveBy>(&earlier.how))
    if (const auto* by = std::get_if<MoveBy>(&later.how)) {
      from->vector += by->vector;
      return true;
    }
  if (auto* from = std::get_if<MoveAlongNormal>(&earlier.how))
    if (const auto* by = std::get_if<MoveAlongNormal>(&later.how)) {
      from->distance += by->distance;
      return true;
    }
  if (std::holds_alternative<MoveTo>(earlier.how) && std::holds_alternative<MoveTo>(later.how)) {
    earlier.how = later.how;
    return true;
  }
  return false;
}

/// An omitted centre is the mean of the points, which does not change by scaling or rotation.
bool merge(ScalePoints& earlier, const ScalePoints& later) {
  if (!sameTarget(earlier, later) || earlier.center != later.center) return false;
  earlier.factors = earlier.factors.cwiseProduct(later.factors);
  return true;
}

bool merge(RotatePoints& earlier, const RotatePoints& later) {
  if (!sameTarget(earlier, later) || earlier.center != later.center || earlier.axis != later.axis)
    return false;
  earlier.angleDegrees += later.angleDegrees;
  return true;
}

bool merge(TransformSolid& earlier, const TransformSolid& later) {
  auto* translation = std::get_if<Translation>(&earlier.how);
  const auto* by = std::get_if<Translation>(&later.how);
  if (translation && by) {
    translation->vector += by->vector;
    return true;
  }
  auto* rotation = std::get_if<Rotation>(&earlier.how);
  const auto* turn = std::get_if<Rotation>(&later.how);
  if (rotation && turn && rotation->axis == turn->axis && rotation->center == turn->center) {
    rotation->angleDegrees += turn->angleDegrees;
    return true;
  }
  auto* scaling = std::get_if<Scaling>(&earlier.how);
  const auto* factors = std::get_if<Scaling>(&later.how);
  if (scaling && factors && scaling->center == factors->center) {
    scaling->factors = scaling->factors.cwiseProduct(factors->factors);
    return true;
  }
  return false;
}

// Settings that a slider changes: the last value replaces the previous ones.
bool merge(MakePrimitive& earlier, const MakePrimitive& later) {
  if (earlier.primitive.shape.index() != later.primitive.shape.index()) return false;
  earlier = later;
  return true;
}

bool merge(SetMaterial& earlier, const SetMaterial& later) {
  earlier = later;
  return true;
}

bool merge(SetMesh& earlier, const SetMesh& later) {
  earlier = later;
  return true;
}

template <class Other>
bool merge(Other&, const Other&) {
  return false;
}

}  // namespace

bool mergeInto(Command& earlier, const Command& later) {
  return std::visit(
      [&](auto& first) {
        const auto* second = std::get_if<std::decay_t<decltype(first)>>(&later);
        return second && merge(first, *second);
      },
      earlier);
}

}  // namespace palpa::modeling
