#pragma once
#include <Eigen/Core>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

/// The finite element solutions of data/fem.json (two independent programs that agree to 0.03 % of
/// the largest displacement).
namespace palpa::test {

inline nlohmann::json femCase(const std::string& id) {
  std::ifstream file("data/fem.json");
  const nlohmann::json all = nlohmann::json::parse(file);
  for (const nlohmann::json& entry : all["cases"])
    if (entry["id"] == id) return entry;
  throw std::runtime_error("data/fem.json has no case " + id);
}

inline Eigen::Vector3d vectorOf(const nlohmann::json& list) {
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

}  // namespace palpa::test
