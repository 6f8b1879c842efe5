#include "modeling/shapes/opencascade_curve.h"

#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>

namespace palpa::modeling {

Handle(Geom2d_BSplineCurve) makeCurve(const ProfileCurve& curve) {
  std::vector<double> distinct;
  std::vector<int> times;
  for (double knot : curve.knots) {
    if (distinct.empty() || knot > distinct.back()) {
      distinct.push_back(knot);
      times.push_back(0);
    }
    ++times.back();
  }
  TColgp_Array1OfPnt2d poles(1, static_cast<int>(curve.points.size()));
  for (int i = 1; i <= poles.Length(); ++i)
    poles.SetValue(i, gp_Pnt2d(curve.points[i - 1].x(), curve.points[i - 1].y()));
  TColStd_Array1OfReal knots(1, static_cast<int>(distinct.size()));
  TColStd_Array1OfInteger multiplicities(1, knots.Length());
  for (int i = 1; i <= knots.Length(); ++i) {
    knots.SetValue(i, distinct[i - 1]);
    multiplicities.SetValue(i, times[i - 1]);
  }
  return new Geom2d_BSplineCurve(poles, knots, multiplicities, curve.degree);
}

ProfileCurve toProfileCurve(const Geom2d_BSplineCurve& curve) {
  ProfileCurve result;
  result.degree = curve.Degree();
  for (int i = 1; i <= curve.NbKnots(); ++i)
    result.knots.insert(result.knots.end(), curve.Multiplicity(i), curve.Knot(i));
  for (int i = 1; i <= curve.NbPoles(); ++i)
    result.points.emplace_back(curve.Pole(i).X(), curve.Pole(i).Y());
  return result;
}

}  // namespace palpa::modeling
