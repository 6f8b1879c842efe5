#pragma once

#include <cblas.h>

#include <Eigen/Core>
#include <vector>

// Level 3 BLAS and LAPACK on matrices of single precision. Empty matrices are allowed.
namespace palpa::bem {

/// Up to as many columns are multiplied one by one: BLAS copies A to multiply it by several ones,
/// which takes two to five times as long as the products.
inline constexpr Eigen::Index kFewColumns = 4;

/// C = alpha op(A) op(B) + beta C, op: transposes or not. C is resized where beta is 0.
void multiply(bool transposeA, bool transposeB, float alpha, const Eigen::MatrixXf& A,
              const Eigen::MatrixXf& B, float beta, Eigen::MatrixXf& C);

/// Nearly normal random numbers of mean 0 and variance 1, the same on every machine.
Eigen::MatrixXf randomMatrix(Eigen::Index rows, Eigen::Index columns, unsigned seed);

/// Replaces the columns of a matrix, at most as many as rows, by an orthonormal basis.
void orthonormalise(Eigen::MatrixXf& matrix);

/// x = op(T)^-1 x, or x op(T)^-1, with the upper or lower triangle T of a square matrix;
/// `hasUnits`: with ones on its diagonal.
void solveTriangular(CBLAS_SIDE side, CBLAS_UPLO part, bool isTransposed, bool hasUnits,
                     const Eigen::MatrixXf& triangle, Eigen::MatrixXf& x);

/// Exchanges rows as LAPACK's LU factorisation with these pivots (from 1), or back.
void swapRows(const std::vector<int>& pivots, Eigen::MatrixXf& x, bool isForward);

}  // namespace palpa::bem
