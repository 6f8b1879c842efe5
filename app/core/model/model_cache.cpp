#include "app/core/model/model_cache.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <system_error>
#include <vector>

#include "app/core/model/content_hash.h"
#include "base/byte_reader.h"
#include "bem/base/instruction_set.h"
#include "bem/compressed/make_problem.h"

namespace palpa::app {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kFormat = 2;
constexpr ModelMagic kMagic{'P', 'A', 'L', 'P', 'A', 'M', 'D', 'L'};
constexpr double kKeepFree = 1024.0 * 1024.0 * 1024.0;
constexpr const char* kEnding = ".model";

bool isModel(const fs::path& path) {
  return path.extension() == kEnding;
}

struct Stored {
  fs::path path;
  fs::file_time_type used;
  double bytes;
};

/// Files that other processes remove meanwhile are left out.
std::vector<Stored> filesIn(const fs::path& folder) {
  std::vector<Stored> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code gone;
    const auto used = fs::last_write_time(it->path(), gone);
    if (gone) continue;
    const auto bytes = static_cast<double>(fs::file_size(it->path(), gone));
    if (!gone) files.push_back({it->path(), used, bytes});
  }
  return files;
}

/// Makes keys of another build of the program differ: its size and time stand for its code.
void addProgram(ContentHash& hash) {
  std::error_code error;
  const fs::path program = "/proc/self/exe";
  const auto size = fs::file_size(program, error);
  const auto time = fs::last_write_time(program, error).time_since_epoch().count();
  hash.addValue(size);
  hash.addValue(time);
}

/// Unique among the threads of this process.
std::string temporaryName() {
  static std::atomic<unsigned> count{0};
  return std::to_string(::getpid()) + "-" + std::to_string(count++) + ".tmp";
}

}  // namespace

ModelCache::ModelCache(fs::path folder, double limit) : folder_(std::move(folder)), limit_(limit) {}

ModelCache::Key ModelCache::keyOf(const bem::Discretisation& discretisation,
                                  const bem::ProblemInputs& inputs) {
  ContentHash hash;
  hash.addValue(kFormat);
  addProgram(hash);
  const std::string instructions = bem::instructionSetName();
  hash.addValue(instructions.size());
  hash.add(instructions.data(), instructions.size());
  discretisation.write(
      [&](std::span<const std::byte> bytes) { hash.add(bytes.data(), bytes.size()); });
  hash.addList(inputs.conditions);
  const auto& [youngsModulus, poissonRatio] = inputs.material;  // all fields
  hash.addValue(youngsModulus);
  hash.addValue(poissonRatio);
  hash.addValue(inputs.assembly.tolerance);
  hash.addValue(bem::effectivePrecision(discretisation, inputs.precision));
  return keyOfContent(hash);
}

fs::path ModelCache::fileOf(const Key& key) const {
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), "%016llx%016llx%s",
                static_cast<unsigned long long>(key.high), static_cast<unsigned long long>(key.low),
                kEnding);
  return folder_ / name.data();
}

std::unique_ptr<bem::ReferenceProblem> ModelCache::read(const Key& key,
                                                        const bem::Discretisation& discretisation,
                                                        const bem::ProblemInputs& inputs,
                                                        const Job& job, std::string& notice) {
  const fs::path path = fileOf(key);
  std::unique_ptr<bem::ReferenceProblem> problem;
  try {
    if (!readModelFile(
            path, kMagic, key,
            [&](const ByteSource& source) {
              problem = bem::readReferenceProblem(discretisation, inputs, source);
            },
            job))
      return nullptr;
    // Without permission the file only ages sooner.
    ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0);
    return problem;
  } catch (const DamagedData&) {
    std::error_code error;
    notice = fs::remove(path, error)
                 ? "a stored model was damaged; it was deleted and computed again"
                 : "a stored model is damaged and was computed again; it cannot be deleted in " +
                       folder_.string();
    return nullptr;
  }
}

bool ModelCache::write(const Key& key, const bem::ReferenceProblem& problem, const Job& job) {
  const fs::path path = fileOf(key);
  std::error_code error;
  // bytes() leaves out pivots and a norm.
  const double bytes = static_cast<double>(problem.bytes()) + 8.0 * problem.dofs().count() + 4096;
  if (bytes > limit_ || fs::exists(path, error)) return true;
  fs::path temporary;
  try {
    if (fs::create_directories(folder_)) fs::permissions(folder_, fs::perms::owner_all);
    if (static_cast<double>(fs::space(folder_).available) < bytes + kKeepFree) return true;
    trim(limit_ - bytes);
    const fs::path part = folder_ / temporaryName();
    writeModelFile(
        part, kMagic, key, [&](const ByteSink& sink) { problem.write(sink); }, job);
    temporary = part;
    fs::rename(temporary, path);
    setTrouble({});
    return true;
  } catch (const std::system_error& failure) {
    if (!temporary.empty()) fs::remove(temporary, error);
    setTrouble("models cannot be stored in " + folder_.string() + ": " + failure.code().message());
    return false;
  }
}

void ModelCache::trim(double most) const {
  std::vector<Stored> files = filesIn(folder_);
  std::sort(files.begin(), files.end(),
            [](const Stored& a, const Stored& b) { return a.used < b.used; });
  std::error_code error;
  double total = 0;
  for (const Stored& file : files) {
    // Left behind by a process that crashed while it wrote.
    if (file.path.extension() == ".tmp" &&
        file.used < fs::file_time_type::clock::now() - std::chrono::hours(1))
      fs::remove(file.path, error);
    if (isModel(file.path)) total += file.bytes;
  }
  for (const Stored& file : files) {
    if (total <= most) return;
    if (isModel(file.path) && fs::remove(file.path, error)) total -= file.bytes;
  }
}

void ModelCache::setLimit(double bytes) {
  limit_ = bytes;
  trim(bytes);
}

double ModelCache::size() const {
  double total = 0;
  for (const Stored& file : filesIn(folder_))
    if (isModel(file.path)) total += file.bytes;
  return total;
}

void ModelCache::clear() {
  trim(-1);
}

std::string ModelCache::trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

void ModelCache::setTrouble(std::string trouble) {
  const std::lock_guard lock(mutex_);
  trouble_ = std::move(trouble);
}

fs::path defaultCacheFolder() {
  const auto absolute = [](const char* variable) {
    const char* value = std::getenv(variable);
    const fs::path path = value ? value : "";
    return path.is_absolute() ? path : fs::path();
  };
  if (const fs::path cache = absolute("XDG_CACHE_HOME"); !cache.empty()) return cache / "palpa";
  const fs::path home = absolute("HOME");
  return home.empty() ? fs::path() : home / ".cache" / "palpa";
}

}  // namespace palpa::app
