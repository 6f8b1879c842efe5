// What a user would pick instead: tetrahedra inside the same surface mesh and a sparse Cholesky
// factorisation.
#include <Eigen/LU>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "bench/peers/calculix.h"
#include "bench/peers/case_mesh.h"
#include "bench/peers/finite_element_body.h"
#include "bench/peers/peer_row.h"
#include "bench/peers/tetgen.h"
#include "bench/timing.h"

namespace palpa::bench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TetrahedralMesh meshOf(const PeerCase& body, double size, bool isQuadratic, PeerRow& row) {
  TetrahedralMesh mesh;
  row.values["mesh"] = secondsFor([&] {
    const app::BoundarySetup setup = triangleSetup(body, size);
    row.values["n"] = setup.mesh().nodeCount();
    ProgramRun run;
    mesh = meshWithTetgen(setup.mesh(), &run);
    row.values["program memory"] = run.peakBytes;
    if (isQuadratic) mesh = makeQuadratic(mesh, body.middle);
  });
  return mesh;
}

/// Free nodes of the surface within a distance of a point.
std::vector<int> nodesWithin(const FiniteElementBody& body, const Vector3d& at, double distance) {
  const TetrahedralMesh& mesh = body.mesh();
  std::vector<char> isTaken(mesh.nodes.size(), 0);
  std::vector<int> nodes;
  for (const auto& face : mesh.faces)
    for (int k = 0; k < mesh.faceNodes(); ++k) {
      const int node = face[k];
      if (isTaken[node] || body.elements().freeOfNode[node] < 0 ||
          (mesh.nodes[node] - at).norm() > distance)
        continue;
      isTaken[node] = 1;
      nodes.push_back(node);
    }
  return nodes;
}

/// A touch that moves where all that it needs was computed before: D from the rows and columns of
/// the mask's nodes.
double secondsPerKeptStep(const PeerCase& body, double size, FiniteElementBody& fem, PeerRow& row) {
  // All nodes of the faces that masks along the path reach.
  const double reach =
      body.reference.radius + 1.5 * size + (body.path.back() - body.path.front()).norm();
  const std::vector<int> nodes = nodesWithin(fem, body.path.front(), reach);
  std::vector<int> placeOfNode(fem.mesh().nodes.size(), -1);
  for (std::size_t k = 0; k < nodes.size(); ++k) placeOfNode[nodes[k]] = static_cast<int>(k);
  Eigen::MatrixXd kept;
  const double seconds = secondsFor([&] { kept = fem.condensedCompliance(nodes); });
  row.values["column"] = seconds / static_cast<double>(nodes.size());
  std::vector<double> steps;
  double stiffness = 0;
  for (const Vector3d& at : body.path)
    steps.push_back(secondsFor([&] {
      const SurfaceMask mask = makeSurfaceMask(fem.mesh(), at, body.reference.radius);
      Matrix3d compliance = Matrix3d::Zero();
      for (std::size_t a = 0; a < mask.nodes.size(); ++a)
        for (std::size_t b = 0; b < mask.nodes.size(); ++b) {
          const int i = placeOfNode[mask.nodes[a]], j = placeOfNode[mask.nodes[b]];
          if (i < 0 || j < 0) throw std::logic_error("the patch is too small");
          compliance += mask.weights[a] * mask.weights[b] * kept.block<3, 3>(3 * i, 3 * j);
        }
      stiffness += compliance.inverse()(0, 0);
    }));
  row.values["kept stiffness"] = stiffness;  // so that nothing is optimised away
  return quantilesOf(steps).p50;
}

}  // namespace

PeerRow measureFiniteElements(const PeerCase& body, double size, bool isQuadratic) {
  PeerRow row;
  std::optional<FiniteElementBody> fem;
  row.values["setup"] = secondsFor([&] {
    TetrahedralMesh mesh = meshOf(body, size, isQuadratic, row);
    std::optional<FiniteElements> elements;
    row.values["assemble"] = secondsFor([&] { elements.emplace(mesh, body.material, Job{}); });
    row.values["factorise"] =
        secondsFor([&] { fem.emplace(std::move(mesh), std::move(*elements)); });
  });
  row.values["unknowns"] = fem->unknowns();

  const auto touch = [&](const Vector3d& at) {
    return fem->touch(makeSurfaceMask(fem->mesh(), at, body.reference.radius));
  };
  std::vector<double> begins, moves, fields;
  for (const Vector3d& at : body.places)
    begins.push_back(secondsFor([&] { touch(at).compliance.inverse(); }));
  for (const Vector3d& at : body.path) {
    std::optional<FiniteElementBody::Touch> touched;
    moves.push_back(secondsFor([&] { touched.emplace(touch(at)); }));
    fields.push_back(secondsFor([&] { fem->field(*touched, {0, 0, 1}); }));
  }
  row.values["touch"] = quantilesOf(begins).p50;
  row.values["move"] = quantilesOf(moves).p50;
  row.values["field"] = quantilesOf(fields).p50;
  row.values["stiffness"] = stiffnessError(body, touch(body.reference.at).compliance);
  row.values["kelvin"] = surfaceError(
      fem->mesh(),
      fem->solve([&](const Vector3d& x) { return body.exactDisplacement(x); },
                 [&](const Vector3d& x, const Vector3d& n) { return body.exactTraction(x, n); }),
      [&](const Vector3d& x) { return body.exactDisplacement(x); });
  row.values["move_kept"] = secondsPerKeptStep(body, size, *fem, row);
  char text[64];
  std::snprintf(text, sizeof text, "%zu tetrahedra, L %.0f MiB, %s", fem->mesh().tetrahedra.size(),
                fem->factors().entries() * 8 / (1 << 20), fem->factors().ordering());
  row.note = text;
  return row;
}

PeerRow measureCalculix(const PeerCase& body, double size) {
  PeerRow row;
  TetrahedralMesh mesh;
  CalculixResult result;
  row.values["setup"] = secondsFor([&] {
    mesh = meshOf(body, size, true, row);
    // The nodal forces of the touch; only the surface is needed for these, nothing is factorised.
    result = pushWithCalculix(mesh, body.material, body.reference.at, body.reference.radius,
                              body.reference.direction);
  });
  row.values["touch"] = row.values["move"] = result.seconds;
  row.values["unknowns"] = result.unknowns;
  row.values["stiffness"] = std::abs(body.reference.compliance / result.compliance - 1);
  row.values["program memory"] = std::max(row.values["program memory"], result.peakBytes);
  return row;
}

}  // namespace palpa::bench
