// The touch loop works for a long time under random touches of all kinds: forces must stay right,
// and memory as it is.
#include <algorithm>
#include <thread>

#include "app/core/model/build_touch_model.h"
#include "app/core/results/touch.h"
#include "app/core/session/new_project.h"
#include "modeling/shapes/primitives.h"
#include "tests/reliability/touch_user.h"

namespace palpa::reliability {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using Kind = bem::ContactTool::Kind;

constexpr int kMaxContacts = 6;

std::shared_ptr<const app::TouchModel> modelOf(modeling::Engine engine) {
  modeling::Project project = app::makeProject(modeling::makeSphere(25), "soak");
  project.mesh.engine = engine;
  project.mesh.edgeLength = 6;
  project.mesh.elementLength = 10;
  return app::buildTouchModel(project, {}, {});
}

struct Sums {
  long snapshots = 0, unsolved = 0, checks = 0;
  double slowest = 1e9, largestError = 0;
};

class Soak {
 public:
  Soak(Campaign& campaign, modeling::Engine engine, std::uint64_t seed)
      : campaign_(campaign),
        model_(modelOf(engine)),
        places_(placesOf(*model_)),
        random_(seed),
        user_(loop_, seed, kMaxContacts) {
    number_ = loop_.setModel(model_);
    await([this](const app::TouchSnapshot& snapshot) {
      return snapshot.model == number_ && snapshot.columnsReady == 1;
    });
    touchMost();
  }

  const TouchUser& user() const { return user_; }
  double rate() const { return snapshot_.rate; }
  const app::TouchLoop& loop() const { return loop_; }
  std::uint64_t steps() const { return snapshot_.step; }

  void act(Sums& sums) {
    user_.act(places_);
    std::this_thread::sleep_for(std::chrono::microseconds(pick(random_, 200, 4000)));
    loop_.read(snapshot_);
    ++sums.snapshots;
    sums.unsolved += snapshot_.isConverged ? 0 : 1;
    for (const auto& contact : snapshot_.touched()) {
      if (!contact.force.allFinite() || !contact.displacement.allFinite())
        campaign_.fail("a force or displacement is not finite");
      // A grabbed place is where the user moved it.
      if (contact.tool.kind == Kind::kGrab &&
          contact.status == app::TouchSnapshot::Status::kGrabbed && snapshot_.isConverged &&
          (contact.displacement - contact.value).norm() > 1e-3 * (contact.value.norm() + 1))
        campaign_.fail("a grabbed place is not where it was moved");
    }
    if (!loop_.status().error.empty()) campaign_.fail(loop_.status().error);
  }

  /// Lets go of all; nothing is touched any more.
  void rest() {
    user_.endAll();
    await([](const app::TouchSnapshot& snapshot) { return snapshot.contactCount == 0; });
  }

  /// Lets go, grabs one place, and compares with the exact solution.
  void check(Sums& sums) {
    rest();
    const Place& place =
        places_[static_cast<std::size_t>(pick(random_, 0, static_cast<int>(places_.size()) - 1))];
    modeling::Touch touch;
    touch.at = place.at;
    touch.radius = pickReal(random_, 5, 9);
    touch.kind = modeling::TouchKind::kGrab;
    touch.vector = -pickReal(random_, 0.5, 2) * place.normal;
    Vector3d wanted;
    try {
      wanted = app::playTouches(*model_, {&touch, 1}).contacts.front().force;
    } catch (const bem::SolverError&) {
      return;  // a support holds the place
    }
    const app::TouchId id = loop_.begin({Kind::kGrab, *touch.radius}, touch.at, touch.vector);
    await([id](const app::TouchSnapshot& snapshot) {
      const auto* contact = snapshot.find(id);
      return contact && contact->status != app::TouchSnapshot::Status::kWaiting;
    });
    const auto* contact = snapshot_.find(id);
    if (contact) {
      const double error = (contact->force - wanted).norm() / wanted.norm();
      sums.largestError = std::max(sums.largestError, error);
      ++sums.checks;
      campaign_.require(error <= 1e-4, "a force is wrong by " + std::to_string(error));
    }
    loop_.end(id);
  }

