#include "modeling/solid/basis.h"

#include <BSplCLib.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <math_Matrix.hxx>
#include <stdexcept>

namespace palpa::modeling {

BasisFunctions basisAt(const std::vector<double>& knots, int degree, double parameter) {
  const TColStd_Array1OfReal flat(knots.front(), 1, static_cast<int>(knots.size()));  // a view
  math_Matrix rows(1, 2, 1, degree + 1);
  int first = 0;
  if (BSplCLib::EvalBsplineBasis(1, degree + 1, flat, parameter, first, rows) != 0)
    throw std::invalid_argument("basisAt: the parameter is outside the knots");
  BasisFunctions result;
  result.first = first - 1;
  for (int k = 0; k <= degree; ++k) {
    result.value[k] = rows(1, k + 1);
    result.derivative[k] = rows(2, k + 1);
  }
  return result;
}

double greville(const std::vector<double>& knots, int degree, int index) {
  double sum = 0.0;
  for (int k = 1; k <= degree; ++k) sum += knots[index + k];
  return sum / degree;
}

}  // namespace palpa::modeling
