#include "app/core/device/device_server.h"

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>

#include "app/core/system/priority.h"
#include "base/unexpected.h"

namespace palpa::app {
namespace {

using Clock = TouchLoop::Clock;

constexpr int kCheckMs = 20;  // interval of the checks for silence
/// A device that leaves so many bytes unread, a second's forces, is disconnected.
constexpr std::size_t kMaxUnsent = 1000 * kDeviceMessageSize;

}  // namespace

DeviceServer::DeviceServer(DeviceTarget& target, const bem::ContactTool& tool,
                           const std::filesystem::path& socket, std::function<void()> changed)
    : target_(target),
      listener_(socket),
      wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      changed_(std::move(changed)),
      tool_(tool),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

DeviceServer::~DeviceServer() {
  thread_.request_stop();
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(wake_.number(), &one, sizeof one);
  thread_.join();
}

DeviceServer::Status DeviceServer::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void DeviceServer::setTool(const bem::ContactTool& tool) {
  const std::lock_guard lock(mutex_);
  tool_ = tool;
}

void DeviceServer::change(const std::function<void(Status&)>& edit) {
  {
    const std::lock_guard lock(mutex_);
    edit(status_);
  }
  if (changed_) changed_();
}

void DeviceServer::run(const std::stop_token& stop) {
  ::pthread_setname_np(::pthread_self(), "palpa-device");
  RealtimeScope realtime;
  while (!stop.stop_requested()) {
    std::array<pollfd, 3> waited{pollfd{listener_.number(), POLLIN, 0},
                                 pollfd{wake_.number(), POLLIN, 0}, pollfd{-1, POLLIN, 0}};
    if (client_) {
      waited[2].fd = client_->socket.number();
      if (!client_->unsent.empty()) waited[2].events |= POLLOUT;
    }
    ::poll(waited.data(), waited.size(), client_ ? kCheckMs : -1);
    const auto began = Clock::now();
    try {
      if ((waited[0].revents & POLLIN) != 0) welcomeNext();
      if (client_ && waited[2].fd >= 0) serve(waited[2].revents);
      if (client_) client_->session.check(Clock::now());
    } catch (const DeviceError& error) {
      dismiss(error);
    } catch (...) {
      reportUnexpected();
      dismiss(DeviceError("device: Palpa had an internal error", DeviceErrorCode::kClosing));
    }
    realtime.worked(began, Clock::now());
  }
  if (client_) dismiss(DeviceError("Palpa stops listening for devices", DeviceErrorCode::kClosing));
}

void DeviceServer::welcomeNext() {
  FileDescriptor socket = listener_.accept();
  if (!socket.isOpen()) return;
  if (client_) {
    // A new socket takes a short message at once; whether it arrives does not matter.
    sendSome(socket, encodeDeviceError(DeviceErrorCode::kBusy,
                                       "another device is connected to this Palpa; end it first"));
    return;
  }
  bem::ContactTool tool;
  {
    const std::lock_guard lock(mutex_);
    tool = tool_;
  }
  // The session cannot be moved.
  client_.reset(new Client{std::move(socket), DeviceSession(target_, tool, Clock::now()), {}});
}

void DeviceServer::serve(short events) {
  if ((events & (POLLIN | POLLHUP | POLLERR)) != 0) {
    std::array<std::byte, 64 * kDeviceMessageSize> bytes;
    const auto count = receiveSome(client_->socket, bytes);
    const auto arrived = Clock::now();
    if (count == 0) {
      leave("");
      return;
    }
    DeviceSession& session = client_->session;
    const bool wasGreeted = session.isGreeted();
    const std::uint64_t before = session.positions();
    if (count) session.receive(std::span(bytes).first(*count), arrived, client_->unsent);
    if (!wasGreeted && session.isGreeted())
      change([](Status& status) {
        status.isConnected = true;
        ++status.devices;
        status.error.clear();
      });
    flush();
    if (!client_) return;
    if (const std::uint64_t news = session.positions() - before; news > 0) {
      latency_.add(Clock::now() - arrived);
      const std::lock_guard lock(mutex_);
      status_.positions += news;
    }
  } else if ((events & POLLOUT) != 0) {
    flush();
  }
}

void DeviceServer::flush() {
  std::vector<std::byte>& unsent = client_->unsent;
  if (unsent.empty()) return;
  const auto sent = sendSome(client_->socket, unsent);
  if (!sent) {
    leave("");
    return;
  }
  unsent.erase(unsent.begin(), unsent.begin() + static_cast<std::ptrdiff_t>(*sent));
  if (unsent.size() > kMaxUnsent)
    throw DeviceError("device: it does not read the forces that it asks for",
                      DeviceErrorCode::kSlow);
}

/// Tells the device why, and ends the connection.
void DeviceServer::dismiss(const DeviceError& error) {
  if (!client_) return;
  // After half a message the device could not read this one.
  if (client_->unsent.size() % kDeviceMessageSize == 0)
    sendSome(client_->socket, encodeDeviceError(error.code(), error.what()));
  leave(error.code() == DeviceErrorCode::kClosing ? "" : error.what());
}

void DeviceServer::leave(const std::string& error) {
  const bool wasGreeted = client_->session.isGreeted();
  client_.reset();
  if (!wasGreeted && error.empty()) return;
  change([&](Status& status) {
    status.isConnected = false;
    if (wasGreeted) ++status.ended;
    status.error = error;
  });
}

}  // namespace palpa::app
