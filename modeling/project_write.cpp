#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "modeling/error.h"
#include "modeling/project_file.h"
#include "modeling/text.h"

namespace palpa::modeling {
namespace {

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// "[a, b, c]" from any list, each element through `text`.
template <class List, class Text>
std::string listText(const List& list, Text text) {
  std::string result = "[";
  for (const auto& element : list) result += (result.size() > 1 ? ", " : "") + text(element);
  return result + "]";
}

std::string vectorText(const Eigen::Vector3d& v) {
  return "[" + numberText(v.x()) + ", " + numberText(v.y()) + ", " + numberText(v.z()) + "]";
}

/// "[" + one element per line + "]" at the given indentation.
std::string linesText(const std::vector<std::string>& lines, const std::string& indent) {
  if (lines.empty()) return "[]";
  std::string result = "[\n";
  for (std::size_t i = 0; i < lines.size(); ++i)
    result += indent + "  " + lines[i] + (i + 1 < lines.size() ? ",\n" : "\n");
  return result + indent + "]";
}

std::string partText(const RegionPart& part) {
  if (const auto* half = std::get_if<HalfSpace>(&part))
    return "{\"half_space\": {\"normal\": " + vectorText(half->normal) +
           ", \"below_mm\": " + numberText(half->below) + "}}";
  return "{\"patches\": " + listText(std::get<PatchSet>(part).patches, quoted) + "}";
}

std::string regionText(const Region& region) {
  return region.parts.size() == 1 ? partText(region.parts.front())
                                  : listText(region.parts, partText);
}

std::string solidText(const Solid& solid) {
  std::vector<std::string> points;
  for (const Eigen::Vector3d& point : solid.controlPoints()) points.push_back(vectorText(point));
  std::vector<std::string> patches;
  for (const Patch& patch : solid.patches()) {
    std::vector<std::string> rows;
    for (const auto& row : patch.net)
      rows.push_back(listText(row, [](int index) { return std::to_string(index); }));
    patches.push_back(
        "{\n        \"name\": " + quoted(patch.name) + ",\n        \"degree\": [" +
        std::to_string(patch.degree[0]) + ", " + std::to_string(patch.degree[1]) +
        "],\n        \"knots\": [\n          " + listText(patch.knots[0], numberText) +
        ",\n          " + listText(patch.knots[1], numberText) +
        "\n        ],\n        \"net\": " + linesText(rows, "        ") + "\n      }");
  }
  return "{\n    \"control_points_mm\": " + linesText(points, "    ") +
         ",\n    \"patches\": " + linesText(patches, "    ") + "\n  }";
}

std::string supportText(const Support& support) {
  std::string text = "{\"name\": " + quoted(support.name) + ", \"kind\": " +
                     (support.kind == Support::Kind::fixed ? "\"fixed\"" : "\"roller\"") +
                     ", \"where\": " + regionText(support.where);
  if (support.displacement != Eigen::Vector3d::Zero())
    text += ", \"displacement_mm\": " + vectorText(support.displacement);
  return text + "}";
}

std::string loadBody(const Pressure& load) {
  return "\"pressure\", \"where\": " + regionText(load.where) +
         ", \"MPa\": " + numberText(load.pressure);
}

std::string loadBody(const UniformTraction& load) {
  return "\"traction\", \"where\": " + regionText(load.where) +
         ", \"MPa\": " + vectorText(load.traction);
}

std::string loadBody(const Bump& load) {
  return "\"bump\", \"center_mm\": " + vectorText(load.center) +
         ", \"radius_mm\": " + numberText(load.radius) +
         ", \"peak_MPa\": " + numberText(load.peak) +
         ", \"direction\": " + vectorText(load.direction);
}

std::string loadText(const Load& load) {
  return "{\"name\": " + quoted(load.name) +
         ", \"kind\": " + std::visit([](const auto& what) { return loadBody(what); }, load.what) +
         "}";
}

std::string touchText(const Touch& touch) {
  std::string text = "{\"name\": " + quoted(touch.name) +
                     ", \"kind\": \"grab\", \"at_mm\": " + vectorText(touch.at);
  if (const auto* moved = std::get_if<TouchDisplacement>(&touch.action))
    text += ", \"displace_mm\": " + vectorText(moved->vector);
  else
    text += ", \"force_N\": " + vectorText(std::get<TouchForce>(touch.action).vector);
  if (touch.radius) text += ", \"radius_mm\": " + numberText(*touch.radius);
  return text + "}";
}

std::string meshText(const MeshSettings& mesh) {
  std::string text = "{\"edge_length_mm\": " + numberText(mesh.edgeLength);
  if (mesh.refinementLevels > 0 || mesh.refineAtSharpEdges || mesh.refineAtBorders) {
    std::vector<std::string> at;
    if (mesh.refineAtSharpEdges) at.push_back("sharp_edges");
    if (mesh.refineAtBorders) at.push_back("support_borders");
    text += ", \"refinement\": {\"levels\": " + std::to_string(mesh.refinementLevels) +
            ", \"at\": " + listText(at, quoted) + "}";
  }
  return text + "}";
}

template <class T, class Text>
std::string objectsText(const std::vector<T>& list, Text text) {
  std::vector<std::string> lines;
  for (const T& one : list) lines.push_back(text(one));
  return linesText(lines, "  ");
}

[[noreturn]] void failWriting(const std::filesystem::path& path, int error) {
  throw ModelingError(path.string() + ": cannot be written (" + std::strerror(error) +
                          "); the old file, if any, is unchanged",
                      ModelingError::Kind::io);
}

/// Writes a new file and waits until it is on the disk; removes it again on failure.
void writeDurably(const std::string& text, const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) failWriting(path, errno);
  std::size_t done = 0;
  int error = 0;
  while (done < text.size() && error == 0) {
    const ssize_t written = ::write(file, text.data() + done, text.size() - done);
    if (written >= 0)
      done += static_cast<std::size_t>(written);
    else if (errno != EINTR)
      error = errno;
  }
  if (error == 0 && ::fsync(file) != 0) error = errno;
  if (::close(file) != 0 && error == 0) error = errno;
  if (error == 0) return;
  ::unlink(path.c_str());
  failWriting(path, error);
}

void syncFolder(const std::filesystem::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;  // the content is safe already; only the rename may be lost in a crash
  ::fsync(file);
  ::close(file);
}

}  // namespace

