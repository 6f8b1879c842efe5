#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "exact_fields.h"
#include "solved_body.h"

/// The exact solutions of data/analytic.json, posed on the test meshes.
namespace palpa::bem::test {

/// One case of the file whose body exists as a test mesh.
///
/// The conditions are those that the case states, region by region. Where they leave a rigid motion
/// free, the exact displacement is prescribed on a part of the surface besides: a cap of a sphere,
/// a piece of a torus, a patch of the side of a cylinder.
class AnalyticCase {
 public:
  explicit AnalyticCase(const nlohmann::json& json);

  /// Whether the test meshes have the body.
  static bool hasBody(const nlohmann::json& json);

  /// True where the file says that any mixture of the boundary data of its field is a valid case,
  /// and states displacements everywhere.
  bool anyMixture() const;
  enum class Data {
    kAsStated,
    kMixed  ///< exact displacements on a part, exact tractions on the rest
  };

  struct Errors {
    int nodes;
    double displacement;  ///< root mean square at the nodes, over that of the exact values
    double points;     ///< largest at the sample points of the file, over the largest displacement
    double traction;   ///< rms where it was unknown, over the rms of all exact tractions
    double resultant;  ///< of reactions, over the size of the load
  };
  Errors solve(Data data) const;

  /// u from the file; stress from its derivatives and, at nu = 0.5, the file's pressure.
  ExactField exactField() const;
  /// Largest difference between the file's tractions (expressions and points) and those of
  /// exactField, over the largest traction.
  double inconsistency() const;

 private:
  struct Part {
    std::string region;
    SlotCondition condition = SlotCondition::kTraction;
    nlohmann::json data;  ///< expressions of what is given
  };
  std::pair<BoundaryMesh, std::vector<Part>> pose(Data data) const;
  BoundaryMesh makeMesh() const;
  std::vector<std::string> regions() const;  ///< by tag
  double pointError(const BoundaryMesh& mesh, const TractionSlots& slots,
                    const BoundaryField& field, double leastScale) const;
  double resultantError(const BoundaryMesh& mesh, const TractionSlots& slots,
                        const BoundaryField& field) const;
  Eigen::Vector3d value(const nlohmann::json& expressions, const Eigen::Vector3d& x,
                        const Eigen::Vector3d& n = Eigen::Vector3d::Zero()) const;

  nlohmann::json json_;
  std::string type_;
  Material material_;
  std::map<std::string, double> names_;
};

}  // namespace palpa::bem::test
