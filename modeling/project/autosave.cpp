#include "modeling/project/autosave.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <climits>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "modeling/error.h"
#include "modeling/project/atomic_write.h"
#include "modeling/project/json_guard.h"
#include "modeling/project/json_print.h"
#include "modeling/project/process_id.h"
#include "modeling/project/project_file.h"
#include "modeling/project/text_file.h"

namespace palpa::modeling {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using std::chrono::microseconds;
using std::chrono::system_clock;

constexpr const char* kExtension = ".palpa-autosave";
constexpr int kSnapshotVersion = 1;
constexpr JsonLimits kHeaderLimits{64UL << 10, 100, 4};

/// Hash (FNV-1a, 64 bit; Fowler, Noll, Vo) that makes short file names from paths of any length.
std::string hashText(const std::string& text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  std::ostringstream result;
  result << std::hex << hash;
  return result.str();
}

/// A path as text: '%' and bytes beyond ASCII become %XX, because JSON must be UTF-8.
std::string pathText(const fs::path& path) {
  std::string text;
  for (const char c : path.string()) {
    const bool plain = c != '%' && static_cast<unsigned char>(c) < 0x80;
    constexpr const char* kDigits = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(c);
    text += plain ? std::string(1, c) : std::string{'%', kDigits[byte / 16], kDigits[byte % 16]};
  }
  return text;
}

fs::path pathFrom(const std::string& text) {
  std::string path;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned char byte = 0;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(&text[i + 1], &text[i + 3], byte, 16).ec == std::errc()) {
      path += static_cast<char>(byte);
      i += 2;
    } else {
      path += text[i];
    }
  }
  return path;
}

std::string headerText(const Project& project, const fs::path& original, std::uint64_t revision,
                       const ProcessId& process) {
  const auto now = std::chrono::time_point_cast<microseconds>(system_clock::now());
  return jsonText({{"format", "palpa-autosave"},
                   {"version", kSnapshotVersion},
                   {"original", pathText(original)},
                   {"name", project.name},
                   {"time_us", now.time_since_epoch().count()},
                   {"revision", revision},
                   {"process", process.number},
                   {"start", process.start},
                   {"boot", process.boot},
                   {"machine", process.machine}}) +
         "\n";
}

struct Parts {
  Snapshot snapshot;
  ProcessId process;
  std::string project;  // text of the project file
};

std::uint64_t wholeNumber(const json& header, const char* key, std::uint64_t most) {
  const json& value = header.at(key);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most)
    throw ModelingError(std::string(key) + ": expected a whole number up to " +
                        std::to_string(most));
  return value;
}

Parts partsFrom(const fs::path& file, const json& header, std::string project) {
  if (!header.is_object() || header.value("format", json()) != "palpa-autosave")
    throw ModelingError("this is not a snapshot of a project");
  if (header.at("version") != kSnapshotVersion)
    throw ModelingError("this is a snapshot of another version of Palpa");
  const microseconds time(wholeNumber(header, "time_us", INT64_MAX / 1000));
  return {{file, pathFrom(header.at("original")), header.at("name"), system_clock::time_point(time),
           wholeNumber(header, "revision", UINT64_MAX)},
          {static_cast<int>(wholeNumber(header, "process", INT_MAX)),
           wholeNumber(header, "start", UINT64_MAX), header.at("boot"), header.at("machine")},
          std::move(project)};
}

Parts readParts(const fs::path& file) {
  const std::string text = readTextFile(file, kMaxProjectFile + kHeaderLimits.bytes);
  const std::size_t end = std::min(text.find('\n'), text.size());
  const json header =
      parseGuarded(std::string_view(text).substr(0, end), file.string(), kHeaderLimits);
  try {
    return partsFrom(file, header, text.substr(std::min(end + 1, text.size())));
  } catch (const ModelingError& error) {
    throw ModelingError(file.string() + ": " + error.what());
  } catch (const json::exception& error) {
    throw ModelingError(file.string() + ": this is not a snapshot of a project (" + error.what() +
                        ")");
  }
}

