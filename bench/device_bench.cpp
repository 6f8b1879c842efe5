// A simulated haptic handle in real time, through the real socket: latency and energy at walls of
// several stiffnesses.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "app/core/device/device_server.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/system/priority.h"
#include "bench/measurement_table.h"
#include "bench/sphere.h"
#include "bench/timing.h"
#include "bench/virtual_device.h"

namespace {

using namespace palpa;
using Clock = std::chrono::steady_clock;
using Eigen::Vector3d;

constexpr double kRadius = 8;  // mm, of the fingertip
/// A device that has had no force for so long applies none.
constexpr std::chrono::milliseconds kMaxAge{3};
constexpr double kGrip = 0.5;          // N/mm, of a hand about its target
constexpr double kGripDamping = 4e-3;  // N s/mm
const Vector3d kTop(0, 0, 25);

std::shared_ptr<const app::TouchModel> sphere(int cells, double youngsModulus) {
  modeling::Project project = bench::sphereProject(cells);
  project.material.youngsModulus = youngsModulus;
  return app::buildTouchModel(project, {}, {});
}

void sendAll(const app::FileDescriptor& socket, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const auto count = app::sendSome(socket, bytes);
    if (!count) throw app::DeviceError("the connection ended");
    bytes = bytes.subspan(*count);
  }
}

app::DeviceMessage receive(const app::FileDescriptor& socket) {
  app::DeviceMessage message{};
  std::size_t have = 0;
  while (have < message.size()) {
    const auto count = app::receiveSome(socket, std::span(message).subspan(have));
    if (count == 0) throw app::DeviceError("the connection ended");
    have += count.value_or(0);
  }
  return message;
}

struct Result {
  std::vector<double> roundTrips;                      // s
  std::vector<double> lateness;                        // s, of the handle's own millisecond
  double mostEnergy = -1e9, energy = 0, received = 0;  // mJ
  double stiffness = 0;                                // N/mm, the largest that was told
  double force = 0;                                    // N, the largest
  int touching = 0, limited = 0, stalls = 0;
  double seconds = 0;
};

