#include "modeling/exchange/mesh_series.h"

#include <stdlib.h>

#include <algorithm>
#include <cstdio>
#include <system_error>

#include "base/text.h"
#include "modeling/error.h"

namespace palpa::modeling {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".pvd";
constexpr const char* kMeshEnding = ".vtp";

[[noreturn]] void cannotWrite(const fs::path& path, const std::string& cause) {
  throw ModelingError(path.string() + ": cannot be written (" + cause + ")",
                      ModelingError::Kind::kIo);
}

fs::path requirePvd(const fs::path& collection) {
  if (collection.extension() != kEnding || collection.stem().empty())
    throw ModelingError(collection.string() + ": the name must end in .pvd");
  return collection;
}

/// A new folder in the folder of the collection, so that renaming its files moves no data.
fs::path makeHiddenFolder(const fs::path& collection) {
  std::string pattern =
      (collection.parent_path() / ("." + collection.stem().string() + "-XXXXXX")).string();
  if (!mkdtemp(pattern.data()))
    cannotWrite(collection, std::error_code(errno, std::generic_category()).message());
  return pattern;
}

/// As the value of an XML attribute.
std::string attribute(const std::string& text) {
  std::string value;
  for (const char c : text) {
    if (c == '&')
      value += "&amp;";
    else if (c == '<')
      value += "&lt;";
    else if (c == '"')
      value += "&quot;";
    else
      value += c;
  }
  return value;
}

}  // namespace

MeshSeries::MeshSeries(const fs::path& collection)
    : folder_(requirePvd(collection).parent_path() / collection.stem()), collection_(collection) {
  std::error_code none;
  if (fs::exists(folder_, none) && !fs::is_directory(folder_, none))
    cannotWrite(collection, "the folder " + folder_.string() + " for its meshes is a file");
  hidden_ = makeHiddenFolder(collection);
}

MeshSeries::~MeshSeries() {
  std::error_code none;
  fs::remove_all(hidden_, none);
}

std::string MeshSeries::fileName(std::size_t number) const {
  char text[32];
  std::snprintf(text, sizeof text, "_%05zu", number);
  return folder_.filename().string() + text + kMeshEnding;
}

void MeshSeries::add(const MeshFile& mesh, double time) {
  writeMesh(mesh, hidden_ / fileName(times_.size()));
  times_.push_back(time);
}

std::string MeshSeries::collectionText() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (std::size_t k = 0; k < times_.size(); ++k)
    text += "<DataSet timestep=\"" + numberText(times_[k]) + "\" group=\"\" part=\"0\" file=\"" +
            attribute(folder_.filename().string() + '/' + fileName(k)) + "\"/>\n";
  return text + "</Collection>\n</VTKFile>\n";
}

/// Meshes that an earlier, longer series has left.
void MeshSeries::removeFurtherFiles() const {
  std::error_code none;
  for (std::size_t k = times_.size(); fs::remove(folder_ / fileName(k), none); ++k) {
  }
}

void MeshSeries::commit() {
  std::error_code error;
  fs::create_directory(folder_, error);
  if (error) cannotWrite(folder_, error.message());
  for (std::size_t k = 0; k < times_.size(); ++k) {
    fs::rename(hidden_ / fileName(k), folder_ / fileName(k), error);
    if (error) cannotWrite(folder_ / fileName(k), error.message());
  }
  removeFurtherFiles();
  collection_.write(collectionText());
  collection_.commit();
}

}  // namespace palpa::modeling
