// Edits, touches, rebuilds, stops and changes of mode from several threads, as the window makes
// them; afterwards the model must equal a full rebuild of the same project.
#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

#include "app/core/live/stiffness_worker.h"
#include "app/core/live/touch_field.h"
#include "app/core/results/drawn_body.h"
#include "app/core/results/touch.h"
#include "app/core/session/session.h"
#include "modeling/error.h"
#include "modeling/shapes/primitives.h"
#include "tests/modeling/child_process.h"
#include "tests/reliability/search_user.h"
#include "tests/reliability/touch_user.h"

namespace palpa::reliability {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using State = app::RebuildStatus::State;

constexpr auto kPatience = 300s;

/// Fine enough for updates, and with so many control points that one of them moves a small part.
modeling::Project startProject(modeling::Engine engine) {
  modeling::Project project;
  project.name = "storm";
  project.material = {"silicone", 0.1, 0.45};
  const modeling::Solid solid = modeling::makeSphere(25, 11);
  project.supports.push_back({"base", modeling::Support::Kind::kFixed,
                              modeling::Region::ofPatches({solid.patches().front().name}),
                              Vector3d::Zero()});
  project.body = solid;
  project.mesh.engine = engine;
  project.mesh.edgeLength = 4.2;
  project.mesh.elementLength = 8.0;
  return project;
}

/// The window's thread: the session, the touch loop that follows it, and what is drawn.
class Window {
 public:
  Window(Campaign& campaign, const std::filesystem::path& folder, modeling::Engine engine,
         std::uint64_t seed)
      : campaign_(campaign),
        random_(seed),
        file_(folder / "storm.json"),
        session_(startProject(engine), options(folder)),
        searches_(campaign, session_, random_()),
        stiffness_([this](app::StiffnessWorker::Result result) {
          campaign_.require(result.ready >= 0 && result.ready <= 1, "stiffness: part ready");
        }) {
    watched_ = &session_.pipeline();
  }

  ~Window() {
    watched_ = nullptr;
    drawer_ = {};
    stiffness_.stop();
  }

  app::TouchLoop& loop() { return loop_; }
  app::RebuildPipeline& pipeline() { return session_.pipeline(); }
  long edits() const { return edits_; }
  long updates() const { return updates_; }
  long models() const { return models_; }
  const SearchUser& searches() const { return searches_; }

  /// One random action of a user, then the window's reaction.
  void act() {
    try {
      doSomething();
    } catch (const modeling::ModelingError&) {
      // An edit that is not possible: refused, and nothing has changed.
    }
    follow();
    session_.autosaveIfDue(Clock::now());
  }

  /// Takes what the pipeline has; as Simulation does.
  void follow() {
    const auto model = pipeline().model();
    if (model && model != known_) {
      known_ = model;
      ++models_;
    }
    if (!isSimulating_ || !model || model == touched_) return;
    touched_ = model;
    number_ = loop_.setModel(model);
  }

  /// An edit of a body that is ready: an update comes first.
  void pullOnePoint() {
    if (!wait()) return;
    const auto& solid = std::get<modeling::Solid>(session_.project().body);
    const std::vector<Vector3d>& points = solid.controlPoints();
    // Opposite the patch that is held.
    Vector3d out = Vector3d::Zero();
    for (const auto& row : solid.patches().front().net)
      for (const int held : row) out -= points[held];
    out.normalize();
    const auto farthest = std::max_element(
        points.begin(), points.end(),
        [&](const Vector3d& a, const Vector3d& b) { return a.dot(out) < b.dot(out); });
    edit(modeling::MovePoints{
        modeling::PointSelection::of({static_cast<int>(farthest - points.begin())}),
        modeling::MoveBy{1.5 * out},
        {}});
    if (wait()) campaign_.require(updates_ > 0, "no update came before the model");
    follow();
  }

