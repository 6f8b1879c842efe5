#pragma once

#include <limits>
#include <map>
#include <string>

#include "bench/peers/peer_case.h"

namespace palpa::bench {

/// Measurements of one method on one mesh, by name. Times in s, memory in bytes, errors relative. A
/// method leaves out values that it does not have.
///
///   n         nodes of the surface, or coefficients of splines
///   unknowns  of the system of equations
///   size      edge length of the surface in mm, or the requested accuracy of splines
///   setup     from the edited body to the first touch: mesh, assemble, factorise and the rest
///   touch     a new touch, from its place to its force
///   field     its displacements: of the surface, or of all nodes of a volume
///   move      from a place a little further along to its force
///   move_kept the same with everything for touches at these places precomputed
///   column    of the precomputation, per node of the surface (three columns of Green's function)
///   memory    largest, of the method and the programs it runs
///   reciprocity  asymmetry of the compliance of a touch
///   kelvin    error of the displacements on the surface, L2, against the exact field
///   stiffness error of the force of a touch, against the reference
struct PeerRow {
  std::map<std::string, double> values;
  std::string note;  ///< a few words, without semicolons
};

// One method each: makes the body with edges of `size` mm (splines: for an accuracy of `size`) and
// measures.
PeerRow measureTriangles(const PeerCase& body, double size);
PeerRow measureQuadratic(const PeerCase& body, double size);
PeerRow measureSplines(const PeerCase& body, double size);
/// Plain method: scalar assembly, LU factors in double precision by LAPACK, a full rebuild for
/// every edit.
PeerRow measurePlain(const PeerCase& body, double size);
/// Tetrahedra with linear or quadratic displacements inside the same surface mesh.
PeerRow measureFiniteElements(const PeerCase& body, double size, bool isQuadratic);
/// The same quadratic mesh and touch given to CalculiX.
PeerRow measureCalculix(const PeerCase& body, double size);

}  // namespace palpa::bench
