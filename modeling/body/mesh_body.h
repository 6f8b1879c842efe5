#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpa::modeling {

/// Closed body bounded by flat triangles: the result of importing a file whose surface is not a set
/// of four-sided spline patches. It can be supported, loaded, meshed and touched, but has no
/// control points to move. Its faces are named like the patches of a Solid.
///
/// Invariants, checked by the constructor: positions finite; indices in range and different within
/// a triangle; every edge used once in each direction (closed, oriented, manifold); around every
/// vertex one fan; enclosed volume > 0; face names not empty and unique; every face has a triangle.
/// Several closed shells are allowed (cavities). Self-intersection is not checked here.
///
/// Immutable value; copies share their data; const access from several threads is safe.
class MeshBody {
 public:
  /// Contents of a mesh body.
  struct Data {
    std::vector<Eigen::Vector3d> positions;     ///< mm
    std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
    std::vector<int> faceOfTriangle;            ///< index into faceNames, one per triangle
    std::vector<std::string> faceNames;
  };

  /// Throws ModelingError if an invariant is violated; the message names the location:
  /// `mesh_body.triangles[12]: …`, `mesh_body: the edge between the vertices 3 and 8 near (1, 2, 0)
  /// has one triangle …`.
  explicit MeshBody(Data data);

  const std::vector<Eigen::Vector3d>& positions() const { return data_->positions; }
  const std::vector<std::array<int, 3>>& triangles() const { return data_->triangles; }
  const std::vector<int>& faceOfTriangle() const { return data_->faceOfTriangle; }
  const std::vector<std::string>& faceNames() const { return data_->faceNames; }

  /// Index of the face with this name; none if there is none.
  std::optional<int> findFace(std::string_view name) const;

 private:
  std::shared_ptr<const Data> data_;
};

/// Enclosed volume in mm³, and surface area in mm².
double volume(const MeshBody& body);
double area(const MeshBody& body);

}  // namespace palpa::modeling
