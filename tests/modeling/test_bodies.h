#pragma once

#include "modeling/body/body.h"

// Mesh bodies whose exact shape is known.
namespace palpa::modeling::test {

/// Mesh of a solid as a body, its patches as faces.
MeshBody bodyOf(const Solid& solid, double edgeLength);

/// Body with one face for all triangles.
MeshBody oneFace(std::vector<Eigen::Vector3d> positions, std::vector<std::array<int, 3>> triangles);

/// Torus with the radii of the centre line and of the tube, mm; `around` by `across` quads, each
/// cut in two.
MeshBody torus(double radius, double tube, int around, int across);

/// Bored cylinder: outer radius, bore radius, height along z from 0, mm; `sides` facets.
MeshBody boredCylinder(double radius, double bore, double height, int sides);

/// Sphere of 20 · 4^level triangles, radius in mm.
MeshBody icosphere(double radius, int level);

/// Sphere with a concentric spherical cavity.
MeshBody hollowSphere(double radius, double cavity, int level);

/// Box with two corners at 0 and `size`, 12 triangles.
MeshBody plainBox(const Eigen::Vector3d& size);

/// Body with vertices moved by up to `amplitude` mm in every direction, reproducibly.
MeshBody noisy(const MeshBody& body, double amplitude);

/// Body with every third triangle cut into three by a point very near one of its edges.
MeshBody withSlivers(const MeshBody& body);

}  // namespace palpa::modeling::test
