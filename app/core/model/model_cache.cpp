#include "app/core/model/model_cache.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <vector>

#include "bem/base/instruction_set.h"
#include "bem/dense/make_reference_problem.h"

namespace palpa::app {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kFormat = 1;
constexpr std::array<char, 8> kMagic{'P', 'A', 'L', 'P', 'A', 'M', 'D', 'L'};
constexpr std::size_t kChunk = std::size_t{4} << 20;  // between two looks at the stop token
constexpr double kKeepFree = 1024.0 * 1024.0 * 1024.0;
constexpr const char* kEnding = ".model";

/// Beginning of a file, in the byte order of the machine; the operators and factors follow.
struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint64_t format = kFormat;
  std::uint64_t keyHigh = 0, keyLow = 0;
  std::uint64_t bytes = 0;     ///< of the rest of the file
  std::uint64_t checksum = 0;  ///< XXH3 of them
};
static_assert(sizeof(Header) == 48);

/// Thrown if a file is not as it was written.
struct Damaged {};

class Hash {
 public:
  Hash() : state_(XXH3_createState()) {
    if (!state_) throw std::bad_alloc();
    XXH3_128bits_reset(state_.get());
  }
  void add(const void* data, std::size_t bytes) { XXH3_128bits_update(state_.get(), data, bytes); }
  template <class T>
  void addValue(const T& value) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    add(&value, sizeof value);
  }
  template <class T>
  void addList(const std::vector<T>& list) {
    addValue(list.size());
    add(list.data(), list.size() * sizeof(T));
  }
  XXH128_hash_t value() const { return XXH3_128bits_digest(state_.get()); }

 private:
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> state_;
};

class File {
 public:
  File(const fs::path& path, int flags)
      : descriptor_(::open(path.c_str(), flags | O_CLOEXEC, 0600)) {}
  ~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  bool isOpen() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }

  void read(std::span<std::byte> into) const {
    while (!into.empty()) {
      const ssize_t got = ::read(descriptor_, into.data(), into.size());
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) throw Damaged{};
      into = into.subspan(static_cast<std::size_t>(got));
    }
  }
  void write(std::span<const std::byte> from) const {
    while (!from.empty()) {
      const ssize_t done = ::write(descriptor_, from.data(), from.size());
      if (done < 0 && errno == EINTR) continue;
      if (done < 0) throw std::system_error(errno, std::generic_category());
      from = from.subspan(static_cast<std::size_t>(done));
    }
  }

 private:
  int descriptor_;
};

template <class Span, class Work>
void inChunks(Span bytes, const Job& job, const Work& work) {
  while (!bytes.empty()) {
    job.throwIfCancelled();
    const Span chunk = bytes.first(std::min(kChunk, bytes.size()));
    work(chunk);
    bytes = bytes.subspan(chunk.size());
  }
}

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
void addProgram(Hash& hash) {
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
  Hash hash;
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
  hash.addValue(bem::choosePrecision(inputs.precision, discretisation.displacementCount()));
  const XXH128_hash_t value = hash.value();
  return {value.high64, value.low64};
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
  const File file(path, O_RDONLY);
  if (!file.isOpen()) return nullptr;
  try {
    Header header;
    file.read(std::as_writable_bytes(std::span(&header, 1)));
    struct stat state {};
    if (::fstat(file.descriptor(), &state) != 0 || header.magic != kMagic ||
        header.format != kFormat || Key{header.keyHigh, header.keyLow} != key ||
        static_cast<std::uint64_t>(state.st_size) != sizeof header + header.bytes)
      throw Damaged{};
    Hash hash;
    std::uint64_t done = 0;
    auto problem =
        bem::readDenseReferenceProblem(discretisation, inputs, [&](std::span<std::byte> bytes) {
          if (bytes.size() > header.bytes - done) throw Damaged{};
          inChunks(bytes, job, [&](std::span<std::byte> chunk) {
            file.read(chunk);
            hash.add(chunk.data(), chunk.size());
            done += chunk.size();
            job.report(Phase::kRead, static_cast<double>(done) / static_cast<double>(header.bytes));
          });
        });
    if (done != header.bytes || hash.value().low64 != header.checksum) throw Damaged{};
    ::futimens(file.descriptor(), nullptr);  // without permission the file only ages sooner
    return problem;
  } catch (const Damaged&) {
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
    const File file(part, O_WRONLY | O_CREAT | O_EXCL);
    if (!file.isOpen()) throw std::system_error(errno, std::generic_category());
    temporary = part;
    Header header;
    header.keyHigh = key.high;
    header.keyLow = key.low;
    file.write(std::as_bytes(std::span(&header, 1)));
    Hash hash;
    problem.write([&](std::span<const std::byte> all) {
      inChunks(all, job, [&](std::span<const std::byte> chunk) {
        file.write(chunk);
        hash.add(chunk.data(), chunk.size());
        header.bytes += chunk.size();
      });
    });
    header.checksum = hash.value().low64;
    if (::lseek(file.descriptor(), 0, SEEK_SET) != 0)
      throw std::system_error(errno, std::generic_category());
    file.write(std::as_bytes(std::span(&header, 1)));
    fs::rename(temporary, path);
    setTrouble({});
    return true;
  } catch (const Cancelled&) {
    fs::remove(temporary, error);
    throw;
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
