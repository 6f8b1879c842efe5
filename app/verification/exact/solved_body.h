#pragma once

#include <functional>
#include <memory>

#include "app/verification/exact/exact_fields.h"
#include "bem/problem/reference_problem.h"

namespace palpa::verification {

using ConditionOfTag = std::function<bem::SlotCondition(int tag)>;

/// Sets the tag of every triangle whose centroid is `inside` to `tag`.
bem::BoundaryMesh retagged(bem::BoundaryMesh mesh, int tag,
                           const std::function<bool(const Eigen::Vector3d&)>& inside);

/// Indices of all triangles, or of the triangles with a tag.
std::vector<int> allTriangles(const bem::BoundaryMesh& mesh);
std::vector<int> trianglesWithTag(const bem::BoundaryMesh& mesh, int tag);

/// A body with boundary data of an exact field, and its numerical solution. Displacements are
/// prescribed at the nodes; tractions are the L2 projection of stress times the normal
/// of the mesh.
struct SolvedBody {
  bem::BoundaryMesh mesh;
  bem::TractionSlots slots;
  bem::Material material;
  std::vector<bem::SlotCondition> conditions;
  bem::ReferenceProblemTimes times;
  std::unique_ptr<bem::ReferenceProblem> problem;
  bem::BoundaryField field;

  struct Options {
    bem::Precision precision = bem::Precision::kDouble;
    bem::AssemblyOptions assembly = {};
    Job job = {};
  };
  SolvedBody(bem::BoundaryMesh bodyMesh, const bem::Material& bodyMaterial, const ExactField& exact,
             const ConditionOfTag& conditionOfTag, const Options& options);
  SolvedBody(bem::BoundaryMesh bodyMesh, const bem::Material& bodyMaterial, const ExactField& exact,
             const ConditionOfTag& conditionOfTag)
      : SolvedBody(std::move(bodyMesh), bodyMaterial, exact, conditionOfTag, Options{}) {}

  /// sqrt(∫ |u - exact|^2 / ∫ |exact|^2) over the mesh.
  double displacementError(const ExactField& exact) const;
  /// Largest error of a nodal displacement, over the largest exact value.
  double maxDisplacementError(const ExactField& exact) const;
  /// Root mean square of the errors of the nodal displacements, over the rms of the exact values.
  double rmsDisplacementError(const ExactField& exact) const;
  /// Largest error of a traction, over the largest exact value. The exact traction uses the
  /// slot's mean normal, so on curved faces it is exact only to the order of the mesh.
  double maxTractionError(const ExactField& exact) const;
};

/// log2-like order between two meshes: the exponent of n^(-order/2) in the number of nodes.
double observedOrder(double coarseError, int coarseNodes, double fineError, int fineNodes);

}  // namespace palpa::verification
