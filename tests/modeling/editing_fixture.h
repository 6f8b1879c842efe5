#pragma once

#include <gtest/gtest.h>

#include "modeling/editing/document.h"
#include "modeling/error.h"
#include "modeling/shapes/primitives.h"

namespace palpa::modeling {

/// Project with one condition of each kind around a solid that has the six patches of a box.
inline Project editingProject(const Solid& solid) {
  Project project;
  project.name = "test";
  project.material = {"silicone", 0.1, 0.48};
  project.body = solid;
  const Region low{
      {HalfSpace{{0, 0, 1}, -5.0}, PatchSet{{"bottom"}}, Stroke{{{20, 0, 0}, {20, 5, 3}}, 2.0}}};
  project.supports = {{"base", Support::Kind::kFixed, low, {0, 0, -0.25}}};
  project.loads = {{"press", Pressure{Region::ofPatches({"top"}), 0.01}},
                   {"finger", Bump{{0, 0, 25}, 4.0, 0.02, {0, 0, -1}}}};
  project.touches = {{"poke", {0, 0, 25}, TouchKind::kForce, {0, 0, -1}, 3.0}};
  project.mesh.edgeLength = 4.0;
  project.mesh.patchFactors = {{"top", 0.5}};
  return project;
}

inline const Solid& solidOf(const Project& project) {
  return std::get<Solid>(project.body);
}

/// Message of the error of a call; empty if it succeeds.
template <class Call>
std::string faultOf(Call call) {
  try {
    call();
  } catch (const ModelingError& error) {
    return error.what();
  }
  return "";
}

inline void expectBegins(const std::string& text, const std::string& start) {
  EXPECT_EQ(text.rfind(start, 0), 0U)
      << "\"" << text << "\" does not begin with \"" << start << "\"";
}

}  // namespace palpa::modeling
