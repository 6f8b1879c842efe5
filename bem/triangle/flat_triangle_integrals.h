#pragma once

#include <xsimd/xsimd.hpp>

#include "bem/base/inverse_square_root.h"
#include "bem/base/triangle_rule.h"
#include "bem/triangle/flat_triangle.h"

/// The integrals of `BasisIntegrals` over a flat triangle with linear basis functions, for a batch
/// of collocation points at once. `Batch` is an xsimd batch of doubles, or plain double.
namespace palpa::bem {

/// Index of the product N_a N_b N_c among the ten different ones.
inline constexpr int kProductIndex[3][3][3] = {{{0, 1, 2}, {1, 3, 4}, {2, 4, 5}},
                                               {{1, 3, 4}, {3, 6, 7}, {4, 7, 8}},
                                               {{2, 4, 5}, {4, 7, 8}, {5, 8, 9}}};

/// Weights of the products N_a N_b N_c for every point of a rule; the same for all triangles of
/// area 1.
template <int Count>
struct RuleProducts {
  double weight[Count][10];

  explicit RuleProducts(const TrianglePoint* rule) : weight{} {
    for (int q = 0; q < Count; ++q)
      for (int a = 0; a < 3; ++a)
        for (int b = a; b < 3; ++b)
          for (int c = b; c < 3; ++c)
            weight[q][kProductIndex[a][b][c]] = rule[q].weight * rule[q].barycentric[a] *
                                                rule[q].barycentric[b] * rule[q].barycentric[c];
  }
};

namespace detail {

/// half_b = factor * sum_c product(a, b, c) r_c.
template <class Batch>
inline void contractProducts(const Batch (&product)[10], int a, const Batch& factor,
                             const Batch (&r)[3][3], Batch (&half)[3][3]) {
  for (int b = 0; b < 3; ++b) {
    const Batch w[3] = {factor * product[kProductIndex[a][b][0]],
                        factor * product[kProductIndex[a][b][1]],
                        factor * product[kProductIndex[a][b][2]]};
    for (int i = 0; i < 3; ++i)
      half[b][i] = xsimd::fma(w[0], r[0][i], xsimd::fma(w[1], r[1][i], w[2] * r[2][i]));
  }
}

/// sum_b r_b half_b^T, a symmetric tensor.
template <class Batch>
inline void outerSum(const Batch (&r)[3][3], const Batch (&half)[3][3], Batch (&out)[6]) {
  constexpr int kRow[6] = {0, 0, 1, 0, 1, 2}, kColumn[6] = {0, 1, 1, 2, 2, 2};
  for (int k = 0; k < 6; ++k)
    out[k] = xsimd::fma(
        r[0][kRow[k]], half[0][kColumn[k]],
        xsimd::fma(r[1][kRow[k]], half[1][kColumn[k]], r[2][kRow[k]] * half[2][kColumn[k]]));
}

/// `condition ? a : b`, lane by lane; the overload for double serves the same formulas.
inline double choose(bool condition, double a, double b) {
  return condition ? a : b;
}
template <class T, class Arch>
inline xsimd::batch<T, Arch> choose(const xsimd::batch_bool<T, Arch>& condition,
                                    const xsimd::batch<T, Arch>& a,
                                    const xsimd::batch<T, Arch>& b) {
  return xsimd::select(condition, a, b);
}

/// Rotates a symmetric tensor from the triangle's frame (11, 12, 22, 13, 23, 33) to space.
template <class Batch>
inline void rotateToSpace(const FlatTriangle& t, const Batch (&local)[6], Batch (&out)[6]) {
  const double* b[3] = {t.axis[0], t.axis[1], t.normal};
  const Batch matrix[3][3] = {{local[0], local[1], local[3]},
                              {local[1], local[2], local[4]},
                              {local[3], local[4], local[5]}};
  Batch half[3][3];
  for (int l = 0; l < 3; ++l)
    for (int j = 0; j < 3; ++j)
      half[l][j] = matrix[l][0] * b[0][j] + matrix[l][1] * b[1][j] + matrix[l][2] * b[2][j];
  constexpr int kRow[6] = {0, 0, 1, 0, 1, 2}, kColumn[6] = {0, 1, 1, 2, 2, 2};
  for (int k = 0; k < 6; ++k)
    out[k] = half[0][kColumn[k]] * b[0][kRow[k]] + half[1][kColumn[k]] * b[1][kRow[k]] +
             half[2][kColumn[k]] * b[2][kRow[k]];
}

}  // namespace detail

/// A quadrature rule placed on one triangle.
template <int Count>
struct PlacedRule {
  double point[Count][3];             ///< mm
  const double (*productWeight)[10];  ///< see RuleProducts
};

/// Quadrature for distant collocation points (see `QuadratureRange`). `corners` are
/// the 9 coordinates of the triangle's corners. With r = sum_b N_b r_b (r_b from the collocation
/// point to the corners), all integrals are combinations of ∫ N_a N_b N_c / R^3 and / R^5: twenty
/// sums that stay in registers.
template <int Count, class Batch>
inline void integrateByRule(const FlatTriangle& triangle, const double* corners,
                            const PlacedRule<Count>& rule, const Batch (&x)[3],
                            TriangleIntegrals<Batch>& out) {
  Batch third[10], fifth[10];
  for (int m = 0; m < 10; ++m) third[m] = fifth[m] = Batch(0.0);
  for (int q = 0; q < Count; ++q) {
    const Batch r0 = Batch(rule.point[q][0]) - x[0], r1 = Batch(rule.point[q][1]) - x[1],
                r2 = Batch(rule.point[q][2]) - x[2];
    const Batch inverse = inverseSquareRoot(xsimd::fma(r0, r0, xsimd::fma(r1, r1, r2 * r2)));
    const Batch inverseSquared = inverse * inverse;
    const Batch inverseCubed = inverse * inverseSquared;
    const Batch inverseFifth = inverseCubed * inverseSquared;
    for (int m = 0; m < 10; ++m) {
      const Batch weight(rule.productWeight[q][m]);
      third[m] = xsimd::fma(weight, inverseCubed, third[m]);
      fifth[m] = xsimd::fma(weight, inverseFifth, fifth[m]);
    }
  }
  Batch r[3][3];  // to corner b, component i
  for (int b = 0; b < 3; ++b)
    for (int i = 0; i < 3; ++i) r[b][i] = Batch(corners[3 * b + i]) - x[i];
  const Batch distance =
      r[0][0] * triangle.normal[0] + r[0][1] * triangle.normal[1] + r[0][2] * triangle.normal[2];
  const Batch area(triangle.area), distanceArea = distance * area;
  for (int a = 0; a < 3; ++a) {
    Batch half[3][3];  // sum_c ∫ N_a N_b N_c / R^3 r_c
    detail::contractProducts(third, a, area, r, half);
    detail::outerSum(r, half, out[a].rr3);
    for (int i = 0; i < 3; ++i) out[a].r3[i] = half[0][i] + half[1][i] + half[2][i];
    detail::contractProducts(fifth, a, distanceArea, r, half);
    detail::outerSum(r, half, out[a].rr5);
  }
}

/// Closed form, for any position of the collocation point: far, near, in the triangle's plane, and
/// (as a principal value for basis functions that do not vanish there) in the triangle itself. At a
/// corner, the integrals of that corner's own basis function have no principal value over one
/// triangle alone; the returned values are finite and must be replaced (`assemble` does so by
/// rigid-body translation).
///
/// Derivation: with ρ the in-plane part of r and z = d, every integral is reduced to edge integrals
/// by the divergence theorem in the plane (grad(1/R) = -ρ/R^3 and so on), as for the Laplace
/// kernels in Wilton et al., IEEE Trans. Antennas Propag. 32 (1984) 276-281. On an edge with unit
/// tangent t, outward in-plane normal m, p = m.ρ and R0^2 = p^2 + z^2:
///   L = ∫ ds/R,  [R],  ∫ R ds = ([sR] + R0^2 L)/2,  ∫ s^2/R ds = ([sR] - R0^2 L)/2,
///   K = ∫ ds/R^3 = [s/R]/R0^2,  ∫ s/R^3 ds = -[1/R],  ∫ s^2/R^3 ds = L - [s/R].
/// Θ = z ∫ 1/R^3 is the solid angle (Van Oosterom & Strackee, IEEE Trans. Biomed. Eng. 30 (1983)
/// 125-126).
template <class Batch>
inline void integrateClosedForm(const FlatTriangle& t, const Batch (&x)[3],
                                TriangleIntegrals<Batch>& out) {
  // Distances are at least the rounding error: at a corner, 1/R has factors that vanish there.
  const Batch tiny(1e-14 * t.radius), tinySquared(1e-28 * t.radius * t.radius);
  const Batch zero(0.0);
  const Batch q[3] = {x[0] - t.origin[0], x[1] - t.origin[1], x[2] - t.origin[2]};
  const auto along = [&q](const double(&axis)[3]) {
    return q[0] * axis[0] + q[1] * axis[1] + q[2] * axis[2];
  };
  const Batch x1 = along(t.axis[0]), x2 = along(t.axis[1]);
  // A collocation point of the triangle itself lies in its plane: rounding must not give it a solid
  // angle.
  const Batch height = -along(t.normal);
  const Batch z = detail::choose(xsimd::abs(height) < Batch(1e-12 * t.radius), zero, height);
  const Batch zz = z * z;

  Batch c[3][2], R[3];
  for (int k = 0; k < 3; ++k) {
    c[k][0] = Batch(t.corner[k][0]) - x1;
    c[k][1] = Batch(t.corner[k][1]) - x2;
    R[k] = xsimd::max(xsimd::sqrt(c[k][0] * c[k][0] + c[k][1] * c[k][1] + zz), tiny);
  }
  const auto dot = [&](int a, int b) { return c[a][0] * c[b][0] + c[a][1] * c[b][1] + zz; };
  const Batch theta =
      Batch(2.0) * xsimd::atan2(Batch(2 * t.area) * z, R[0] * R[1] * R[2] + dot(0, 1) * R[2] +
                                                           dot(0, 2) * R[1] + dot(1, 2) * R[0]);
  const Batch solidAngle = detail::choose(z == zero, zero, theta);

  // Moments: A of 1/R, B of 1/R^3, C of 3 z/R^5 (C0 with z^3, C1 with z^2).
  Batch a0 = -z * solidAngle, a1[2] = {zero, zero};
  Batch b1[2] = {zero, zero}, b2[3] = {zero, zero, zero}, b3[4] = {zero, zero, zero, zero};
  Batch c0 = solidAngle, c1[2] = {zero, zero}, c2[3] = {zero, zero, zero};
  Batch c3[4] = {zero, zero, zero, zero};
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const double t0 = t.tangent[k][0], t1 = t.tangent[k][1];
    const double m0 = t1, m1 = -t0;
    const Batch s1 = c[k][0] * t0 + c[k][1] * t1;
    const Batch s2 = s1 + t.length[k];
    const Batch p = c[k][0] * m0 + c[k][1] * m1;
    const Batch R1 = R[k], R2 = R[next];
    const Batch R0 = xsimd::max(p * p + zz, tinySquared);
    // Three forms of one logarithm, each without cancellation where it is used.
    const auto ahead = s1 >= zero, behind = s2 <= zero;
    const Batch numerator =
        detail::choose(ahead, R2 + s2, detail::choose(behind, R1 - s1, (R2 + s2) * (R1 - s1)));
    const Batch denominator = detail::choose(ahead, R1 + s1, detail::choose(behind, R2 - s2, R0));
    const Batch L = xsimd::log(numerator / denominator);
    const Batch dR = R2 - R1;
    const Batch dInverse = Batch(1.0) / R2 - Batch(1.0) / R1;
    const Batch kappa = s2 / R2 - s1 / R1;
    const Batch sR = s2 * R2 - s1 * R1;
    const Batch integralR = Batch(0.5) * (sR + R0 * L);
    const Batch integralSsOverR = Batch(0.5) * (sR - R0 * L);
    const Batch K = kappa / R0;
    const Batch pL = p * L, zK = z * K;
    const Batch pzK = p * zK, zzK = z * zK;

    a0 += pL;
    a1[0] += m0 * integralR;
    a1[1] += m1 * integralR;
    b1[0] -= m0 * L;
    b1[1] -= m1 * L;
    b2[0] -= m0 * (pL * m0 + dR * t0);
    b2[1] -= m1 * (pL * m0 + dR * t0);
    b2[2] -= m1 * (pL * m1 + dR * t1);
    // Second moments along the edge, ∫ ρρ/R and ∫ ρρ/R^3 with components 00 and 11.
    const Batch ppL = p * pL, pdR = p * dR;
    const Batch e00 = ppL * (m0 * m0) + pdR * (2 * m0 * t0) + integralSsOverR * (t0 * t0);
    const Batch e11 = ppL * (m1 * m1) + pdR * (2 * m1 * t1) + integralSsOverR * (t1 * t1);
    b3[0] -= m0 * e00;
    b3[1] -= m1 * e00;
    b3[2] -= m0 * e11;
    b3[3] -= m1 * e11;

    c0 += pzK;
    c1[0] -= m0 * zzK;
    c1[1] -= m1 * zzK;
    const Batch zdInverse = z * dInverse;
    c2[0] -= m0 * (pzK * m0 - zdInverse * t0);
    c2[1] -= m1 * (pzK * m0 - zdInverse * t0);
    c2[2] -= m1 * (pzK * m1 - zdInverse * t1);
    const Batch ppzK = p * pzK, pzdInverse = p * zdInverse, zSs = z * (L - kappa);
    const Batch f00 = ppzK * (m0 * m0) - pzdInverse * (2 * m0 * t0) + zSs * (t0 * t0);
    const Batch f11 = ppzK * (m1 * m1) - pzdInverse * (2 * m1 * t1) + zSs * (t1 * t1);
    c3[0] -= m0 * f00;
    c3[1] -= m1 * f00;
    c3[2] -= m0 * f11;
    c3[3] -= m1 * f11;
  }
  b2[0] += a0;
  b2[2] += a0;
  b3[0] += Batch(2.0) * a1[0];
  b3[3] += Batch(2.0) * a1[1];
  c2[0] += solidAngle;
  c2[2] += solidAngle;
  c3[0] += Batch(2.0) * z * b1[0];
  c3[3] += Batch(2.0) * z * b1[1];

