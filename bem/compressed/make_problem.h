#pragma once

#include <memory>

#include "base/job.h"
#include "bem/compressed/compressed_reference_problem.h"
#include "bem/problem/discretisation.h"

namespace palpa::bem {

class QuadraticDiscretisation;

/// Number of nodes of quadratic triangles from which compressed operators are chosen: from about
/// 2,000 on they are made sooner and take less memory than dense ones, but the columns of a touch
/// take longer (docs/performance.md).
inline constexpr int kCompressedFrom = 4000;
/// True if operators of so many nodes are compressed.
bool isCompressed(Precision wanted, bool isQuadratic, double nodeCount);

/// What the memory of a reference problem depends on; any finite or infinite numbers.
struct ProblemSize {
  double nodes = 0;      ///< displacement coefficients
  double slots = 0;      ///< of tractions
  double thinShare = 0;  ///< of quadratic elements, 0 … 1: see thinShare() in quadratic_assembly.h
};
ProblemSize sizeOf(const Discretisation& discretisation);

/// Tolerance of the blocks of compressed operators. Leads and soft walls amplify their errors.
double operatorTolerance(const ProblemSize& size);

/// Peak memory of making a reference problem in bytes, before anything is allocated.
double expectedBytes(const ProblemSize& size, bool isQuadratic, Precision precision);

/// Assembles and factorises a problem, compressed or dense. Throws SolverError if it cannot be
/// solved, Cancelled on stop.
std::unique_ptr<ReferenceProblem> makeReferenceProblem(const Discretisation& discretisation,
                                                       const ProblemInputs& inputs,
                                                       const Job& job = {},
                                                       ReferenceProblemTimes* times = nullptr);

/// How a problem with a wanted precision is made: kCompressed, or a dense precision.
Precision effectivePrecision(const Discretisation& discretisation, Precision wanted);

/// Reads what ReferenceProblem::write() wrote. The caller guarantees that the problem was made from
/// the same discretisation and inputs. Throws DamagedData, what the source throws, std::bad_alloc.
std::unique_ptr<ReferenceProblem> readReferenceProblem(const Discretisation& discretisation,
                                                       const ProblemInputs& inputs,
                                                       const ByteSource& source);

/// Assembles compressed operators of quadratic triangles and factorises them. `team`: whose members
/// all call this with the same arguments; see CompressedReferenceProblem. Throws SolverError if the
/// problem cannot be solved, Cancelled on stop.
std::unique_ptr<CompressedReferenceProblem> makeCompressedReferenceProblem(
    const QuadraticDiscretisation& on, const ProblemInputs& inputs,
    const CompressionOptions& options = {}, const Job& job = {},
    ReferenceProblemTimes* times = nullptr, const Team* team = nullptr);

}  // namespace palpa::bem