/// Presses, taps and trembles on the top for a time.
Result press(const app::FileDescriptor& socket, double wall, double seconds) {
  Result result;
  const double force = std::min(4.0, 2 * wall);
  const double reach = 2 + std::min(force / wall, 3.0) + force / kGrip;
  const Vector3d start = kTop + Vector3d(0, 0, 2);
  bench::VirtualDevice handle({0.08, 0.5e-3, 0.01}, start);
  Vector3d applied = Vector3d::Zero();
  app::RealtimeScope realtime;
  const auto began = Clock::now();
  auto last = began, due = began, answered = began;
  std::uint64_t sequence = 0;
  for (;;) {
    const auto now = Clock::now();
    const double time = std::chrono::duration<double>(now - began).count();
    if (time > seconds) break;
    result.lateness.push_back(std::chrono::duration<double>(now - due).count());
    Vector3d goal = start;
    goal[2] -= reach * (0.5 - 0.5 * std::cos(2 * std::numbers::pi * 0.7 * time));
    goal[0] += 0.3 * std::sin(2 * std::numbers::pi * 9 * time);  // tremor
    goal[2] += 0.3 * std::sin(2 * std::numbers::pi * 11 * time);
    const auto move = [&](Clock::time_point until) {
      const double elapsed = std::chrono::duration<double>(until - last).count();
      const Vector3d hand = kGrip * (goal - handle.position()) - kGripDamping * handle.velocity();
      // As the protocol demands, an old force ends: when the machine stalls, the handle is free.
      const double left = std::chrono::duration<double>(answered + kMaxAge - last).count();
      const double forced = std::clamp(left, 0.0, std::max(elapsed, 0.0));
      if (forced > 0) handle.advance(applied, hand, forced);
      if (elapsed > forced) handle.advance(Vector3d::Zero(), hand, elapsed - forced);
      if (elapsed > forced) ++result.stalls;
      last = until;
      result.mostEnergy = std::max(result.mostEnergy, handle.energyFromDevice());
    };
    move(now);
    sendAll(socket, encode(app::DevicePosition{++sequence, handle.measured(), 0, time + 1}));
    const app::DeviceReply reply = app::decodeReply(receive(socket));
    answered = Clock::now();
    result.roundTrips.push_back(std::chrono::duration<double>(answered - now).count());
    move(answered);
    applied = reply.force;
    result.stiffness = std::max(result.stiffness, reply.stiffness);
    result.force = std::max(result.force, applied.norm());
    result.touching += (reply.status & app::DeviceReply::kTouching) != 0 ? 1 : 0;
    result.limited += (reply.status & app::DeviceReply::kLimited) != 0 ? 1 : 0;
    realtime.worked(now, Clock::now());
    // A late period is not made up for, as in a device.
    due = std::max(due + std::chrono::milliseconds(1), Clock::now());
    std::this_thread::sleep_until(due);
  }
  result.energy = handle.energyFromDevice();
  result.received = handle.energyFromHand();
  result.seconds = std::chrono::duration<double>(Clock::now() - began).count();
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App options{"A simulated haptic handle presses the clamped sphere through the socket."};
  double seconds = 40;
  int cells = 10;
  std::vector<double> walls{0.1, 1, 3, 10};
  std::string tablePath;
  options.add_option("--seconds", seconds, "of all walls together")
      ->check(CLI::Range(1.0, 36000.0));
  options.add_option("--walls", walls, "stiffnesses, N/mm")->check(CLI::Range(0.01, 100.0));
  options.add_option("--cells", cells, "cells along a cube edge of the sphere's mesh");
  options.add_option("--table", tablePath,
                     "adds bench;n;what;value;unit;goal of all rows to a file");
  CLI11_PARSE(options, argc, argv);

  app::lowerPriorityOfLoadedThreads();
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("palpa-device-bench-" + std::to_string(getpid()));
  constexpr double kSoft = 0.1;  // MPa; stiffness is proportional
  double perModulus = 0;
  bench::MeasurementTable table;
  table.open(tablePath, "palpa-device-bench");
  std::printf("  %-10s %8s %9s %9s %9s %9s %10s %10s %9s %6s\n", "wall N/mm", "rate Hz", "p50 ms",
              "p99 ms", "max ms", "late p99", "energy mJ", "most mJ", "limited %", "stalls");
  bool isPassive = true;
  for (std::size_t k = 0; k <= walls.size(); ++k) {
    // The first run measures the stiffness of the soft sphere.
    const bool isFirst = k == 0;
    const double wall = isFirst ? 1 : walls[k - 1];
    const auto model = sphere(cells, isFirst ? kSoft : wall / perModulus);
    app::TouchLoop loop;
    loop.setModel(model);
    while (loop.status().columnsReady < 1)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    app::LoopTarget target(loop);
    app::DeviceServer server(target, {bem::ContactTool::Kind::kPush, kRadius, 0}, path);
    const app::FileDescriptor socket = app::connectTo(path);
    sendAll(socket, encode(app::DeviceHello{}));
    app::decodeWelcome(receive(socket));
    const Result result =
        press(socket, wall, isFirst ? 2 : seconds / static_cast<double>(walls.size()));
    if (isFirst) {
      perModulus = result.stiffness / kSoft;
      continue;
    }
    const bench::Quantiles trips = bench::quantilesOf(result.roundTrips);
    const bench::Quantiles late = bench::quantilesOf(result.lateness);
    const double rate = trips.count / result.seconds;
    std::printf("  %-10g %8.0f %9.3f %9.3f %9.3f %9.3f %10.2f %10.4f %9.2f %6d\n", wall, rate,
                1e3 * trips.p50, 1e3 * trips.p99, 1e3 * trips.largest, 1e3 * late.p99,
                result.energy, result.mostEnergy,
                100.0 * result.limited / std::max(result.touching, 1), result.stalls);
    std::fflush(stdout);
    isPassive = isPassive && result.mostEnergy < 0.1;
    const std::string what = "wall " + CLI::detail::to_string(wall) + " N/mm, ";
    const int nodes = model->setup().discretisation->displacementCount();
    const auto add = [&](const std::string& name, double value, const std::string& unit,
                         const std::string& goal) {
      char text[64];
      std::snprintf(text, sizeof text, "%.4g %s", value, unit.c_str());
      table.add(nodes, what + name, text, goal);
    };
    add("rate", rate, "Hz", ">= 1000");
    add("position to force at the device, p99", 1e3 * trips.p99, "ms", "< 1");
    add("largest energy given to the handle", result.mostEnergy, "mJ", "<= 0.1");
  }
  std::printf(isPassive ? "no growth of energy\n" : "the handle gained energy\n");
  return isPassive ? 0 : 4;
}
