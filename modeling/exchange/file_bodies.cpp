#include "modeling/exchange/file_bodies.h"

#include <charconv>

#include "modeling/exchange/cad_import.h"
#include "modeling/exchange/file_format.h"
#include "modeling/exchange/mesh_reader.h"
#include "modeling/exchange/unique_names.h"

namespace palpa::modeling {
namespace {

constexpr std::size_t kMaxListed = 20;  // bodies in a message

std::string listText(const std::vector<FileBody>& bodies) {
  std::string text;
  for (std::size_t i = 0; i < bodies.size() && i < kMaxListed; ++i)
    text += (i == 0 ? "" : "; ") + std::to_string(i + 1) + " \"" + bodies[i].name + "\" of " +
            sizeText(bodies[i].size());
  return bodies.size() > kMaxListed
             ? text + "; and " + std::to_string(bodies.size() - kMaxListed) + " more"
             : text;
}

}  // namespace

FileBodies listBodies(const std::filesystem::path& path, const ImportPlacement& placement,
                      ListedSurface surface, const Job& job) {
  placement.validate();
  if (!isCad(infoOf(requireFormat(path, isImportable)))) {
    FileBodies found = listMeshFile(path, placement.factor(1.0), surface, job);
    place(found, 1.0, placement.up);
    return found;
  }
  FileBodies found = listCad(path, surface, job);
  try {
    place(found, placement.factor(found.unit), placement.up);
  } catch (const ModelingError& error) {
    throw ModelingError(path.string() + ": " + error.what(), error.kind());
  }
  return found;
}

std::optional<std::size_t> findBody(const FileBodies& found, const std::string& choice) {
  const std::vector<FileBody>& bodies = found.bodies;
  std::size_t number = 0;
  const char* end = choice.data() + choice.size();
  const auto [stop, code] = std::from_chars(choice.data(), end, number);
  if (code == std::errc() && stop == end && number >= 1 && number <= bodies.size())
    return number - 1;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].name == choice) return i;
  return std::nullopt;
}

std::size_t chooseBody(const FileBodies& found, const std::string& choice) {
  if (choice.empty()) {
    if (found.bodies.size() > 1) throw SeveralBodies("", found);
    return 0;
  }
  if (const auto index = findBody(found, choice)) return *index;
  throw ModelingError("has no solid \"" + choice + "\"; its solids are " + listText(found.bodies),
                      ModelingError::Kind::kNotFound);
}

void place(FileBodies& found, double factor, UpAxis up) {
  const Eigen::Matrix3d rotation = rotationOf(up);
  for (FileBody& body : found.bodies) {
    const Eigen::Vector3d a = rotation * (factor * body.low) + Eigen::Vector3d::Zero();
    const Eigen::Vector3d b = rotation * (factor * body.high) + Eigen::Vector3d::Zero();
    body.low = a.cwiseMin(b);
    body.high = a.cwiseMax(b);
    body.volume *= factor * factor * factor;
    for (Eigen::Vector3d& p : body.positions) p = rotation * (factor * p);
  }
}

std::string chosenNote(const FileBodies& found, std::size_t index) {
  return "Read solid " + std::to_string(index + 1) + " of " + std::to_string(found.bodies.size()) +
         ", \"" + found.bodies[index].name + "\".";
}

std::string projectName(const FileBody& body, const std::filesystem::path& path) {
  return body.isNamed ? body.name : path.stem().string() + "_" + body.name;
}

SeveralBodies::SeveralBodies(const std::string& prefix, FileBodies found)
    : ModelingError(prefix + "contains " + std::to_string(found.bodies.size()) +
                    " solids, but a project has one body; choose one: " + listText(found.bodies)),
      found_(std::move(found)) {}

void makeNamesUnique(std::vector<FileBody>& bodies) {
  std::vector<std::string> names;
  for (const FileBody& body : bodies) names.push_back(body.name);
  names = uniqueNames(names, "solid");
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].isNamed = !bodies[i].name.empty();
    bodies[i].name = names[i];
  }
}

}  // namespace palpa::modeling
