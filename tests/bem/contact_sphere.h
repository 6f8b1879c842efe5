#pragma once

#include "app/verification/exact/simple_meshes.h"
#include "tests/bem/contact_body.h"

namespace palpa::bem::test {

inline constexpr Material kSoft{0.1, 0.45};

/// Silicone-like sphere of radius 25 mm, fixed below z = -20 mm, with all its columns.
struct ContactSphere : ContactBody {
  explicit ContactSphere(int n)
      : ContactBody(tagged(n), kSoft, [](int tag) {
          return tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction;
        }) {
    computeAll();
  }
  static BoundaryMesh tagged(int n) {
    BoundaryMesh mesh = verification::sphereMesh(25, n);
    for (int t = 0; t < mesh.triangleCount(); ++t)
      mesh.tags[t] = mesh.point(t, Eigen::Vector3d::Constant(1.0 / 3))[2] < -20 ? 1 : 0;
    return mesh;
  }
  ContactSimulation simulation() const { return {*surface, *columns, base, kSoft}; }
};

inline const ContactSphere& sphere() {
  static const ContactSphere shared(10);  // 602 nodes, edges of 3.9 mm
  return shared;
}

inline const Eigen::Vector3d kTop(0, 0, 25), kSide(25, 0, 0);

}  // namespace palpa::bem::test
