#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/job.h"
#include "modeling/body/body.h"

namespace palpa::modeling {

struct ImportOptions {
  /// Length of mesh edges the body is meant for, in mm; 0: such that its surface gets about 600
  /// nodes. A mesh body follows curved faces within 1/50 of it.
  double edgeLength = 0.0;
  /// Largest distance in mm by which patches may differ from surfaces that are no plain B-splines
  /// (cylinders, cones, rational splines); 0: 1e-4 of the diagonal of the bounding box.
  double tolerance = 0.0;

  /// @throws ModelingError that names the field: finite, not negative, below ten kilometres
  void validate() const;
};

/// A body from a file, and how faithful it is.
struct ImportedBody {
  Body body;
  /// Sentences for the user: what was approximated and by how much, what was repaired, why it
  /// became a mesh body. Empty when the body is what the file says.
  std::vector<std::string> notes;
  /// Largest distance found between the body and the file's surfaces, mm.
  double deviation = 0.0;
};

/// Reads the one solid of a STEP, IGES or BREP file, in mm, with the names of its faces.
///
/// It becomes a NUBS solid when every face is one four-sided piece of a surface without a pole, and
/// the faces meet side to side with the same parameters (docs/exchange.md); what exportCad() wrote
/// is read back unchanged. Otherwise it becomes a mesh body, and a note says why.
///
/// The file is read twice: first by the program palpa-read-cad, so that a damaged file that makes
/// OpenCASCADE crash or work without end costs nothing but an error (docs/decisions/010).
/// Cancelling stops the first reading at once, the second one between faces and entities. Exports
/// and imports of several threads run one after the other.
///
/// @throws ModelingError that begins with the file's name: not there, not readable, damaged, larger
///         than kMaxCadFile, taking longer than 10 s and 20 s per MiB, several solids, a
///         surface that is not closed (with the place); Cancelled
ImportedBody importCad(const std::filesystem::path& path, const ImportOptions& options = {},
                       const Job& job = {});

}  // namespace palpa::modeling
