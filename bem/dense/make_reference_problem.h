#pragma once

#include <memory>

#include "base/byte_stream.h"
#include "base/job.h"
#include "bem/problem/discretisation.h"

namespace palpa::bem {

class SplineSurface;
struct SplineTractions;

/// The precision that kAutomatic stands for at a number of nodes.
Precision choosePrecision(Precision wanted, int nodeCount);

/// Memory that a dense reference problem takes, in bytes, before anything is allocated.
double estimateBytes(int nodeCount, int slotCount, Precision precision);

/// Assembles and factorises a dense problem. Throws SolverError if it cannot be solved, Cancelled
/// on stop.
std::unique_ptr<ReferenceProblem> makeDenseReferenceProblem(const Discretisation& discretisation,
                                                            const ProblemInputs& inputs,
                                                            const Job& job = {},
                                                            ReferenceProblemTimes* times = nullptr);
/// The same for linear triangles.
std::unique_ptr<ReferenceProblem> makeDenseReferenceProblem(const BoundaryMesh& mesh,
                                                            const TractionSlots& slots,
                                                            const ProblemInputs& inputs,
                                                            const Job& job = {},
                                                            ReferenceProblemTimes* times = nullptr);
/// The same in the coefficients of splines; conditions: one per slot of `tractions`.
std::unique_ptr<ReferenceProblem> makeDenseReferenceProblem(const SplineSurface& surface,
                                                            const SplineTractions& tractions,
                                                            const ProblemInputs& inputs,
                                                            const Job& job = {},
                                                            ReferenceProblemTimes* times = nullptr);

/// Reads what ReferenceProblem::write() wrote. The caller guarantees that the problem was made from
/// the same discretisation and inputs. Throws what the source throws, std::bad_alloc.
std::unique_ptr<ReferenceProblem> readDenseReferenceProblem(const Discretisation& discretisation,
                                                            const ProblemInputs& inputs,
                                                            const ByteSource& source);

}  // namespace palpa::bem
