#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/core/model/touch_model.h"
#include "app/python/arrays.h"
#include "app/python/model.h"
#include "modeling/editing/document.h"

namespace palpa::python {

/// A project with its history: what the Python class palpa.Project wraps. Used with the
/// interpreter's lock, so by one thread at a time; build() copies the project before it releases
/// the lock.
class Project {
 public:
  explicit Project(modeling::Project project) : document_(std::move(project)) {}

  /// The project of a file of ours.
  static std::unique_ptr<Project> read(const std::string& path);
  /// The project of a primitive, given as the command make_primitive in JSON.
  static std::unique_ptr<Project> make(const std::string& command, const std::string& name);

  struct Import {
    std::string path, solid, unit, up;
    double edgeLength = 0, tolerance = 0, scale = 1;
  };
  /// A project with the body of a CAD or mesh file; (project, notes, deviation in mm, what is
  /// held).
  static pybind11::tuple import(const Import& from, const pybind11::object& progress);

  const modeling::Project& project() const { return document_.project(); }
  /// The text of the project file.
  std::string json() const;
  /// The same with another, small body: for reading everything else.
  std::string partsJson() const;

  /// Applies commands in JSON (docs/editing.md). Several commands are one step of undo with
  /// `label`. A command that fails undoes those before it. Returns the largest deviation, mm.
  double perform(const std::string& commands, const std::string& label);
  /// Moves control points to positions in mm, one row each.
  void movePoints(const std::vector<int>& indices, const Numbers& positions);
  void beginGroup(const std::string& label) { document_.beginGroup(label); }
  void endGroup() { document_.endGroup(); }
  void cancelGroup() { document_.cancelGroup(); }
  /// False if there is nothing to undo or redo.
  bool undo();
  bool redo();
  std::string undoLabel() const { return document_.undoLabel(); }
  std::string redoLabel() const { return document_.redoLabel(); }

  bool isModified() const { return !document_.isClean(); }
  void save(const std::string& path);
  void exportTo(const std::string& path, const pybind11::object& progress) const;

  /// Control points of a solid or vertices of a mesh body, one row each.
  pybind11::array_t<double> points() const;
  bool isSolid() const;
  std::vector<std::string> patches() const;
  double volume() const;
  double area() const;

  struct Build {
    std::optional<double> accuracy, edgeLength, elementLength;
    std::optional<std::string> engine;
    int threads = 0;
  };
  std::shared_ptr<Model> build(const Build& options, const pybind11::object& progress);

 private:
  modeling::Document document_;
  /// Its solved problem is used again if nothing that it depends on has changed.
  std::weak_ptr<const app::TouchModel> last_;
};

/// Adds the class to the module.
void bindProject(pybind11::module_& module);

}  // namespace palpa::python
