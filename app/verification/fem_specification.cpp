#include "app/verification/fem_specification.h"

#include <string>

namespace palpa::verification {

FemSpecification femTriangles(const nlohmann::json& entry) {
  FemSpecification how{{}, 0.015, 0.015, 0.01, 0.015, 0.003};
  how.mesh.engine = modeling::Engine::kTriangles;
  const std::string shape = entry.at("geometry").at("type");
  if (shape == "sphere") {
    how.mesh.edgeLength = 1.8;
    if (entry.at("id") == "c_sph_equator") {
      // The border of the support carries much of the load: 4.9 % at 2,426 nodes, an error
      // proportional to the edge length.
      how.atLoad = how.anywhere = 0.06;
      how.energy = 0.05;
    }
  } else if (entry.contains("load")) {
    how.mesh.edgeLength = 2.9;
    how.mesh.refinementLevels = 2;
    how.mesh.refineAtBorders = true;
    how.anywhere = 0.01;
    how.reaction = 0.003;
    how.energy = 0.01;
  } else {
    how.mesh.edgeLength = 2.25;
    how.anywhere = 0.005;
    how.energy = 0.01;
  }
  return how;
}

FemSpecification femSplines(bool isQuick) {
  FemSpecification how = isQuick ? FemSpecification{{}, 1e-2, 1e-2, 1e-2, 1e-2, 1e-2}
                                 : FemSpecification{{}, 5e-3, 7e-3, 3e-3, 1e-2, 3e-3};
  how.mesh.engine = modeling::Engine::kSplines;
  how.mesh.edgeLength = 4;
  how.mesh.accuracy = isQuick ? 1e-2 : 3e-3;
  return how;
}

FemSpecification femQuadratic(bool isQuick) {
  FemSpecification how{{}, 5e-3, 7e-3, 5e-3, 1e-2, 3e-3};
  how.mesh.engine = modeling::Engine::kQuadratic;
  how.mesh.edgeLength = isQuick ? 3.6 : 2.6;
  if (isQuick) how.atLoad = how.anywhere = how.reaction = 0.015;
  return how;
}

}  // namespace palpa::verification