 private:
  /// The loop keeps the memory of its largest touch. So this touches with as many of the largest
  /// balls as a user may hold; later touches need no more memory.
  void touchMost() {
    std::vector<app::TouchId> balls;
    for (int k = 0; k < kMaxContacts; ++k) {
      const Place& place = places_[places_.size() * static_cast<std::size_t>(k) / kMaxContacts];
      const bem::ContactTool ball{Kind::kBall, 9};
      balls.push_back(loop_.begin(ball, place.at, place.at + (ball.radius - 2) * place.normal));
    }
    await([](const app::TouchSnapshot& snapshot) { return snapshot.contactCount == kMaxContacts; });
    const std::uint64_t enough = snapshot_.step + 20;
    await([=](const app::TouchSnapshot& snapshot) { return snapshot.step >= enough; });
    for (const app::TouchId ball : balls) loop_.end(ball);
    rest();
  }

  template <class Condition>
  void await(const Condition& condition) {
    const auto end = Clock::now() + 60s;
    do {
      std::this_thread::sleep_for(500us);
      loop_.read(snapshot_);
    } while (!condition(snapshot_) && Clock::now() < end);
    campaign_.require(condition(snapshot_), "the touch loop does not answer");
  }

  Campaign& campaign_;
  const std::shared_ptr<const app::TouchModel> model_;
  const std::vector<Place> places_;
  Random random_;
  app::TouchLoop loop_;
  TouchUser user_;
  std::uint64_t number_ = 0;
  app::TouchSnapshot snapshot_;
};

}  // namespace
}  // namespace palpa::reliability

int main(int argc, char** argv) {
  using namespace palpa::reliability;
  Campaign campaign("soak", argc, argv, 10, 0);
  Random random(campaign.seed());
  Sums sums;
  // One body of each engine, in turns: a turn is a round.
  Soak triangles(campaign, palpa::modeling::Engine::kTriangles, random());
  Soak splines(campaign, palpa::modeling::Engine::kSplines, random());
  Usage before;
  bool isWarm = false;
  std::uint64_t stepsBefore = 0;
  const auto steps = [&] { return triangles.steps() + splines.steps(); };
  // Counted without any contact, so that both times the same is there.
  const auto count = [&] {
    for (Soak* soak : {&triangles, &splines}) soak->rest();
    return usageNow();
  };
  while (campaign.next()) {
    Soak& soak = campaign.rounds() % 2 ? triangles : splines;
    const auto end = Clock::now() + std::chrono::milliseconds(500);
    while (Clock::now() < end) soak.act(sums);
    soak.check(sums);
    if (isWarm || campaign.fraction() < 0.2) continue;
    before = count();
    stepsBefore = steps();
    isWarm = true;
  }
  const Usage after = count();
  const auto latency = splines.loop().latency();
  campaign.require(sums.checks > 0 && steps() > stepsBefore, "there was nothing to compare");
  campaign.figure("touches",
                  static_cast<double>(triangles.user().begun() + splines.user().begun()));
  campaign.figure("moves", static_cast<double>(triangles.user().moved() + splines.user().moved()));
  campaign.figure("steps", static_cast<double>(steps()));
  campaign.figure("rate of each loop", static_cast<double>(steps()) / campaign.elapsed() / 2, "Hz");
  campaign.figure("latency p99", 1e3 * latency.p99, "ms");
  campaign.figure("snapshots read", static_cast<double>(sums.snapshots));
  campaign.figure("of them not converged", static_cast<double>(sums.unsolved));
  campaign.figure("forces compared", static_cast<double>(sums.checks));
  campaign.figure("largest error", sums.largestError);
  campaign.figures(before, after);
  campaign.requireFlat(before, after, 4 * kMiB);
  return campaign.end();
}