  /// After the storm: everything settles to what the project says.
  void settle() {
    session_.pipeline().startPending();
    if (session_.document().isInGroup()) session_.endGroup();
    if (!wait()) return;
    if (pipeline().status().state == State::kCancelled) session_.rebuild();
    if (!wait()) return;
    const app::RebuildStatus status = pipeline().status();
    std::shared_ptr<const app::TouchModel> fresh;
    std::string error;
    try {
      fresh = app::buildTouchModel(session_.project(), {}, {});
    } catch (const std::exception& caught) {
      error = caught.what();
    }
    if (!fresh) {
      campaign_.require(
          status.state == State::kFailed && status.error == error,
          "a project that cannot be built (" + error + ") is said to be: " + status.error);
      return;
    }
    if (!campaign_.require(status.state == State::kUpToDate, "not up to date: " + status.error))
      return;
    const auto model = pipeline().model();
    campaign_.require(!model->report().residual, "an update stayed");
    campaign_.require(model->surface().positions == fresh->surface().positions &&
                          model->surface().triangles == fresh->surface().triangles,
                      "another mesh than a full rebuild of the project");
    compareForces(*model, *fresh);
  }

 private:
  app::Session::Options options(const std::filesystem::path& folder) {
    app::Session::Options made;
    made.cacheFolder = folder / "cache";
    made.cacheLimit = 50e6;
    made.autosaveFolder = folder / "autosave";
    made.autosaveEvery = 0s;
    made.rebuildChanged = [this] { countUpdate(); };
    return made;
  }

  /// Called from the pipeline's thread and from the thread of the edits.
  void countUpdate() {
    app::RebuildPipeline* pipeline = watched_;
    if (!pipeline) return;
    const app::RebuildStatus status = pipeline->status();
    if (status.residual && updatedRevision_.exchange(status.modelRevision) != status.modelRevision)
      ++updates_;
  }

  bool wait() {
    return campaign_.require(pipeline().waitUntilSettled(kPatience), "the rebuild does not end");
  }

  /// A touch on both, and through the loop.
  void compareForces(const app::TouchModel& model, const app::TouchModel& fresh) {
    const std::vector<Place> places = placesOf(fresh);
    const Place* highest = &places.front();
    for (const Place& place : places)
      if (place.at.z() > highest->at.z()) highest = &place;
    modeling::Touch touch;
    touch.at = highest->at;
    touch.radius = 7.0;
    touch.kind = modeling::TouchKind::kGrab;
    touch.vector = -1.5 * highest->normal;
    const auto forceOf = [&](const app::TouchModel& of) {
      return app::playTouches(of, {&touch, 1}).contacts.front().force;
    };
    Vector3d wanted, found;
    try {
      wanted = forceOf(fresh);
      found = forceOf(model);
    } catch (const bem::SolverError&) {
      return;  // the highest place is held
    }
    campaign_.require((found - wanted).norm() <= 1e-6 * wanted.norm(),
                      "another force than on a full rebuild of the project");
    loop_.setModel(nullptr);
    const std::uint64_t number = loop_.setModel(pipeline().model());
    const auto end = Clock::now() + kPatience;
    app::TouchId id = 0;
    while (id == 0 && Clock::now() < end) try {
        id = loop_.begin({bem::ContactTool::Kind::kGrab, 7.0}, touch.at, -1.5 * highest->normal);
      } catch (const app::TouchRefused&) {  // those that were ended are still being taken away
        std::this_thread::sleep_for(1ms);
      }
    app::TouchSnapshot snapshot;
    const app::TouchSnapshot::Contact* contact = nullptr;
    do {
      std::this_thread::sleep_for(1ms);
      loop_.read(snapshot);
      contact = snapshot.model == number ? snapshot.find(id) : nullptr;
    } while (Clock::now() < end && !(contact && contact->force.norm() > 0));
    if (campaign_.require(contact && contact->force.norm() > 0,
                          "no force from the loop: " + loop_.status().error))
      campaign_.require((contact->force - wanted).norm() <= 1e-4 * wanted.norm(),
                        "another force from the loop");
    loop_.end(id);
  }

  int point() {
    const auto& solid = std::get<modeling::Solid>(session_.project().body);
    return pick(random_, 0, static_cast<int>(solid.controlPoints().size()) - 1);
  }
  Vector3d vector(double most) {
    return {pickReal(random_, -most, most), pickReal(random_, -most, most),
            pickReal(random_, -most, most)};
  }
  void edit(const modeling::Command& command, modeling::Merge merge = modeling::Merge::kNo) {
    session_.perform(command, merge);
    ++edits_;
  }

  /// Drags a control point: several commands that become one.
  void drag() {
    const int dragged = point();
    const Vector3d way = vector(0.8);
    const int motions = pick(random_, 1, 6);
    for (int i = 1; i <= motions; ++i) {
      edit(
          modeling::MovePoints{
              modeling::PointSelection::of({dragged}), modeling::MoveBy{way / motions}, {}},
          i == 1 ? modeling::Merge::kNo : modeling::Merge::kWithLast);
      std::this_thread::sleep_for(std::chrono::milliseconds(pick(random_, 0, 8)));
      follow();
    }
    if (!oneIn(random_, 4)) session_.endMotion();
  }

