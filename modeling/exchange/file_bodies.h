#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/job.h"
#include "modeling/error.h"
#include "modeling/exchange/import_placement.h"

namespace palpa::modeling {

/// A body in a CAD or mesh file: a solid with the placement of its assembly, or a closed surface
/// with its cavities. Lengths in mm.
struct FileBody {
  std::string name;      ///< unique in the file; solid_2 for the second one if the file has no name
  bool isNamed = false;  ///< the file contains the name
  int faces = 0;         ///< of a CAD file; 0 for a mesh file
  int triangles = 0;     ///< of a mesh file; 0 for a CAD file
  Eigen::Vector3d low = Eigen::Vector3d::Zero();  ///< corners of the axis-parallel box; a few
                                                  ///< per cent too large with many spline faces
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
  double volume = 0.0;  ///< mm³; of solids not yet repaired, so it may be wrong for faulty ones
  /// Coarse surface for a picture, corners counter-clockwise seen from outside, not joined between
  /// faces; empty unless asked for.
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::array<int, 3>> surface;

  Eigen::Vector3d size() const { return high - low; }
};

/// The bodies of a file, in the order of the file; at least one.
struct FileBodies {
  std::vector<FileBody> bodies;
  double unit = 1.0;        ///< mm per unit of length of the file; 0: parts in different units
  bool statesUnit = false;  ///< false for mesh and BREP files, whose unit is assumed to be mm
};

enum class ListedSurface { kNone, kCoarse };

/// Bodies of a file of a format of isImportable(), with the placement applied to their boxes and
/// volumes.
/// Throws ModelingError as importBody() if the file cannot be read or has no closed body;
/// Cancelled.
FileBodies listBodies(const std::filesystem::path& path, const ImportPlacement& placement = {},
                      ListedSurface surface = ListedSurface::kNone, const Job& job = {});

/// Index of the body with this number (from 1) or name; none if there is none.
std::optional<std::size_t> findBody(const FileBodies& found, const std::string& choice);

/// Index of the body that `choice` names: its number from 1, or its name. An empty choice is the
/// only body. Throws ModelingError (without the file's name) if there is no such body;
/// SeveralBodies if a choice is necessary.
std::size_t chooseBody(const FileBodies& found, const std::string& choice);

/// Multiplies the lengths of the list by `factor` and rotates it, as placed() does with a body.
void place(FileBodies& found, double factor, UpAxis up);

/// "Read solid 2 of 3, "lid"."
std::string chosenNote(const FileBodies& found, std::size_t index);

/// Name of a project with this body: the name in the file, or the file's name and the number.
std::string projectName(const FileBody& body, const std::filesystem::path& path);

/// Thrown if a file has several bodies and none was chosen. The message lists the first of them
/// with numbers, names and sizes.
class SeveralBodies : public ModelingError {
 public:
  /// `prefix`: the file's name and ": ", or nothing.
  SeveralBodies(const std::string& prefix, FileBodies found);
  const FileBodies& found() const { return found_; }

 private:
  FileBodies found_;
};

/// Makes names unique: those that occur several times get a number, as screw_1 and screw_2, and
/// bodies without a name become solid_1, … by their number in the list.
void makeNamesUnique(std::vector<FileBody>& bodies);

}  // namespace palpa::modeling
