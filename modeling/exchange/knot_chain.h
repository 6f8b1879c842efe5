#pragma once

#include <Geom_BSplineCurve.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <functional>
#include <vector>

#include "modeling/exchange/quad_faces.h"

// Which directions of which faces must have the same degree and knots, and these knots. Internal to
// modeling/exchange/: only .cpp files include this header.
namespace palpa::modeling {

/// Degree and inner knots over [0, 1].
struct KnotSet {
  struct Knot {
    double at;
    int multiplicity;
  };
  int degree = 0;
  std::vector<Knot> inner;  ///< ascending

  /// Adds a knot, or raises the multiplicity of one that is there (within kSameKnot).
  void add(double at, int multiplicity);
  int pointCount() const;
  /// The same, run through backwards.
  KnotSet turned() const;
  /// All knots with repetitions, ends included.
  std::vector<double> flat() const;
  /// Averages of `degree` consecutive inner knots, one per control point (Greville abscissae).
  std::vector<double> sites() const;
};

inline constexpr double kSameKnot = 1e-6;  // of the range; knots in files are rounded

/// Chains of face directions that pass a knot on to each other: across an edge to the neighbour,
/// and within a face from a side to the opposite one.
class KnotChains {
 public:
  /// Degrees and knots of all B-spline faces united; the others get the knots where their surface
  /// is not smooth. @throws NoPatches
  explicit KnotChains(const QuadFaces& quads);

  /// Adds knots until interpolation of the smooth faces along their parameter lines stays within
  /// the tolerance (mm). @throws NoPatches when that takes too many
  void refine(double tolerance);

  /// Halves every span of the chains that smooth faces use.
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
