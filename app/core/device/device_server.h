#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "app/core/device/device_session.h"
#include "app/core/device/local_socket.h"
#include "app/core/live/latency_histogram.h"

namespace palpa::app {

/// Listens for haptic devices at a socket and lets one at a time touch the body
/// (docs/device-protocol.md). Its thread answers each position at once and never waits for the
/// touch loop. All functions may be called from any thread.
class DeviceServer {
 public:
  /// `target` must outlive the object. `changed` is called on the server's thread when status()
  /// has changed other than in numbers; may be empty. Throws DeviceError if it cannot listen.
  DeviceServer(DeviceTarget& target, const bem::ContactTool& tool,
               const std::filesystem::path& socket, std::function<void()> changed = {});
  /// Ends the contact and tells the device.
  ~DeviceServer();
  DeviceServer(const DeviceServer&) = delete;
  DeviceServer& operator=(const DeviceServer&) = delete;

  const std::filesystem::path& path() const { return listener_.path(); }

  struct Status {
    bool isConnected = false;     ///< a device has said hello
    int devices = 0;              ///< number of those so far
    int ended = 0;                ///< number of connections of them that have ended
    std::uint64_t positions = 0;  ///< received so far, from all devices
    std::string error;            ///< of the last connection that ended by an error; for users
  };
  Status status() const;
  /// Time from the arrival of a position in this thread to its force.
  Latency latency() const { return latency_.read(); }

  /// The tool of devices that connect from now on.
  void setTool(const bem::ContactTool& tool);

 private:
  struct Client {
    FileDescriptor socket;
    DeviceSession session;
    std::vector<std::byte> unsent;
  };
  void run(const std::stop_token& stop);
  void welcomeNext();
  void serve(short events);
  void flush();
  void dismiss(const DeviceError& error);
  void leave(const std::string& error);
  void change(const std::function<void(Status&)>& edit);

  DeviceTarget& target_;
  ListeningSocket listener_;
  FileDescriptor wake_;  // an eventfd: the thread must look at its stop token
  const std::function<void()> changed_;
  LatencyHistogram latency_;
  mutable std::mutex mutex_;  // guards status_ and tool_
  Status status_;
  bem::ContactTool tool_;
  std::unique_ptr<Client> client_;  // of the server's thread
  std::jthread thread_;             // last: it uses all of the above
};

}  // namespace palpa::app
