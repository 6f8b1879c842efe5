#pragma once

namespace palpa::modeling {

/// Range of youngsModulusOfShoreA(). Gent compares the relation with measurements on rubber; at 100
/// it is singular, and for very soft rubber the reading hardly depends on the modulus.
inline constexpr double kMinShoreA = 20;
inline constexpr double kMaxShoreA = 80;

/// Estimate of Young's modulus (MPa) of rubber from its hardness S on Shore's scale A:
///   E = 0.0981 (56 + 7.62336 S) / (0.137505 (254 - 2.54 S)),
/// from the force of the durometer's spring and the indentation of a linear elastic half space by
/// its blunt cone: A. N. Gent, On the relation between indentation hardness and Young's modulus,
/// Rubber Chem. Technol. 31 (1958) 896-906. `hardness` < 100.
double youngsModulusOfShoreA(double hardness);

/// youngsModulusOfShoreA() rounded to four digits, which are more than the estimate has: the value
/// that the window and the command line enter.
double estimatedModulusOfShoreA(double hardness);

}  // namespace palpa::modeling
