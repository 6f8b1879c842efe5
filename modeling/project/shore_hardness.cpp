#include "modeling/project/shore_hardness.h"

namespace palpa::modeling {

double youngsModulusOfShoreA(double hardness) {
  return 0.0981 * (56 + 7.62336 * hardness) / (0.137505 * (254 - 2.54 * hardness));
}

}  // namespace palpa::modeling
