#include "app/core/model/model_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <span>
#include <system_error>

#include "app/core/model/content_hash.h"
#include "base/byte_reader.h"

namespace palpa::app {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kFormat = 2;
constexpr std::size_t kChunk = std::size_t{4} << 20;  // between two looks at the stop token

/// Beginning of a file, in the byte order of the machine.
struct Header {
  ModelMagic magic{};
  std::uint64_t format = kFormat;
  ModelKey key;
  std::uint64_t bytes = 0;     ///< of the rest of the file
  std::uint64_t checksum = 0;  ///< XXH3 of them
};
static_assert(sizeof(Header) == 48);

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
      if (got <= 0) throw DamagedData();
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

void writeTo(const File& file, Header header, const std::function<void(const ByteSink&)>& content,
             const Job& job) {
  file.write(std::as_bytes(std::span(&header, 1)));
  ContentHash hash;
  content([&](std::span<const std::byte> all) {
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
}

}  // namespace

ModelKey keyOfContent(const ContentHash& hash) {
  const XXH128_hash_t value = hash.value();
  return {value.high64, value.low64};
}

void writeModelFile(const fs::path& path, const ModelMagic& magic, const ModelKey& key,
                    const std::function<void(const ByteSink&)>& content, const Job& job) {
  const File file(path, O_WRONLY | O_CREAT | O_EXCL);
  if (!file.isOpen()) throw std::system_error(errno, std::generic_category());
  try {
    writeTo(file, {magic, kFormat, key}, content, job);
  } catch (...) {
    std::error_code ignored;
    fs::remove(path, ignored);
    throw;
  }
}

bool readModelFile(const fs::path& path, const ModelMagic& magic, const ModelKey& key,
                   const std::function<void(const ByteSource&)>& content, const Job& job) {
  const File file(path, O_RDONLY);
  if (!file.isOpen()) return false;
  Header header;
  file.read(std::as_writable_bytes(std::span(&header, 1)));
  struct stat state {};
  if (::fstat(file.descriptor(), &state) != 0 || header.magic != magic ||
      header.format != kFormat || header.key != key ||
      static_cast<std::uint64_t>(state.st_size) != sizeof header + header.bytes)
    throw DamagedData();
  ContentHash hash;
  std::uint64_t done = 0;
  content([&](std::span<std::byte> bytes) {
    if (bytes.size() > header.bytes - done) throw DamagedData();
    inChunks(bytes, job, [&](std::span<std::byte> chunk) {
      file.read(chunk);
      hash.add(chunk.data(), chunk.size());
      done += chunk.size();
      job.report(Phase::kRead, static_cast<double>(done) / static_cast<double>(header.bytes));
    });
  });
  if (done != header.bytes || hash.value().low64 != header.checksum) throw DamagedData();
  return true;
}

}  // namespace palpa::app
