#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/job.h"
#include "modeling/body/body.h"
#include "modeling/exchange/file_bodies.h"
#include "modeling/exchange/import_placement.h"

namespace palpa::modeling {

/// Body, size, orientation and accuracy of an import.
struct ImportOptions {
  /// Intended edge length of meshes of the body, in mm; 0: the length for about 600 nodes. A mesh
  /// body follows curved faces within 1/50 of it.
  double edgeLength = 0.0;
  /// Largest distance in mm between patches and surfaces other than plain B-splines (cylinders,
  /// cones, rational splines); 0: 1e-4 of the diagonal of the bounding box.
  double tolerance = 0.0;
  /// Number from 1 or name of the body in listBodies(); empty: the only one.
  std::string solid;
  ImportPlacement placement;  ///< the lengths above refer to the placed body

  /// Throws ModelingError that names the field if a length is not finite, negative or above ten
  /// kilometres, or the placement is out of range.
  void validate() const;
};

/// A body from a file, and its accuracy.
struct ImportedBody {
  Body body;
  /// Sentences for the user: approximations and their size, repairs, the reason for a mesh body.
  /// Empty if the body equals the content of the file.
  std::vector<std::string> notes;
  /// Largest distance found between the body and the surfaces of the file, mm.
  double deviation = 0.0;
  std::string name;  ///< projectName() of the body if the file has several, otherwise empty
};

/// One of several bodies of a file.
struct BodyOutcome {
  std::optional<ImportedBody> imported;
  std::string problem;  ///< why the body cannot be imported; empty if it was
};

/// Receives the bodies of a file one after the other, by their index from 0.
using TakeBody = std::function<void(std::size_t index, BodyOutcome outcome)>;

/// Reads a solid of a STEP, IGES or BREP file, in mm, with the names of its faces.
///
/// The result is a NUBS solid if every face is one four-sided piece of a surface without a pole and
/// the faces meet side to side with the same parameters (docs/exchange.md); files of exportCad()
/// give back the same solid. Otherwise the result is a mesh body with a note of the reason.
///
/// The program palpa-read-cad reads the file, so that a damaged file that makes OpenCASCADE crash
/// or loop endlessly only causes an error (docs/decisions/010). Cancelling stops it at once.
///
/// Throws ModelingError that begins with the file's name if the file does not exist, is unreadable,
/// damaged or larger than kMaxCadFile, needs longer than 10 s + 20 s per MiB, does not hold the
/// chosen solid, or has an open surface (the message names the place); SeveralBodies; Cancelled.
ImportedBody importCad(const std::filesystem::path& path, const ImportOptions& options = {},
                       const Job& job = {});

/// Imports all of the `count` solids of a CAD file as importCad() does with one, and passes the
/// outcome of each in the order of the file to `take`. If OpenCASCADE crashes at a solid, that
/// solid alone is refused, and the program palpa-read-cad starts again behind it. Throws as
/// importCad() if the file cannot be read.
void importCadBodies(const std::filesystem::path& path, std::size_t count,
                     const ImportOptions& options, const TakeBody& take, const Job& job = {});

/// Solids of a CAD file, in mm, as listBodies() without a placement. Throws as importCad().
FileBodies listCad(const std::filesystem::path& path, ListedSurface surface, const Job& job = {});

}  // namespace palpa::modeling
