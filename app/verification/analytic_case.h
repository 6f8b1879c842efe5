#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/verification/exact/exact_fields.h"
#include "bem/model/bulk.h"

namespace palpa::verification {

/// One case of analytic.json: a body of a simple shape, its material, an exact field, boundary
/// conditions region by region, and sample points. Expressions and numbers are evaluated on demand:
/// every member may throw nlohmann::json::exception, or ModelingError for a wrong expression, if
/// the case does not follow resources/reference/README.md.
class AnalyticCase {
 public:
  explicit AnalyticCase(const nlohmann::json& source);

  const std::string& id() const { return id_; }
  const bem::Material& material() const { return material_; }
  /// Shape of the body: "sphere", "box", …
  const std::string& shape() const { return shape_; }
  const nlohmann::json& geometry() const { return json_.at("geometry"); }
  const nlohmann::json& source() const { return json_; }

  /// A part of the surface and the boundary condition on it.
  struct Condition {
    std::string region;  ///< or "all"
    std::string type;    ///< "displacement", "traction", or "mixed": u.n and tangential tractions
    nlohmann::json expressions;
  };
  std::vector<Condition> conditions() const;
  /// True if the file declares any mixture of the boundary data of its field a valid case, and
  /// prescribes displacements everywhere.
  bool anyMixture() const;
  /// False if displacements are prescribed everywhere on an incompressible body, which leaves its
  /// pressure undetermined.
  bool isDetermined() const;

  /// A point with an exact displacement in the file.
  struct Point {
    bool isInside;
    Eigen::Vector3d at, displacement;  ///< mm
  };
  /// At least one.
  std::vector<Point> points() const;

  /// A vector from its expressions of the coordinates and of the normal.
  Eigen::Vector3d value(const nlohmann::json& expressions, const Eigen::Vector3d& x,
                        const Eigen::Vector3d& n = Eigen::Vector3d::Zero()) const;
  /// u and the body force from the file; stress from the derivatives of u and, at nu = 0.5, the
  /// file's pressure. Refers to this object.
  ExactField exactField() const;
  /// N/mm^3; zero in files without one.
  Eigen::Vector3d bodyForce() const;
  bem::Bulk bulk() const { return {material_, bodyForce()}; }
  /// Largest contradiction within the file: between displacements of points and of expressions, and
  /// between tractions (expressions and points) and the tractions of exactField(); over the largest
  /// stress.
  double inconsistency() const;

 private:
  double evaluated(const nlohmann::json& expression,
                   const std::map<std::string, double>& names) const;

  nlohmann::json json_;
  std::string id_, shape_;
  bem::Material material_;
  std::map<std::string, double> names_;
};

Eigen::Vector3d vectorOf(const nlohmann::json& list);

}  // namespace palpa::verification