/// Time of the last change of a file, on the clock of snapshots.
std::optional<system_clock::time_point> writtenAt(const fs::path& file) {
  std::error_code code;
  const fs::file_time_type time = fs::last_write_time(file, code);
  if (code) return std::nullopt;
  return std::chrono::time_point_cast<system_clock::duration>(
      std::chrono::file_clock::to_sys(time));
}

void list(const fs::path& file, RecoveryList& result) {
  std::error_code code;
  try {
    Parts parts = readParts(file);
    if (isRunning(parts.process)) return;
    parseProject(parts.project, file.string());
    const auto saved = parts.snapshot.original.empty() ? std::nullopt  //
                                                       : writtenAt(parts.snapshot.original);
    (saved && *saved > parts.snapshot.time ? result.outdated : result.snapshots)
        .push_back(std::move(parts.snapshot));
  } catch (const ModelingError& error) {
    // Snapshots that their owners removed meanwhile are no problem.
    if (fs::exists(file, code)) result.problems.emplace_back(error.what());
  }
}

}  // namespace

fs::path defaultAutosaveFolder() {
  const auto absolute = [](const char* name) {
    const char* value = std::getenv(name);
    return value && *value == '/' ? fs::path(value) : fs::path();
  };
  if (const fs::path state = absolute("XDG_STATE_HOME"); !state.empty())
    return state / "palpa" / "autosave";
  const fs::path home = absolute("HOME");
  if (home.empty())
    throw ModelingError("HOME: is not set, so there is no folder for autosaved projects",
                        ModelingError::Kind::kNotFound);
  return home / ".local" / "state" / "palpa" / "autosave";
}

Autosave::Autosave(fs::path folder) : folder_(std::move(folder)) {
  static std::atomic<unsigned> count{0};
  document_ = count++;
}

void Autosave::write(const Project& project, const fs::path& original, std::uint64_t revision) {
  std::error_code code;
  fs::path absolute = original.empty() ? original : fs::absolute(original, code);
  if (code) absolute = original;  // the working folder was removed
  const ProcessId process = thisProcess();
  if (!fs::exists(folder_, code) && fs::create_directories(folder_, code))
    fs::permissions(folder_, fs::perms::owner_all, code);
  if (!fs::is_directory(folder_, code))
    throw ModelingError(folder_.string() + ": cannot be created for autosaved projects",
                        ModelingError::Kind::kIo);
  const fs::path file =
      folder_ / (hashText(absolute.string()) + "-" + std::to_string(process.number) + "-" +
                 std::to_string(process.start) + "-" + std::to_string(document_) + kExtension);
  const std::string text = checkedText(project, file.string());
  writeAtomically(headerText(project, absolute, revision, process) + text, file, {.secret = true});
  if (file_ != file) remove();  // the project has a new name
  file_ = file;
}

void Autosave::remove() noexcept {
  std::error_code code;
  if (!file_.empty()) fs::remove(file_, code);
  file_.clear();
}

RecoveryList findRecoverable(const fs::path& folder) {
  RecoveryList result;
  std::error_code code;
  if (!fs::exists(folder, code) && !code) return result;
  fs::directory_iterator it(folder, code);
  for (; !code && it != fs::directory_iterator(); it.increment(code))
    if (it->path().extension() == kExtension) list(it->path(), result);
  if (code)
    result.problems.push_back(folder.string() + ": cannot be read (" + code.message() + ")");
  const auto latestFirst = [](const Snapshot& a, const Snapshot& b) {
    return std::pair(b.time, a.file) < std::pair(a.time, b.file);
  };
  std::sort(result.snapshots.begin(), result.snapshots.end(), latestFirst);
  std::sort(result.outdated.begin(), result.outdated.end(), latestFirst);
  std::sort(result.problems.begin(), result.problems.end());
  return result;
}

Project recover(const Snapshot& snapshot) {
  const Parts parts = readParts(snapshot.file);
  return parseProject(parts.project, snapshot.file.string());
}

void discard(const Snapshot& snapshot) {
  std::error_code code;
  fs::remove(snapshot.file, code);
  if (code)
    throw ModelingError(snapshot.file.string() + ": cannot be removed (" + code.message() + ")",
                        ModelingError::Kind::kIo);
}

}  // namespace palpa::modeling
