#include "base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <optional>
#include <system_error>

namespace palpa {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxNameLength = 255;  // bytes, on all common file systems
constexpr std::string_view kFreshEnd = ".palpa-new";

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw FileError(path.string() + ": cannot be written (" + what +
                  "); an existing file is unchanged");
}

[[noreturn]] void fail(const fs::path& path, int error) {
  fail(path, std::generic_category().message(error));
}

/// The first `most` bytes of a name or fewer, without cutting a UTF-8 character.
std::string shortened(const std::string& name, std::size_t most) {
  if (name.size() <= most) return name;
  while (most > 0 && (static_cast<unsigned char>(name[most]) & 0xC0U) == 0x80U) --most;
  return name.substr(0, most);
}

/// The file behind symbolic links. It need not exist.
fs::path behindLinks(const fs::path& path) {
  constexpr int kMaxLinks = 40;
  fs::path target = path;
  std::error_code code;
  for (int i = 0; i < kMaxLinks && fs::is_symlink(target, code); ++i) {
    const fs::path next = fs::read_symlink(target, code);
    if (code) fail(path, code.value());
    target = target.parent_path() / next;  // an absolute link replaces the whole path
  }
  if (fs::is_symlink(target, code)) fail(path, ELOOP);
  return target;
}

/// State of the old file, if there is one. Throws FileError if it must not be replaced.
std::optional<struct stat> oldFile(const fs::path& path) {
  struct stat state {};
  if (::stat(path.c_str(), &state) != 0) {
    if (errno == ENOENT) return std::nullopt;
    fail(path, errno);
  }
  if (S_ISDIR(state.st_mode)) fail(path, EISDIR);
  if (!S_ISREG(state.st_mode)) fail(path, "this is not a file");
  if (::access(path.c_str(), W_OK) != 0) fail(path, errno);
  return state;
}

fs::path folderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// Beginning of the names of hidden files for this target. Targets with long names may have the
/// same beginning, which is harmless.
std::string freshStart(const fs::path& path) {
  return "." + shortened(path.filename().string(), 100) + ".";
}

void removeLeftovers(const fs::path& path) {
  const std::string start = freshStart(path);
  std::error_code code;
  for (auto it = fs::directory_iterator(folderOf(path), code);
       !code && it != fs::directory_iterator(); it.increment(code)) {
    const std::string name = it->path().filename().string();
    if (!name.starts_with(start) || !name.ends_with(kFreshEnd)) continue;
    std::error_code ignored;  // another process may have removed it
    const auto written = fs::last_write_time(it->path(), ignored);
    if (!ignored && fs::file_time_type::clock::now() - written > std::chrono::hours(24))
      fs::remove(it->path(), ignored);
  }
}

fs::path freshName(const fs::path& target) {
  static std::atomic<unsigned> count{0};
  return folderOf(target) / (freshStart(target) + std::to_string(::getpid()) + "-" +
                             std::to_string(count++) + std::string(kFreshEnd));
}

/// Flushes a file; returns 0 or the error. Ignores EINVAL, with which some network and user-space
/// file systems refuse flushing.
int flushed(int file) {
  return ::fsync(file) == 0 || errno == EINVAL || errno == ENOTSUP ? 0 : errno;
}

/// Returns 0 or the error.
int fill(int file, std::string_view text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(file, text.data() + done, text.size() - done);
    if (written > 0)
      done += static_cast<std::size_t>(written);
    else if (written == 0)
      return ENOSPC;
    else if (errno != EINTR)
      return errno;
  }
  return 0;
}

/// Gives a file the permissions and, if possible, the group of the old file, and flushes it;
/// returns 0 or the error.
int finish(const fs::path& path, const std::optional<struct stat>& old) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return errno;
  int error = 0;
  if (old) {
    // The group first, because changing it clears the set-group bit. If it cannot be changed, the
    // group permissions would apply to a different group and are dropped.
    const bool sameGroup = ::fchown(file, static_cast<uid_t>(-1), old->st_gid) == 0;
    const mode_t keep = sameGroup ? 07777 : 07707;
    if (::fchmod(file, old->st_mode & keep) != 0) error = errno;
  }
  if (error == 0) error = flushed(file);
  ::close(file);
  return error;
}

/// Gives the old file the name of the backup, which replaces an older backup in one step.
void keepBackup(const fs::path& target) {
  const fs::path backup = backupPath(target);
  const auto failed = [&](const std::string& what) {
    fail(target, "its backup " + backup.string() + " cannot be made: " + what);
  };
  std::error_code code;
  if (fs::is_directory(backup, code)) failed("there is a folder of that name");
  const fs::path fresh = freshName(backup);
  const auto discard = [&](const std::string& what) {
    std::error_code ignored;
    fs::remove(fresh, ignored);
    failed(what);
  };
  fs::create_hard_link(target, fresh, code);
  if (code) {  // no hard links on this file system
    fs::copy_file(target, fresh, code);
    if (code) discard(code.message());
    if (const int error = finish(fresh, std::nullopt); error != 0)
      discard(std::generic_category().message(error));
  }
  if (std::rename(fresh.c_str(), backup.c_str()) != 0)
    discard(std::generic_category().message(errno));
  // A rename between two names of one file does nothing.
  fs::remove(fresh, code);
}

void flushFolder(const fs::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;  // the content is on the disk; a crash can only lose the rename
  ::fsync(file);
  ::close(file);
}

}  // namespace

fs::path backupPath(const fs::path& path) {
  const fs::path target = behindLinks(path);
  return target.parent_path() /
         (shortened(target.filename().string(), kMaxNameLength - 4) + ".bak");
}

AtomicFile::AtomicFile(const fs::path& path, AtomicWriteOptions options)
    : path_(path), options_(options) {
  if (!path.has_filename()) fail(path, "there is no file name");
  target_ = behindLinks(path);
  oldFile(target_);
  fresh_ = freshName(target_);
  ::unlink(fresh_.c_str());  // of an earlier process with the same number
}

AtomicFile::~AtomicFile() {
  if (!fresh_.empty()) ::unlink(fresh_.c_str());
}

void AtomicFile::write(std::string_view text) {
  const int file = ::open(fresh_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC,
                          options_.secret ? 0600 : 0666);
  if (file < 0) fail(path_, errno);
  int error = fill(file, text);
  if (::close(file) != 0 && error == 0) error = errno;
  if (error != 0) fail(path_, error);
}

void AtomicFile::commit() {
  const std::optional<struct stat> old = oldFile(target_);
  if (const int error = finish(fresh_, old); error != 0) fail(path_, error);
  // The backup is a second name of the old file until the rename replaces the first one: the target
  // is a complete file at every moment.
  if (old && options_.backup) keepBackup(target_);
  if (std::rename(fresh_.c_str(), target_.c_str()) != 0) fail(path_, errno);
  fresh_.clear();
  flushFolder(folderOf(target_));
  removeLeftovers(target_);
}

void replaceFile(std::string_view text, const fs::path& path, AtomicWriteOptions options) {
  AtomicFile file(path, options);
  file.write(text);
  file.commit();
}

}  // namespace palpa