std::string toJson(const Project& project) {
  std::string text =
      "{\n  \"format\": \"palpa-project\",\n  \"version\": " + std::to_string(kProjectVersion) +
      ",\n  \"name\": " + quoted(project.name) +
      ",\n  \"material\": {\"name\": " + quoted(project.material.name) +
      ", \"youngs_modulus_MPa\": " + numberText(project.material.youngsModulus) +
      ", \"poisson_ratio\": " + numberText(project.material.poissonRatio) +
      "},\n  \"solid\": " + solidText(project.solid) +
      ",\n  \"supports\": " + objectsText(project.supports, supportText) +
      ",\n  \"loads\": " + objectsText(project.loads, loadText) +
      ",\n  \"touches\": " + objectsText(project.touches, touchText) +
      ",\n  \"mesh\": " + meshText(project.mesh);
  if (!project.view.empty()) text += ",\n  \"view\": " + project.view;
  return text + "\n}\n";
}

void writeProject(const Project& project, const std::filesystem::path& path) {
  checkProject(project);
  const std::string text = toJson(project);
  std::filesystem::path fresh = path;
  fresh += ".new";
  std::filesystem::path backup = path;
  backup += ".bak";
  writeDurably(text, fresh);
  // The backup is a second name of the old file until the rename replaces the first one: at no
  // moment is there no complete file under the project's name.
  std::error_code code;
  if (std::filesystem::exists(path, code)) {
    std::filesystem::remove(backup, code);
    std::filesystem::create_hard_link(path, backup, code);
    if (code)
      std::filesystem::copy_file(path, backup, std::filesystem::copy_options::overwrite_existing,
                                 code);
  }
  std::filesystem::rename(fresh, path, code);
  if (code) {
    const int error = code.value();
    std::filesystem::remove(fresh, code);
    failWriting(path, error);
  }
  syncFolder(path.has_parent_path() ? path.parent_path() : ".");
}

}  // namespace palpa::modeling
