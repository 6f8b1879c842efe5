#pragma once

#include <optional>

#include "bem/base/error.h"
#include "bem/compressed/make_problem.h"
#include "bem/problem/problem_inputs.h"
#include "modeling/mesh/mesh_settings.h"

namespace palpa::app {

/// A model does not fit into memory. The message names the sizes and a remedy.
class ModelTooLarge : public bem::SolverError {
 public:
  ModelTooLarge(const std::string& message, double excess)
      : SolverError(Kind::kTooLarge, message), excess_(excess) {}

  /// Memory of the model over the memory that can be used, > 1.
  double excess() const { return excess_; }

 private:
  double excess_;
};

/// Bytes that a model may take: `limit`, or if that is 0, 85 % of the memory available now; 0 if
/// unknown.
double usableMemory(double limit);

/// Bytes of a model.
double expectedBytes(const bem::ProblemSize& size, modeling::Engine engine,
                     bem::Precision precision);

/// True if an automatic precision compresses a model: from bem::kCompressedFrom nodes of quadratic
/// triangles on, and from `from` nodes on unless most of the body is thin.
bool choosesCompressed(const bem::ProblemSize& size, modeling::Engine engine,
                       std::optional<int> from);

/// How a model of these sizes is stored: as wanted, but compressed where the choice is automatic
/// and only the compressed operators fit into memory. `limit`: bytes, 0 for 85 % of the memory
/// available now.
bem::Precision fittingPrecision(const bem::ProblemSize& size, modeling::Engine engine,
                                bem::Precision wanted, double limit);

/// Throws ModelTooLarge if a model does not fit into memory; the message names the sizes
/// and a remedy. `limit`: bytes, 0 for 85 % of the memory available now.
void checkMemory(const modeling::MeshSettings& settings, modeling::Engine engine,
                 const bem::ProblemSize& size, bem::Precision precision, double limit);

}  // namespace palpa::app
