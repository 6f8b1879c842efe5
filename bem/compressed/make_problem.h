#pragma once

#include <memory>
#include <string_view>

#include "base/job.h"
#include "bem/compressed/compressed_reference_problem.h"
#include "bem/problem/discretisation.h"

namespace palpa::bem {

class QuadraticDiscretisation;

/// Assembles compressed operators of quadratic triangles and factorises them. Throws SolverError if
/// the problem cannot be solved, Cancelled on stop.
std::unique_ptr<CompressedReferenceProblem> makeCompressedReferenceProblem(
    const QuadraticDiscretisation& on, const ProblemInputs& inputs,
    const CompressionOptions& options = {}, const Job& job = {},
    ReferenceProblemTimes* times = nullptr);

}  // namespace palpa::bem
