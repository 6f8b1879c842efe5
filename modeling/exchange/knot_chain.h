#pragma once

#include <Geom_BSplineCurve.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <functional>
#include <vector>

#include "modeling/exchange/quad_faces.h"

// Common degrees and knots of the directions of faces. Internal to modeling/exchange/: only .cpp
// files include this header.
namespace palpa::modeling {

/// Degree and inner knots over [0, 1].
struct KnotSet {
  struct Knot {
    double at;
    int multiplicity;
  };
  int degree = 0;
  std::vector<Knot> inner;  ///< ascending

  /// Adds a knot, or raises the multiplicity of an existing knot (within kSameKnot).
  void add(double at, int multiplicity);
  /// Number of control points.
  int pointCount() const;
  /// The same knots for the opposite direction.
  KnotSet turned() const;
  /// All knots with repetitions, including the ends.
  std::vector<double> flat() const;
  /// Averages of `degree` consecutive inner knots, one per control point (Greville abscissae).
  std::vector<double> sites() const;
};

inline constexpr double kSameKnot = 1e-6;  // of the range; knots in files are rounded

/// Chains of face directions that must have the same knots: neighbours across an edge, and opposite
/// sides of a face.
class KnotChains {
 public:
  /// Chains with the union of the degrees and knots of all B-spline faces, and of the knots of the
  /// other surfaces where these are not smooth. `quads` must outlive the object.
  /// Throws NoPatches if the faces cannot have common knots.
  explicit KnotChains(const QuadFaces& quads);

  /// Adds knots until interpolation of the smooth faces along their parameter lines is within the
  /// tolerance (mm). Throws NoPatches if this needs too many knots.
  void refine(double tolerance);

  /// Halves every span of the chains of smooth faces.
  void halve();

  KnotSet of(int face, int direction) const;

 private:
  struct Place {
    int chain;
    bool turned;
  };

  void join(const QuadFaces& quads);
  void addSplineKnots(int face, int direction);
  void addBreaks(int face, int direction);
  bool refineOnce(double tolerance);

  const std::vector<QuadFace>& faces_;
  std::vector<Place> places_;  // per face and direction
  std::vector<KnotSet> chains_;
};

}  // namespace palpa::modeling
