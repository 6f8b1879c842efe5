#include "app/core/session/import_all.h"

#include <algorithm>
#include <set>

#include "base/atomic_file.h"
#include "modeling/error.h"
#include "modeling/exchange/import.h"
#include "modeling/project/project_file.h"

namespace palpa::app {
namespace {

constexpr std::size_t kMaxNameLength = 100;  // bytes; file systems allow 255

std::string safeName(const std::string& name) {
  std::size_t length = std::min(name.size(), kMaxNameLength);
  // Not within a character of several bytes (UTF-8).
  while (length > 0 && length < name.size() &&
         (static_cast<unsigned char>(name[length]) & 0xC0) == 0x80)
    --length;
  std::string safe = name.substr(0, length);
  for (char& c : safe) {
    const auto code = static_cast<unsigned char>(c);
    if (code < ' ' || code == 127 || std::string_view("/\\:*?\"<>|").find(c) != std::string::npos)
      c = '_';
  }
  return safe.empty() || safe.front() == '.' ? "_" + safe : safe;
}

void replaceAll(std::string& text, std::string_view word, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += by.size())
    text.replace(at, word.size(), by);
}

void makeFolder(const std::filesystem::path& folder) {
  if (folder.empty()) return;
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code) throw FileError(folder.string() + ": cannot be made (" + code.message() + ")");
}

}  // namespace

bool isFilePattern(const std::string& target) {
  return target.find("{number}") != std::string::npos || target.find("{name}") != std::string::npos;
}

std::vector<std::filesystem::path> projectFiles(const modeling::FileBodies& found,
                                                const std::string& target) {
  const std::string pattern =
      isFilePattern(target) ? target : (std::filesystem::path(target) / "{name}.json").string();
  std::set<std::filesystem::path> taken;
  std::vector<std::filesystem::path> files;
  for (std::size_t i = 0; i < found.bodies.size(); ++i) {
    std::string name = pattern;
    replaceAll(name, "{number}", std::to_string(i + 1));
    replaceAll(name, "{name}", safeName(found.bodies[i].name));
    std::filesystem::path file = name;
    for (int next = 2; taken.count(file); ++next) {
      file = name;
      file.replace_filename(file.stem().string() + "_" + std::to_string(next) +
                            file.extension().string());
    }
    taken.insert(file);
    files.push_back(file);
  }
  return files;
}

std::vector<SavedBody> importAll(const std::filesystem::path& path,
                                 const modeling::FileBodies& found, modeling::ImportOptions options,
                                 const std::vector<std::filesystem::path>& files, const Job& job) {
  std::vector<SavedBody> saved;
  for (std::size_t i = 0; i < found.bodies.size(); ++i) {
    makeFolder(files.at(i).parent_path());
    saved.push_back({files[i], ""});
  }
  options.solid.clear();
  const auto take = [&](std::size_t i, modeling::BodyOutcome outcome) {
    saved[i].problem = std::move(outcome.problem);
    if (!outcome.imported) return;
    try {
      const ImportedProject imported =
          makeImportedProject(std::move(*outcome.imported), path, options);
      modeling::checkProject(imported.project);
      modeling::writeProject(imported.project, files[i]);
    } catch (const modeling::ModelingError& error) {
      saved[i].problem = error.what();
    } catch (const FileError& error) {
      saved[i].problem = error.what();
    }
  };
  modeling::importBodies(path, found.bodies.size(), options, take, job);
  return saved;
}

}  // namespace palpa::app
