#include "modeling/shapes/primitives.h"

namespace palpa::modeling {

Solid makeSphere(double radius, int controlPoints) {
  return makePrimitive({SphereShape{radius}, 3, controlPoints});
}

Solid makeCylinder(double radius, double height) {
  return makePrimitive({CylinderShape{radius, height}});
}

Solid makeBox(const Eigen::Vector3d& size) {
  return makePrimitive({BoxShape{size}});
}

}  // namespace palpa::modeling
