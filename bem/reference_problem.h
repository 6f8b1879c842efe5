#pragma once
#include <memory>
#include <span>

#include "bem/assembly.h"
#include "bem/boundary_conditions.h"
#include "bem/byte_stream.h"
#include "bem/spline/spline_tractions.h"

namespace palpa::bem {

/// The mixed boundary value problem whose solution operator is computed once and then touched (the
/// seed's RBVP): A0 v + Ā0 v̄ = 0 in the degrees of freedom of `DegreesOfFreedom`. This interface
/// assumes nothing of how H, G or A0 are stored. Immutable after construction; all members may be
/// called from several threads.
class ReferenceProblem {
 public:
  virtual ~ReferenceProblem() = default;

  const DegreesOfFreedom& dofs() const { return dofs_; }

  enum class Effort { kRefined, kFast };
  /// Unknowns v (dofs().count() rows) for known fields, one column each: A0 v = G p - H u. kRefined
  /// iterates on the residual in double precision until it stops falling; kFast takes the
  /// factorisation's answer as it is.
  /// Throws Cancelled on stop.
  Eigen::MatrixXd solve(const BoundaryField& known, Effort effort = Effort::kRefined,
                        const Job& job = {}) const;

  /// G p - H u of a field, in double precision. Throws Cancelled on stop.
  virtual Eigen::MatrixXd residual(const BoundaryField& field, const Job& job = {}) const = 0;

  /// The unknowns that take away a residual G p - H u: A0 v = residual, whose rows are those of the
  /// operators, with the factorisation as it is. Throws Cancelled on stop.
  virtual Eigen::MatrixXd correction(const Eigen::MatrixXd& residual,
                                     const Job& job = {}) const = 0;

  /// The whole field: known plus unknown part.
  BoundaryField solveField(const BoundaryField& known, Effort effort = Effort::kRefined,
                           const Job& job = {}) const;

  /// Columns of Xi = -A0^-1 Ā0 for the given nodal degrees of freedom: the unknowns for a unit
  /// known value. Throws Cancelled on stop.
  Eigen::MatrixXd greensColumns(std::span<const int> columns, Effort effort = Effort::kRefined,
                                const Job& job = {}) const;

  /// max norm of G p - H u relative to that of G p, the largest of all columns: how well fields
  /// fulfil the equations.
  double relativeResidual(const BoundaryField& field, const Job& job = {}) const;
  /// Of A0 in the 1-norm; costs about as much as five columns. Throws Cancelled on stop.
  virtual double conditionEstimate(const Job& job = {}) const = 0;
  virtual std::size_t bytes() const = 0;

  /// The operators and factors bit by bit, in the byte order of this machine, for
  /// readDenseReferenceProblem().
  virtual void write(const ByteSink& sink) const = 0;

 protected:
  /// When refinement ends, unless it stops getting better: after so many rounds, or when the
  /// unknowns change by so little (relative).
  struct Refinement {
    int rounds;
    double change;
  };
  ReferenceProblem(DegreesOfFreedom dofs, Refinement refinement)
      : dofs_(std::move(dofs)), refinement_(refinement) {}
  const Refinement& refinement() const { return refinement_; }

 private:
  DegreesOfFreedom dofs_;
  Refinement refinement_;
};

/// How dense operators are stored and factorised.
enum class Precision {
  kAutomatic,  ///< double up to about 800 nodes, single beyond
  kDouble,     ///< everything in double: 24 (3n)^2 bytes
  kMixed,      ///< H and G in double, factors in single, refined: 20 (3n)^2 bytes
  kSingle      ///< everything stored in single, solved with residuals in double: 12 (3n)^2 bytes
};

/// The precision that kAutomatic stands for at a number of nodes.
Precision choosePrecision(Precision wanted, int nodeCount);

/// Memory that a dense reference problem takes, in bytes, before anything is allocated.
double estimateBytes(int nodeCount, int slotCount, Precision precision);

struct ReferenceProblemTimes {
  double assemble = 0;   ///< s
  double factorise = 0;  ///< s
};

/// Assembles and factorises a dense problem. Throws SolverError when it cannot be solved, Cancelled
/// on stop.
std::unique_ptr<ReferenceProblem> makeDenseReferenceProblem(
    const BoundaryMesh& mesh, const TractionSlots& slots,
    const std::vector<SlotCondition>& conditions, const Material& material,
    const AssemblyOptions& options, Precision precision, const Job& job,
    ReferenceProblemTimes* times = nullptr);

/// The same in the coefficients of splines; `conditions`: one per slot of `tractions`.
std::unique_ptr<ReferenceProblem> makeDenseReferenceProblem(
    const SplineSurface& surface, const SplineTractions& tractions,
    const std::vector<SlotCondition>& conditions, const Material& material,
    const AssemblyOptions& options, Precision precision, const Job& job,
    ReferenceProblemTimes* times = nullptr);

/// The problem of another shape of the same body: of `mesh`, whose nodes have moved from those of
/// `before`, that `base` was made from by makeDenseReferenceProblem() with the same conditions,
/// material and options. Rows of points that moved, and what moved elements add to the others, are
/// integrated anew; all else is taken from `base`, which is kept. Solved by GMRES with the
/// factors of `base` as the preconditioner, to about 1e-6 before refinement. `times->factorise`
/// stays 0.
///
/// Null when that does not pay (more than three quarters of the work would be left) or cannot be:
/// triangles, tags or groups differ, an edge became sharp between held faces, or `base` was itself
/// updated. It cannot be stored: write() throws std::logic_error. Throws SolverError, Cancelled.
std::unique_ptr<ReferenceProblem> updateDenseReferenceProblem(
    const std::shared_ptr<const ReferenceProblem>& base, const BoundaryMesh& before,
    const BoundaryMesh& mesh, const TractionSlots& slots,
    const std::vector<SlotCondition>& conditions, const Material& material,
    const AssemblyOptions& options, const Job& job, ReferenceProblemTimes* times = nullptr);
/// The same for splines whose control points have moved.
std::unique_ptr<ReferenceProblem> updateDenseReferenceProblem(
    const std::shared_ptr<const ReferenceProblem>& base, const SplineSurface& before,
    const SplineSurface& surface, const SplineTractions& tractions,
    const std::vector<SlotCondition>& conditions, const Material& material,
    const AssemblyOptions& options, const Job& job, ReferenceProblemTimes* times = nullptr);

/// What write() wrote of a problem made from the same geometry, slots, conditions, material
/// and precision: the caller vouches for that. Throws what the source throws, std::bad_alloc.
std::unique_ptr<ReferenceProblem> readDenseReferenceProblem(
    const BoundaryMesh& mesh, const TractionSlots& slots,
    const std::vector<SlotCondition>& conditions, const Material& material, Precision precision,
    const ByteSource& source);
std::unique_ptr<ReferenceProblem> readDenseReferenceProblem(
    const SplineSurface& surface, const SplineTractions& tractions,
    const std::vector<SlotCondition>& conditions, const Material& material, Precision precision,
    const ByteSource& source);

}  // namespace palpa::bem
