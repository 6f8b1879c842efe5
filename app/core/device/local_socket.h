#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <utility>

#include "app/core/device/device_protocol.h"

namespace palpa::app {

/// Owner of a file descriptor.
class FileDescriptor {
 public:
  explicit FileDescriptor(int number = -1) : number_(number) {}
  ~FileDescriptor();
  FileDescriptor(FileDescriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  int number() const { return number_; }
  bool isOpen() const { return number_ >= 0; }

 private:
  int number_;
};

/// Socket file at which devices connect, for its owner only (mode 0600). Removed by the destructor
/// unless another program has replaced it.
class ListeningSocket {
 public:
  /// Replaces a socket file that a killed program left behind. Throws DeviceError: the path is too
  /// long, is no socket, is in use, or cannot be created.
  explicit ListeningSocket(std::filesystem::path path);
  ~ListeningSocket();
  ListeningSocket(const ListeningSocket&) = delete;
  ListeningSocket& operator=(const ListeningSocket&) = delete;

  const std::filesystem::path& path() const { return path_; }
  int number() const { return socket_.number(); }
  /// The next connection, which does not block; not open if there is none.
  FileDescriptor accept() const;

 private:
  std::filesystem::path path_;
  FileDescriptor socket_;
  unsigned long long device_ = 0, inode_ = 0;  // of the file
};

/// Connects to a listening socket; blocks. Throws DeviceError.
FileDescriptor connectTo(const std::filesystem::path& path);

/// Receives what is there. Returns the number of bytes; nothing if none is there yet; 0 if the
/// other side is gone.
std::optional<std::size_t> receiveSome(const FileDescriptor& socket, std::span<std::byte> into);
/// Sends as much as the system takes, without a signal. Returns the number of bytes; nothing if the
/// other side is gone.
std::optional<std::size_t> sendSome(const FileDescriptor& socket, std::span<const std::byte> bytes);

/// The usual path: palpa/device.sock in $XDG_RUNTIME_DIR, or in a folder of the user's below /tmp.
/// Makes the folder, for its owner only. Throws DeviceError if it belongs to someone else.
std::filesystem::path usualDeviceSocket();

}  // namespace palpa::app
