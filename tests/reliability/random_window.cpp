// A real window gets random mouse, key and menu input, and random answers to its dialogs. It must
// live on, and its project must stay one that can be saved and read.
#include <QTest>

#include "tests/reliability/window_process.h"
#include "tests/reliability/window_user.h"

namespace palpa::reliability {
namespace {

int drive(Campaign& campaign, const QString& folder, const ActionLog& log) {
  WindowUser user(campaign.seed(), folder, log);
  Usage before;
  bool isWarm = false;
  while (campaign.next()) {
    user.act();
    QTest::qWait(pick(user.random(), 0, 6));
    if (campaign.rounds() % 200 == 0) {
      user.rest();
      checkProject(campaign, user.window().editor());
    }
    if (isWarm || campaign.fraction() < 1.0 / 3) continue;
    before = usageNow();
    isWarm = true;
  }
  user.rest();
  checkProject(campaign, user.window().editor());
  const Usage after = usageNow();
  for (const auto& [name, count] : user.counts()) campaign.figure(name, static_cast<double>(count));
  campaign.figures(before, after);
  return campaign.end();
}

}  // namespace
}  // namespace palpa::reliability

int main(int argc, char** argv) {
  using namespace palpa::reliability;
  Campaign campaign("random_window", argc, argv, 12, 0, {"--log"});
  return runWatched(campaign, argv, [&campaign](const QString& folder, const ActionLog& log) {
    return drive(campaign, folder, log);
  });
}