  void group() {
    session_.beginGroup("group");
    for (int i = pick(random_, 1, 3); i > 0; --i) drag();
    oneIn(random_, 3) ? static_cast<void>(session_.cancelGroup()) : session_.endGroup();
  }

  void conditions() {
    const modeling::Project& project = session_.project();
    switch (pick(random_, 0, 4)) {
      case 0:
        if (project.loads.empty())
          edit(modeling::AddLoad{{"bump", modeling::Bump{25 * vector(1).normalized(), 8, 0.002}}});
        else
          edit(modeling::RemoveLoad{project.loads.front().name});
        break;
      case 1:
        // Without one nothing holds the body.
        if (project.supports.empty() || oneIn(random_, 3))
          edit(modeling::AddSupport{
              {"half " + std::to_string(edits_), modeling::Support::Kind::kFixed,
               modeling::Region::below(Vector3d(0.2, -0.1, 1), -15), Vector3d::Zero()}});
        else
          edit(modeling::RemoveSupport{project.supports.back().name});
        break;
      case 2: {
        modeling::Material material = project.material;
        material.poissonRatio = pickReal(random_, 0.3, 0.49);
        edit(modeling::SetMaterial{material});
        break;
      }
      case 3: {
        modeling::MeshSettings mesh = project.mesh;
        if (oneIn(random_, 2))
          mesh.engine = mesh.engine == modeling::Engine::kSplines ? modeling::Engine::kTriangles
                                                                  : modeling::Engine::kSplines;
        mesh.edgeLength = pickReal(random_, 4, 7);
        edit(modeling::SetMesh{mesh});
        break;
      }
      default: {
        modeling::Touch touch;
        touch.name = "touch " + std::to_string(edits_);
        touch.at = 25 * vector(1).normalized();
        touch.radius = pickReal(random_, 5, 9);
        touch.kind = modeling::TouchKind::kGrab;
        touch.vector = vector(1);
        if (project.touches.size() < 2)
          edit(modeling::AddTouch{touch});
        else
          edit(modeling::RemoveTouch{project.touches.front().name});
      }
    }
  }

  void doSomething() {
    switch (pick(random_, 0, 17)) {
      case 0:
      case 1:
      case 2:
      case 3:
      case 4:
        return drag();
      case 5:
        return group();
      case 6:
        return conditions();
      case 7:
        if (session_.document().canUndo()) session_.undo();
        return;
      case 8:
        if (session_.document().canRedo()) session_.redo();
        return;
      case 9:
        return oneIn(random_, 2) ? pipeline().cancel() : session_.rebuild();
      case 10:
        return switchMode();
      case 11:
        return session_.saveAs(file_);
      case 12:
        return draw();
      case 13:
        return colour();
      case 14:
      case 15:
        return searches_.act();
      default:
        // Long enough that builds and updates come to their end now and then.
        pipeline().waitUntilSettled(std::chrono::milliseconds(oneIn(random_, 2) ? 5000 : 300));
    }
  }

  void switchMode() {
    isSimulating_ = !isSimulating_;
    if (isSimulating_) return;
    drawer_ = {};
    stiffness_.stop();
    loop_.setModel(nullptr);
    touched_.reset();
  }

  /// Prepares the body that is touched for drawing, on another thread, and draws a frame.
  void draw() {
    const auto body = loop_.model(number_);
    if (!body) return;
    drawer_ = std::jthread([body](const std::stop_token& stop) {
      Job job;
      job.stop = stop;
      try {
        modeling::DisplaySettings settings;
        settings.mostPieces = settings.leastPieces = 1;
        app::DrawnBody drawn(body->sharedModel(), settings, job);
      } catch (const Cancelled&) {
        // Another body is drawn by now.
      }
    });
    app::TouchSnapshot snapshot;
    loop_.read(snapshot);
    if (snapshot.model != number_) return;
    app::TouchField field(body);
    campaign_.require(field.describe(snapshot).field.u.allFinite(), "a field is not finite");
  }

  void colour() {
    const auto body = loop_.model(number_);
    if (body && oneIn(random_, 2))
      stiffness_.start(body, 7.0);
    else
      stiffness_.stop();
  }

