#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.h"

namespace palpa {

/// A file could not be written. The message names the file and the cause.
class FileError : public Error {
 public:
  using Error::Error;
};

/// Options of AtomicFile.
struct AtomicWriteOptions {
  bool backup = false;  ///< keep the old file as backupPath()
  bool secret = false;  ///< a new file is readable by its owner only
};

/// Replacement of a file, or a new file. At every moment, even after a power loss, the target's
/// name refers to the complete old or the complete new content: the content goes to a hidden file
/// beside the target, which commit() flushes to the disk and renames. The destructor removes a
/// hidden file that was not committed.
///
/// Symbolic links are followed and remain. The new file has the permissions and, if the system
/// allows it, the group of the old file. Hidden files of killed processes beside the target are
/// removed after a day.
///
/// All functions throw FileError if writing fails or the target is read-only, a folder or a device;
/// then the old file is unchanged.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path, AtomicWriteOptions options = {});
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Name of the hidden file, for libraries that write by name. It does not exist yet.
  const std::filesystem::path& freshPath() const { return fresh_; }
  /// Writes the whole content; not after another program or library has written freshPath().
  void write(std::string_view content);
  void commit();

 private:
  std::filesystem::path path_;    // as given, for messages
  std::filesystem::path target_;  // behind symbolic links
  std::filesystem::path fresh_;   // empty after commit()
  AtomicWriteOptions options_;
};

/// Replaces the content of a file or creates the file, as AtomicFile does.
void replaceFile(std::string_view content, const std::filesystem::path& path,
                 AtomicWriteOptions options = {});

/// Path of the backup: `<path>.bak`, with symbolic links resolved; too long names are shortened.
std::filesystem::path backupPath(const std::filesystem::path& path);

}  // namespace palpa
