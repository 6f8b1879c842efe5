#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "modeling/error.h"
#include "modeling/project/json_values.h"
#include "modeling/project/project_file.h"
#include "modeling/text.h"

namespace palpa::modeling {
namespace {

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

namespace {

std::string bodyText(const Solid& solid) {
  return "\"solid\": " + solidText(solid);
}

std::string bodyText(const MeshBody& body) {
  return "\"mesh_body\": " + meshBodyText(body);
}

}  // namespace

std::string toJson(const Project& project) {
  std::string text =
      "{\n  \"format\": \"palpa-project\",\n  \"version\": " + std::to_string(kProjectVersion) +
      ",\n  \"name\": " + quoted(project.name) +
      ",\n  \"material\": " + materialText(project.material) + ",\n  " +
      std::visit([](const auto& body) { return bodyText(body); }, project.body);
  if (project.primitive) text += ",\n  \"primitive\": " + primitiveText(*project.primitive);
  text += ",\n  \"supports\": " + objectsText(project.supports, supportText) +
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
