#pragma once

/// Balance of forces and moments. Collocation satisfies it only in the limit, so the defect is an
/// indicator of the error.
namespace palpa::bem::test {

struct BalanceDefect {
  int nodes;
  double force;   ///< of supports plus loads, over the force of the loads
  double moment;  ///< about the middle of the support, over force times lever arm
};

/// Sphere of radius 25 mm fixed below z = -20 mm, bump load of radius 12 mm near the top.
BalanceDefect sphereBalance(int cells);

/// Cylinder of radius 20 and height 60 mm clamped at the base, the same load on its side near the
/// top. The mesh is graded towards the edges: with uniform cells the singular stress at the clamp
/// leaves 0.8 % of the force and 1.1 % of the moment at 642 nodes, 0.45 % and 0.53 % at 2,562.
BalanceDefect cylinderBalance(int around);

}  // namespace palpa::bem::test