  constexpr double kThird = 1.0 / 3.0;
  for (int a = 0; a < 3; ++a) {
    // N = N(x) + g.ρ, with N(x) the basis function at the foot of the collocation point.
    const double g0 = t.gradient[a][0], g1 = t.gradient[a][1];
    const Batch n = -(c[(a + 1) % 3][0] * g0 + c[(a + 1) % 3][1] * g1);
    const Batch v0 = n * b1[0] + b2[0] * g0 + b2[1] * g1;
    const Batch v1 = n * b1[1] + b2[1] * g0 + b2[2] * g1;
    const Batch rr3[6] = {n * b2[0] + b3[0] * g0 + b3[1] * g1,
                          n * b2[1] + b3[1] * g0 + b3[2] * g1,
                          n * b2[2] + b3[2] * g0 + b3[3] * g1,
                          z * v0,
                          z * v1,
                          z * (n * solidAngle + z * (b1[0] * g0 + b1[1] * g1))};
    detail::rotateToSpace(t, rr3, out[a].rr3);
    const Batch rr5[6] = {kThird * (n * c2[0] + c3[0] * g0 + c3[1] * g1),
                          kThird * (n * c2[1] + c3[1] * g0 + c3[2] * g1),
                          kThird * (n * c2[2] + c3[2] * g0 + c3[3] * g1),
                          kThird * (n * c1[0] + z * (c2[0] * g0 + c2[1] * g1)),
                          kThird * (n * c1[1] + z * (c2[1] * g0 + c2[2] * g1)),
                          kThird * (n * c0 + z * (c1[0] * g0 + c1[1] * g1))};
    detail::rotateToSpace(t, rr5, out[a].rr5);
    for (int i = 0; i < 3; ++i) out[a].r3[i] = v0 * t.axis[0][i] + v1 * t.axis[1][i];
  }
}

}  // namespace palpa::bem