  Campaign& campaign_;
  Random random_;
  const std::filesystem::path file_;
  std::atomic<app::RebuildPipeline*> watched_{nullptr};
  std::atomic<std::uint64_t> updatedRevision_{0};
  std::atomic<long> updates_{0};
  app::Session session_;
  SearchUser searches_;
  app::TouchLoop loop_;
  app::StiffnessWorker stiffness_;
  std::jthread drawer_;
  bool isSimulating_ = true;
  std::shared_ptr<const app::TouchModel> known_, touched_;
  std::uint64_t number_ = 0;
  long edits_ = 0, models_ = 0;
};

struct Sums {
  std::atomic<long> edits{0}, models{0}, updates{0}, touches{0}, moves{0}, snapshots{0};
  long searches = 0, found = 0, accepted = 0;
};

void touch(Campaign& campaign, app::TouchLoop& loop, const std::stop_token& stop,
           std::uint64_t seed, Sums& sums) {
  static const std::vector<Place> places = [] {
    std::vector<Place> made;
    Random random(3);
    for (int i = 0; i < 200; ++i) {
      const Vector3d normal =
          Vector3d(pickReal(random, -1, 1), pickReal(random, -1, 1), pickReal(random, -1, 1))
              .normalized();
      made.push_back({25 * normal, normal});
    }
    return made;
  }();
  TouchUser user(loop, seed, 6);
  Random random(seed);
  app::TouchSnapshot snapshot;
  while (!stop.stop_requested()) {
    user.act(places);
    loop.read(snapshot);
    ++sums.snapshots;
    for (const auto& contact : snapshot.touched())
      if (!contact.force.allFinite()) campaign.fail("a force is not finite");
    if (oneIn(random, 50)) {
      loop.startRecording(1000);
      std::this_thread::sleep_for(5ms);
      loop.stopRecording();
    }
    std::this_thread::sleep_for(std::chrono::microseconds(pick(random, 100, 3000)));
  }
  user.endAll();
  sums.touches += user.begun();
  sums.moves += user.moved();
}

/// Reads all that can be read, as status bar and panels do.
void watch(Window& window, const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    window.pipeline().status();
    window.pipeline().model();
    window.loop().status();
    window.loop().latencies();
    std::this_thread::sleep_for(2ms);
  }
}

void round(Campaign& campaign, Random& random, int actions, Sums& sums) {
  const testing_support::TemporaryFolder folder;
  const auto engine =
      campaign.rounds() % 2 ? modeling::Engine::kSplines : modeling::Engine::kTriangles;
  Window window(campaign, folder.path(), engine, random());
  {
    std::jthread watcher([&](const std::stop_token& stop) { watch(window, stop); });
    std::vector<std::jthread> users;
    for (int i = 0; i < 2; ++i)
      users.emplace_back([&, seed = random()](const std::stop_token& stop) {
        touch(campaign, window.loop(), stop, seed, sums);
      });
    window.pullOnePoint();
    for (int k = 0; k < actions; ++k) window.act();
  }
  // Now and then everything goes while it works.
  if (!oneIn(random, 4)) window.settle();
  sums.edits += window.edits();
  sums.models += window.models();
  sums.updates += window.updates();
  sums.searches += window.searches().begun();
  sums.found += window.searches().found();
  sums.accepted += window.searches().accepted();
}

}  // namespace
}  // namespace palpa::reliability

int main(int argc, char** argv) {
  using namespace palpa::reliability;
  Campaign campaign("storm", argc, argv, 0, 2, {"--actions"});
  const int actions = std::stoi(campaign.option("--actions").value_or("40"));
  Random random(campaign.seed());
  Sums sums;
  while (campaign.next()) round(campaign, random, actions, sums);
  campaign.require(sums.updates > 0 && sums.touches > 0, "there was no update or no touch");
  campaign.figure("edits", static_cast<double>(sums.edits));
  campaign.figure("models", static_cast<double>(sums.models));
  campaign.figure("of them updates", static_cast<double>(sums.updates));
  campaign.figure("searches", static_cast<double>(sums.searches));
  campaign.figure("found shapes", static_cast<double>(sums.found));
  campaign.figure("accepted", static_cast<double>(sums.accepted));
  campaign.figure("touches", static_cast<double>(sums.touches));
  campaign.figure("moves", static_cast<double>(sums.moves));
  return campaign.end();
}
