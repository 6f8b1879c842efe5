#include <condition_variable>
#include <mutex>

#include "app/cli/commands.h"
#include "app/cli/errors.h"
#include "app/cli/project_input.h"
#include "app/cli/text.h"
#include "app/cli/values.h"
#include "app/core/device/device_server.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/results/touch.h"
#include "modeling/project/touch_kind.h"

namespace palpa::cli {
namespace {

class ServeCommand : public Command {
 public:
  std::string name() const override { return "serve"; }
  std::string summary() const override {
    return "Let a haptic device touch a project's solid, at a local socket";
  }
  std::string example() const override {
    return "palpa-cli serve projects/sphere.json\n"
           "  palpa-cli serve ball.json --kind ball --radius 6 --friction 0.3\n"
           "  palpa-cli serve ball.json --socket /tmp/palpa.sock --once   (ends with the first "
           "device)";
  }

  void declare(CLI::App& options) override {
    input_.declare(options);
    options
        .add_option("--socket", socket_,
                    "Where devices connect (default: palpa/device.sock in $XDG_RUNTIME_DIR)")
        ->type_name("PATH");
    options
        .add_option("--kind", kind_, "Tool at the handle: push (a fingertip, the default) or ball")
        ->type_name("KIND");
    options.add_option("--radius", radius_, "Radius of the tool, mm (default: a fingertip's)")
        ->type_name("MM");
    options.add_option("--friction", friction_, "Friction of the tool, 0 (default) to 10")
        ->type_name("NUMBER");
    options.add_flag("--once", isOnce_, "End when the first device has left");
  }

  void run(const Context& context) override {
    bem::ContactTool tool = parseTool();
    const std::filesystem::path path =
        socket_.empty() ? app::usualDeviceSocket() : std::filesystem::path(socket_);
    const modeling::Project project = input_.read(context);
    const auto model = app::buildTouchModel(project, {}, context.job());
    context.progress.clear();
    if (radius_.empty()) tool.radius = app::defaultTouchRadius(model->setup().mesh());
    app::TouchLoop::Options options;
    options.threads = context.options.threads;
    app::TouchLoop loop(options);
    loop.setModel(model);
    app::LoopTarget target(loop);
    std::mutex mutex;
    std::condition_variable_any changed;
    app::DeviceServer server(target, tool, path, [&] {
      const std::lock_guard lock(mutex);
      changed.notify_all();
    });
    if (!context.options.quiet && !context.options.json)
      context.print({}, "listening  at " + path.string() + ", Ctrl-C ends\n");
    app::DeviceServer::Status status;
    int devices = 0;
    std::unique_lock lock(mutex);
    while (!context.stop.stop_requested() && !(isOnce_ && status.ended > 0)) {
      changed.wait(lock, context.stop, [&] {
        const app::DeviceServer::Status now = server.status();
        const bool isNew =
            now.devices != status.devices || now.ended != status.ended || now.error != status.error;
        status = now;
        return isNew;
      });
      if (context.options.quiet || context.options.json) continue;
      if (status.devices > devices) context.print({}, "connected  a device\n");
      devices = status.devices;
      if (!status.error.empty()) context.print({}, "ended      " + status.error + "\n");
    }
    report(server, path, context);
  }

 private:
  /// Without --radius the radius is still 0.
  bem::ContactTool parseTool() const {
    bem::ContactTool tool{bem::ContactTool::Kind::kPush, 0, 0};
    if (kind_ == "ball")
      tool.kind = bem::ContactTool::Kind::kBall;
    else if (kind_ != "push")
      throw UsageError("--kind: expected push or ball, found '" + kind_ + "'");
    if (!radius_.empty()) tool.radius = parsePositive("--radius", radius_);
    if (!friction_.empty()) tool.friction = parseNumber("--friction", friction_);
    if (tool.friction < 0 || tool.friction > modeling::kMaxFriction)
      throw UsageError("--friction: expected a number from 0 to 10, found '" + friction_ + "'");
    return tool;
  }

  static void report(const app::DeviceServer& server, const std::filesystem::path& path,
                     const Context& context) {
    const app::DeviceServer::Status status = server.status();
    const app::Latency latency = server.latency();
    Json json{{"socket", path.string()},
              {"devices", status.devices},
              {"positions", status.positions},
              {"latency_ms",
               {{"p50", 1e3 * latency.p50},
                {"p99", 1e3 * latency.p99},
                {"largest", 1e3 * latency.largest}}}};
    if (!status.error.empty()) json["error"] = status.error;
    std::string text = format("served     %d devices, %llu positions\n", status.devices,
                              static_cast<unsigned long long>(status.positions));
    if (latency.count > 0)
      text +=
          format("latency    %.2f ms in half of the answers, %.2f ms in 99 %%, at most %.2f ms\n",
                 1e3 * latency.p50, 1e3 * latency.p99, 1e3 * latency.largest);
    context.print(json, text);
  }

  ProjectInput input_;
  std::string socket_, kind_ = "push", radius_, friction_;
  bool isOnce_ = false;
};

}  // namespace

std::unique_ptr<Command> makeServeCommand() {
  return std::make_unique<ServeCommand>();
}

}  // namespace palpa::cli
