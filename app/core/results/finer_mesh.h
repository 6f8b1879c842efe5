#pragma once

#include "base/job.h"
#include "modeling/mesh/mesh_settings.h"
#include "modeling/project/project.h"

// Meshes with shorter elements and what is expected of them.
namespace palpa::app {

/// Usual order of convergence of the force under a contact that the mesh can represent, by the
/// length of its elements. Linear triangles have 2. Splines have up to 6 where they resolve all
/// (bumps, see element_sizes.cpp), about 3 with edges and borders.
double usualOrder(bool hasSplines);

/// Order of convergence from the errors of two meshes of one body, both > 0, and the factor by
/// which the elements of the second one are shorter; the usual one if that is nearly 1. 1 to 6:
/// orders outside belong to meshes that are too coarse to show one.
double observedOrder(double formerError, double error, double refinement, bool hasSplines);

/// Factor by which the elements of a finer mesh are shorter.
double refinement(const modeling::MeshSettings& mesh, const modeling::MeshSettings& finer,
                  bool hasSplines);

/// Divides all lengths of elements by `factor` ≥ 1, to three digits. Splines whose size follows
/// the accuracy end at MeshSettings::kMaxSplineDensity.
modeling::MeshSettings finerMesh(modeling::MeshSettings mesh, bool hasSplines, double factor);

/// Coefficients of displacement of a project with other mesh settings, with triangles nodes,
/// about; infinite if they are impossible. Costs a spline refinement or an estimate of nodes.
/// Throws Cancelled.
double estimateCoefficients(const modeling::Project& project, const modeling::MeshSettings& mesh,
                            const Job& job);

}  // namespace palpa::app
