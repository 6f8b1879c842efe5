#include "modeling/solid/opencascade_surface.h"

#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <algorithm>

namespace palpa::modeling {

std::vector<double> distinct(const std::vector<double>& knots) {
  std::vector<double> result = knots;
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

Handle(Geom_BSplineSurface)
    makeSurface(const std::vector<Eigen::Vector3d>& points, const Patch& patch) {
  const int rows = static_cast<int>(patch.net.size());
  const int columns = static_cast<int>(patch.net.front().size());
  TColgp_Array2OfPnt poles(1, rows, 1, columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const Eigen::Vector3d& p = points[patch.net[i][j]];
      poles.SetValue(i + 1, j + 1, gp_Pnt(p.x(), p.y(), p.z()));
    }
  const auto split = [&](int direction) {
    const std::vector<double> values = distinct(patch.knots[direction]);
    const int count = static_cast<int>(values.size());
    TColStd_Array1OfReal knots(1, count);
    TColStd_Array1OfInteger multiplicities(1, count);
    for (int i = 0; i < count; ++i) {
      const auto& all = patch.knots[direction];
      knots.SetValue(i + 1, values[i]);
      multiplicities.SetValue(i + 1,
                              static_cast<int>(std::count(all.begin(), all.end(), values[i])));
    }
    return std::pair(knots, multiplicities);
  };
  const auto [uKnots, uMultiplicities] = split(0);
  const auto [vKnots, vMultiplicities] = split(1);
  return new Geom_BSplineSurface(poles, uKnots, vKnots, uMultiplicities, vMultiplicities,
                                 patch.degree[0], patch.degree[1]);
}

std::vector<std::vector<Eigen::Vector3d>> polesOf(const Geom_BSplineSurface& surface) {
  std::vector<std::vector<Eigen::Vector3d>> net(surface.NbUPoles(),
                                                std::vector<Eigen::Vector3d>(surface.NbVPoles()));
  for (int i = 0; i < surface.NbUPoles(); ++i)
    for (int j = 0; j < surface.NbVPoles(); ++j) {
      const gp_Pnt& p = surface.Pole(i + 1, j + 1);
      net[i][j] = {p.X(), p.Y(), p.Z()};
    }
  return net;
}

}  // namespace palpa::modeling
