#pragma once

#include <memory>

#include "base/job.h"
#include "bem/problem/discretisation.h"

namespace palpa::bem {

/// Incremental update of a dense problem to another shape of the same body: `base` was made by
/// makeDenseReferenceProblem() from `before` and the same inputs; nodes or control points of
/// `after` have moved. Integrates the rows of moved points and the contribution of moved elements
/// to the other rows; takes all else from `base`, which it keeps. Solves by GMRES, preconditioned
/// with the factors of `base`, to about 1e-6 before refinement. `times->factorise` stays 0.
///
/// Null if an update does not pay (more than three quarters of the work would remain) or is
/// impossible: kinds of discretisation, triangles, tags or groups differ, an edge between fixed
/// faces became sharp, or `base` is compressed or itself an update. The result cannot be stored:
/// write() throws std::logic_error. Throws SolverError, Cancelled.
std::unique_ptr<ReferenceProblem> updateDenseReferenceProblem(
    const std::shared_ptr<const ReferenceProblem>& base, const Discretisation& before,
    const Discretisation& after, const ProblemInputs& inputs, const Job& job = {},
    ReferenceProblemTimes* times = nullptr);

}  // namespace palpa::bem
