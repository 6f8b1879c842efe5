#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "modeling/exchange/mesh_writer.h"

namespace palpa::modeling {

/// Meshes over time as ParaView reads them: a collection NAME.pvd, which lists times and files, and
/// beside it a folder NAME with NAME_00000.vtp, NAME_00001.vtp, …
///
/// Everything appears at commit(): until then the files are in a hidden folder beside the
/// collection, which the destructor removes. commit() replaces files of an earlier series of the
/// same name and removes its further files; other files in the folder stay.
///
/// All functions throw ModelingError (kind io) or FileError if something cannot be written; the
/// constructor also if the name does not end in .pvd or the folder cannot be made.
class MeshSeries {
 public:
  explicit MeshSeries(const std::filesystem::path& collection);
  ~MeshSeries();
  MeshSeries(const MeshSeries&) = delete;
  MeshSeries& operator=(const MeshSeries&) = delete;

  /// Writes the next mesh. `time`: larger than the one before, in any unit.
  void add(const MeshFile& mesh, double time);
  std::size_t size() const { return times_.size(); }
  void commit();

 private:
  std::string fileName(std::size_t number) const;
  std::string collectionText() const;
  void removeFurtherFiles() const;

  std::filesystem::path folder_;  // beside the collection, with its name
  std::filesystem::path hidden_;  // until commit()
  AtomicFile collection_;
  std::vector<double> times_;
};

}  // namespace palpa::modeling
