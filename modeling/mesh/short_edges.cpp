#include "modeling/mesh/short_edges.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Constrained_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "modeling/body/smooth_regions.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;
using Halfedge = Mesh::Halfedge_index;
using Edge = Mesh::Edge_index;
using Face = Mesh::Face_index;
using Lengths = Mesh::Property_map<Vertex, double>;
using Faces = Mesh::Property_map<Face, int>;
using Fixed = Mesh::Property_map<Edge, bool>;

constexpr double kStrip = 0.9;  // of the smallest length: the width of strips that are removed
const double kSharpCosine = std::cos(kSharpEdgeDegrees * std::numbers::pi / 180.0);

Vector3d toVector(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

/// A surface in work: CGAL's mesh with the smallest length of features per vertex.
class WorkSurface {
 public:
  WorkSurface(const FacedTriangles& body, const std::vector<double>& lengths,
              const std::set<int>& keptFaces)
      : lengths_(mesh_.add_property_map<Vertex, double>("v:length", 0).first),
        faces_(mesh_.add_property_map<Face, int>("f:face", -1).first),
        fixed_(mesh_.add_property_map<Edge, bool>("e:fixed", false).first) {
    for (std::size_t i = 0; i < body.positions.size(); ++i) {
      const Vector3d& p = body.positions[i];
      lengths_[mesh_.add_vertex({p.x(), p.y(), p.z()})] = lengths[i];
    }
    for (std::size_t t = 0; t < body.triangles.size(); ++t) {
      const auto vertex = [&](int k) {
        return Vertex(static_cast<Mesh::size_type>(body.triangles[t][k]));
      };
      faces_[mesh_.add_face(vertex(0), vertex(1), vertex(2))] = body.faceOfTriangle[t];
    }
    for (const Edge edge : mesh_.edges()) {
      const int one = faces_[mesh_.face(mesh_.halfedge(edge, 0))];
      const int other = faces_[mesh_.face(mesh_.halfedge(edge, 1))];
      fixed_[edge] = one != other && (keptFaces.contains(one) || keptFaces.contains(other));
    }
  }

  void simplify(const Job& job) {
    constexpr int kRounds = 4;
    for (int round = 0; round < kRounds; ++round) {
      collapse(sms::LindstromTurk_placement<Mesh>(), job);
      // Where no point keeps the volume, one of the two ends mostly is possible.
      collapse(BetterEnd{}, job);
      if (round + 1 == kRounds || !closeStrips()) return;
    }
  }

  FacedTriangles result() const {
    FacedTriangles surface;
    std::vector<int> number(mesh_.num_vertices(), -1);
    for (const Vertex vertex : mesh_.vertices()) {
      number[vertex.idx()] = static_cast<int>(surface.positions.size());
      surface.positions.push_back(toVector(mesh_.point(vertex)));
    }
    for (const Face face : mesh_.faces()) {
      const auto corners = cornersOf(mesh_.halfedge(face));
      surface.triangles.push_back(
          {number[corners[0].idx()], number[corners[1].idx()], number[corners[2].idx()]});
      surface.faceOfTriangle.push_back(faces_[face]);
    }
    return surface;
  }

 private:
  /// The end of an edge with the smaller distance from the planes of the triangles around it.
  struct BetterEnd {
    template <class Profile>
    boost::optional<Point> operator()(const Profile& profile) const {
      const auto distance = [&](const Point& to) {
        double sum = 0;
        for (const auto& [a, b, c] : profile.triangles()) {
          const auto at = [&](Vertex v) { return get(profile.vertex_point_map(), v); };
          const Kernel::Vector_3 normal = CGAL::normal(at(a), at(b), at(c));
          const double area = std::sqrt(normal.squared_length());
          if (area > 0) sum += std::pow(normal * (to - at(a)), 2) / area;
        }
        return sum;
      };
      return distance(profile.p0()) <= distance(profile.p1()) ? profile.p0() : profile.p1();
    }
  };

  /// Squared length of edges shorter than the smallest length, none for others.
  struct Cost {
    Lengths lengths;
    template <class Profile>
    boost::optional<double> operator()(const Profile& profile,
                                       const boost::optional<Point>& to) const {
      const double smallest = std::min(lengths[profile.v0()], lengths[profile.v1()]);
      const double limit = smallest * smallest;
      const double length = CGAL::squared_distance(profile.p0(), profile.p1());
      if (!to || length >= limit ||
          CGAL::squared_distance(*to, CGAL::midpoint(profile.p0(), profile.p1())) > limit)
        return boost::none;
      return length;
    }
  };

  struct Never {
    template <class Number, class Profile>
    bool operator()(const Number&, const Profile&, std::size_t, std::size_t) const {
      return false;
    }
  };

  struct Checkpoint : sms::Edge_collapse_visitor_base<Mesh> {
    const Job* job = nullptr;
    template <class Profile, class Number>
    void OnSelected(const Profile&, const Number&, std::size_t, std::size_t) {
      job->throwIfCancelled();
    }
  };

  template <class Placement>
  void collapse(const Placement& placement, const Job& job) {
    Checkpoint checkpoint;
    checkpoint.job = &job;
    const sms::Bounded_normal_change_filter<> keepsSides;
    sms::edge_collapse(
        mesh_, Never{},
        CGAL::parameters::get_cost(Cost{lengths_})
            .get_placement(sms::Constrained_placement<Placement, Fixed>(fixed_, placement))
            .filter(keepsSides)
            .edge_is_constrained_map(fixed_)
            .visitor(checkpoint));
    mesh_.collect_garbage();
  }

  std::array<Vertex, 3> cornersOf(Halfedge side) const {
    return {mesh_.source(side), mesh_.target(side), mesh_.target(mesh_.next(side))};
  }

  Vector3d normalOf(Halfedge side) const {
    const auto [a, b, c] = cornersOf(side);
    const Vector3d origin = toVector(mesh_.point(a));
    return (toVector(mesh_.point(b)) - origin)
        .cross(toVector(mesh_.point(c)) - origin)
        .normalized();
  }

  bool isSharp(Edge edge) const {
    return normalOf(mesh_.halfedge(edge, 0)).dot(normalOf(mesh_.halfedge(edge, 1))) < kSharpCosine;
  }

  /// Splits sharp edges opposite to near vertices of other sharp edges, so that the strip between
  /// them gets short edges. Returns whether there was such a strip.
  bool closeStrips() {
    std::vector<bool> isOnSharp(mesh_.num_vertices(), false);
    for (const Edge edge : mesh_.edges())
      if (isSharp(edge))
        for (const int end : {0, 1}) isOnSharp[mesh_.vertex(edge, end).idx()] = true;
    const std::vector<Face> all(mesh_.faces().begin(), mesh_.faces().end());
    bool hasSplit = false;
    for (const Face face : all) {
      Halfedge longest = mesh_.halfedge(face);
      for (const Halfedge side : mesh_.halfedges_around_face(longest))
        if (squaredLength(side) > squaredLength(longest)) longest = side;
      const Vertex tip = mesh_.target(mesh_.next(longest));
      if (tip.idx() >= isOnSharp.size() || !isOnSharp[tip.idx()] || fixed_[mesh_.edge(longest)] ||
          !isSharp(mesh_.edge(longest)))
        continue;
      const double smallest = lengths_[tip], length = std::sqrt(squaredLength(longest));
      const Vector3d a = toVector(mesh_.point(mesh_.source(longest)));
      const Vector3d along = (toVector(mesh_.point(mesh_.target(longest))) - a) / length;
      const double at = (toVector(mesh_.point(tip)) - a).dot(along);
      const Vector3d foot = a + at * along;
      if ((foot - toVector(mesh_.point(tip))).norm() > kStrip * smallest || at < smallest ||
          length - at < smallest)
        continue;
      splitAt(longest, {foot.x(), foot.y(), foot.z()}, smallest);
      hasSplit = true;
    }
    return hasSplit;
  }

  double squaredLength(Halfedge side) const {
    return CGAL::squared_distance(mesh_.point(mesh_.source(side)), mesh_.point(mesh_.target(side)));
  }

  void splitAt(Halfedge side, const Point& place, double smallest) {
    const bool isFixed = fixed_[mesh_.edge(side)];
    const int left = faces_[mesh_.face(side)];
    const int right = faces_[mesh_.face(mesh_.opposite(side))];
    const Halfedge first = CGAL::Euler::split_edge(side, mesh_);
    mesh_.point(mesh_.target(first)) = place;
    lengths_[mesh_.target(first)] = smallest;
    const Halfedge cut = CGAL::Euler::split_face(first, mesh_.next(side), mesh_);
    for (const Halfedge half : {first, side}) fixed_[mesh_.edge(half)] = isFixed;
    const Halfedge back = mesh_.opposite(first);
    const Halfedge other = CGAL::Euler::split_face(mesh_.prev(back), mesh_.next(back), mesh_);
    for (const Halfedge half : {cut, mesh_.opposite(cut)}) faces_[mesh_.face(half)] = left;
    for (const Halfedge half : {other, mesh_.opposite(other)}) faces_[mesh_.face(half)] = right;
    for (const Halfedge half : {cut, other}) fixed_[mesh_.edge(half)] = false;
  }

  Mesh mesh_;
  Lengths lengths_;
  Faces faces_;
  Fixed fixed_;
};

}  // namespace

FacedTriangles withoutShortEdges(const FacedTriangles& body, const std::vector<double>& lengths,
                                 const std::set<int>& keptFaces, const Job& job) {
  WorkSurface work(body, lengths, keptFaces);
  work.simplify(job);
  return work.result();
}

}  // namespace palpa::modeling
