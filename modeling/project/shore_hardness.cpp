#include "modeling/project/shore_hardness.h"

#include "base/round_number.h"

namespace palpa::modeling {

double youngsModulusOfShoreA(double hardness) {
  return 0.0981 * (56 + 7.62336 * hardness) / (0.137505 * (254 - 2.54 * hardness));
}

double estimatedModulusOfShoreA(double hardness) {
  constexpr int kDigits = 4;
  return roundedToDigits(youngsModulusOfShoreA(hardness), kDigits);
}

}  // namespace palpa::modeling
