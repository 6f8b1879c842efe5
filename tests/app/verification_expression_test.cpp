#include "app/verification/expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace palpa::verification {
namespace {

double value(const std::string& text) {
  return evaluate(text, {{"x", 3.0}, {"pi_", 7.0}});
}

TEST(Expression, FollowsTheUsualOrderOfOperations) {
  EXPECT_EQ(value("1+2*x"), 7);
  EXPECT_EQ(value("(1+2)*x - 4 / 2"), 7);
  EXPECT_EQ(value("8/4/2"), 1);
  EXPECT_EQ(value("10-4-3"), 3);
  EXPECT_EQ(value("2*x**2"), 18);
  EXPECT_EQ(value("2**3**2"), 512);
  EXPECT_EQ(value("-x**2"), -9);
  EXPECT_EQ(value("2**-1"), 0.5);
  EXPECT_EQ(value("2*-x"), -6);
  EXPECT_EQ(value("-(-x)"), 3);
}

TEST(Expression, KnowsNumbersNamesPiAndRoots) {
  EXPECT_EQ(value("1.5e-3"), 1.5e-3);
  EXPECT_EQ(value(".5"), 0.5);
  EXPECT_EQ(value("pi"), std::numbers::pi);
  EXPECT_EQ(value("pi_*x"), 21);
  EXPECT_EQ(value("sqrt(x*x+16)"), 5);
}

TEST(Expression, SaysWhereAMistakeIs) {
  for (const char* bad : {"", "1+", "(1", "unknown", "1 2", "sqrt 4", "x)", ".", "1e999"})
    EXPECT_THROW(value(bad), std::invalid_argument) << bad;
  EXPECT_THROW(value(std::string(1000000, '(')), std::invalid_argument);
}

}  // namespace
}  // namespace palpa::verification
