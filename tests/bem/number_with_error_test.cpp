// Numbers rounded to their errors.
#include "base/number_with_error.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>

namespace palpa {
namespace {

std::string text(double value, double error) {
  const int decimals = decimalsFor(value, error);
  return withDecimals(value, decimals) + " ± " + errorText(error, decimals);
}

TEST(NumberWithError, EndsAtTheFirstDigitOfTheError) {
  EXPECT_EQ(text(4.7215, 0.026), "4.72 ± 0.03");
  EXPECT_EQ(text(4.7215, 0.1), "4.7 ± 0.1");
  EXPECT_EQ(text(-4.7015, 0.02), "-4.70 ± 0.02");
  EXPECT_EQ(text(1234, 21), "1230 ± 30");
  EXPECT_EQ(text(0.00047215, 0.0000026), "0.000472 ± 0.000003");
}

TEST(NumberWithError, KeepsADigitOfWrongNumbersAndSixOfExactOnes) {
  EXPECT_EQ(text(4.7, 30), "5 ± 30");
  EXPECT_EQ(withDecimals(1.0 / 3, decimalsFor(1.0 / 3, 0)), "0.333333");
  EXPECT_EQ(withDecimals(1.0 / 3, decimalsFor(1.0 / 3, 1e-12)), "0.333333");
  EXPECT_EQ(withDecimals(0, decimalsFor(0, 0.1)), "0");
}

TEST(NumberWithError, HasNoMinusZeroAndNoLongTails) {
  EXPECT_EQ(withDecimals(-0.0001, 2), "0.00");
  EXPECT_EQ(withDecimals(1.23456e-12, 14), "1.23e-12");
}

TEST(NumberWithError, HasAPointInEveryLocale) {
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
    if (std::setlocale(LC_NUMERIC, name)) {
      EXPECT_EQ(text(4.7215, 0.026), "4.72 ± 0.03") << name;
    }
  std::setlocale(LC_NUMERIC, "C");
}

TEST(NumberWithError, IsCompleteForHugeNumbers) {
  EXPECT_EQ(withDecimals(1e300, 0).size(), 301u);
}

TEST(NumberWithError, RoundingAddsLessThanTheError) {
  for (double value = 1e-5; value < 1e5; value *= 1.37)
    for (double relative = 1e-4; relative < 0.5; relative *= 1.9) {
      const double error = relative * value;
      const int decimals = decimalsFor(value, error);
      EXPECT_LE(std::abs(std::stod(withDecimals(value, decimals)) - value), 0.5001 * error);
      EXPECT_GE(std::stod(errorText(error, decimals)), error * (1 - 1e-6));
      EXPECT_EQ(digitsFor(value, error),
                decimals + 1 + static_cast<int>(std::floor(std::log10(value))));
    }
}

}  // namespace
}  // namespace palpa
