#include "app/core/device/local_socket.h"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>

namespace palpa::app {
namespace {

namespace fs = std::filesystem;

std::string systemError() {
  return std::strerror(errno);
}

sockaddr_un addressOf(const fs::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string text = path.string();
  if (text.empty() || text.size() >= sizeof address.sun_path)
    throw DeviceError(text + ": the name of a socket must have 1 to " +
                      std::to_string(sizeof address.sun_path - 1) +
                      " bytes; choose another folder");
  std::memcpy(address.sun_path, text.data(), text.size());
  return address;
}

const sockaddr* generic(const sockaddr_un& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

FileDescriptor makeSocket(const fs::path& path) {
  FileDescriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (!socket.isOpen()) throw DeviceError(path.string() + ": no socket: " + systemError());
  return socket;
}

/// Removes the socket file of a program that was killed.
void removeStale(const fs::path& path, const sockaddr_un& address) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0) return;
  if (!S_ISSOCK(found.st_mode))
    throw DeviceError(path.string() +
                      ": this file exists and is no socket; remove it, or choose another name");
  const FileDescriptor probe = makeSocket(path);
  if (::connect(probe.number(), generic(address), sizeof address) == 0)
    throw DeviceError(path.string() +
                      ": another Palpa listens for a device here; end it, or choose another name");
  if (errno == ECONNREFUSED) ::unlink(path.c_str());
}

}  // namespace

FileDescriptor::~FileDescriptor() {
  if (number_ >= 0) ::close(number_);
}

ListeningSocket::ListeningSocket(fs::path path) : path_(std::move(path)) {
  const sockaddr_un address = addressOf(path_);
  removeStale(path_, address);
  socket_ = makeSocket(path_);
  const auto fail = [this] {
    throw DeviceError(path_.string() + ": cannot listen for a device here: " + systemError() +
                      "; choose another folder");
  };
  if (::bind(socket_.number(), generic(address), sizeof address) != 0) fail();
  // Nobody can connect before listen(), so there is no moment with wider permissions.
  struct stat made {};
  if (::chmod(path_.c_str(), S_IRUSR | S_IWUSR) != 0 || ::listen(socket_.number(), 4) != 0 ||
      ::stat(path_.c_str(), &made) != 0) {
    const int error = errno;
    ::unlink(path_.c_str());
    errno = error;
    fail();
  }
  device_ = made.st_dev;
  inode_ = made.st_ino;
}

ListeningSocket::~ListeningSocket() {
  struct stat found {};
  if (::lstat(path_.c_str(), &found) == 0 && found.st_dev == device_ && found.st_ino == inode_)
    ::unlink(path_.c_str());
}

FileDescriptor ListeningSocket::accept() const {
  return FileDescriptor(
      ::accept4(socket_.number(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
}

FileDescriptor connectTo(const fs::path& path) {
  const sockaddr_un address = addressOf(path);
  FileDescriptor socket = makeSocket(path);
  if (::connect(socket.number(), generic(address), sizeof address) != 0)
    throw DeviceError(path.string() + ": no Palpa listens here: " + systemError());
  return socket;
}

std::optional<std::size_t> receiveSome(const FileDescriptor& socket, std::span<std::byte> into) {
  const ssize_t count = ::recv(socket.number(), into.data(), into.size(), 0);
  if (count >= 0) return static_cast<std::size_t>(count);
  if (errno == EAGAIN || errno == EINTR) return std::nullopt;
  return 0;
}

std::optional<std::size_t> sendSome(const FileDescriptor& socket,
                                    std::span<const std::byte> bytes) {
  const ssize_t count = ::send(socket.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  if (count >= 0) return static_cast<std::size_t>(count);
  if (errno == EAGAIN || errno == EINTR) return 0;
  return std::nullopt;
}

fs::path usualDeviceSocket() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  const fs::path folder = runtime && *runtime != '\0'
                              ? fs::path(runtime) / "palpa"
                              : fs::path("/tmp") / ("palpa-" + std::to_string(::getuid()));
  if (::mkdir(folder.c_str(), S_IRWXU) != 0 && errno != EEXIST)
    throw DeviceError(folder.string() + ": cannot make the folder for the socket: " +
                      systemError() + "; set XDG_RUNTIME_DIR to a folder of yours");
  struct stat found {};
  if (::lstat(folder.c_str(), &found) != 0 || !S_ISDIR(found.st_mode) ||
      found.st_uid != ::getuid() || (found.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    throw DeviceError(folder.string() +
                      ": others can use this folder, so it is not safe for a socket; remove it, or "
                      "set XDG_RUNTIME_DIR to a folder of yours");
  return folder / "device.sock";
}

}  // namespace palpa::app
