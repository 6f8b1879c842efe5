// A process that saves and autosaves all the time is killed at random moments. Whatever was said to
// be saved before must be there, whole, in the project's file or in a snapshot for recovery.
#include <filesystem>
#include <fstream>
#include <sstream>

#include "modeling/error.h"
#include "modeling/project/atomic_write.h"
#include "modeling/project/autosave.h"
#include "modeling/project/project_file.h"
#include "modeling/shapes/primitives.h"
#include "tests/modeling/child_process.h"
#include "tests/reliability/campaign.h"

namespace palpa::reliability {
namespace {

namespace fs = std::filesystem;
using modeling::Project;

std::string contentOf(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// States of one project, from 3 kB to 300 kB, growing and shrinking: state n is the same whoever
/// makes it.
class States {
 public:
  States() {
    bodies_.emplace_back(modeling::makeBox({40, 30, 20}));
    for (const int points : {7, 13, 22}) bodies_.emplace_back(modeling::makeSphere(25, points));
  }
  Project operator()(std::uint64_t number) const {
    Project project;
    project.name = std::to_string(number);
    project.material = {"rubber", 1.5, 0.45};
    Random random(number);
    project.body = bodies_[random() % bodies_.size()];
    modeling::Stroke stroke;
    for (int k = pick(random, 1, 400); k > 0; --k)
      stroke.points.emplace_back(pickReal(random, -25, 25), pickReal(random, -25, 25), -25);
    project.supports.push_back(
        {"painted", modeling::Support::Kind::kFixed, {{stroke}}, Eigen::Vector3d::Zero()});
    return project;
  }

 private:
  std::vector<modeling::Body> bodies_;
};

struct Sums {
  long saves = 0, halves = 0, fromFile = 0, fromSnapshot = 0;
};

class Kill {
 public:
  Kill(Campaign& campaign, const States& states, const fs::path& folder)
      : campaign_(campaign),
        states_(states),
        file_(folder / "work.json"),
        snapshots_(folder / "snapshots") {
    modeling::writeProject(states_(0), file_);
  }

  void round(Random& random, Sums& sums) {
    const std::uint64_t begin = newest_ + 1;
    // A third is killed during the first writing.
    const int least = oneIn(random, 3) ? 0 : pick(random, 1, 6);
    const auto said = testing_support::killAmongReports(
        least, pick(random, 0, 12000),
        [&](testing_support::Reports& reports) { edit(begin, reports); });
    const std::uint64_t reported = std::max(said, newest_);
    campaign_.require(reported >= newest_ + static_cast<std::uint64_t>(least),
                      "the process ended by itself");
    sums.saves += static_cast<long>(reported - newest_);
    newest_ = std::max(check(reported, sums), reported);
    removeHalves(sums);
  }

 private:
  /// In the child process: autosaves every state, then saves some of them, as a user does.
  [[noreturn]] void edit(std::uint64_t number, testing_support::Reports& reports) const {
    modeling::Autosave autosave(snapshots_);
    for (;; ++number) {
      const Project project = states_(number);
      if (number % 3 != 0) {
        autosave.write(project, file_, number);
      } else {
        modeling::writeProject(project, file_);
        autosave.remove();
      }
      reports.report(number);
    }
  }

  /// The number of a whole state; fails when the text is not exactly one.
  std::optional<std::uint64_t> numberOf(const std::string& text, const std::string& what) {
    try {
      const std::uint64_t number = std::stoull(modeling::parseProject(text, what).name);
      if (campaign_.require(text == modeling::toJson(states_(number)), what + " is not whole"))
        return number;
    } catch (const std::exception& error) {
      campaign_.fail(what + ": " + error.what());
    }
    return std::nullopt;
  }

  /// The newest state that is there.
  std::uint64_t check(std::uint64_t reported, Sums& sums) {
    const std::uint64_t saved = numberOf(contentOf(file_), "the project").value_or(0);
    std::uint64_t newest = saved;
    if (fs::exists(modeling::backupPath(file_))) {
      const auto backup = numberOf(contentOf(modeling::backupPath(file_)), "the backup");
      campaign_.require(backup && *backup <= saved, "the backup is newer than the file");
    }
    const modeling::RecoveryList list = modeling::findRecoverable(snapshots_);
    for (const std::string& problem : list.problems) campaign_.fail("recovery: " + problem);
    for (const modeling::Snapshot& snapshot : list.snapshots) {
      const auto number = numberOf(modeling::toJson(modeling::recover(snapshot)), "a snapshot");
      campaign_.require(number == snapshot.revision, "a snapshot is of another state");
      newest = std::max(newest, number.value_or(0));
    }
    campaign_.require(newest >= reported, "state " + std::to_string(reported) +
                                              " was written; the newest found is " +
                                              std::to_string(newest));
    campaign_.require(newest <= reported + 1, "a state from nowhere");
    ++(newest > saved ? sums.fromSnapshot : sums.fromFile);
    if (newest > saved) {
      // The user recovers it and saves.
      modeling::writeProject(states_(newest), file_);
    }
    for (const auto* some : {&list.snapshots, &list.outdated})
      for (const modeling::Snapshot& snapshot : *some) modeling::discard(snapshot);
    return newest;
  }

  /// What the killed process had begun to write tells that it was hit while writing. The program
  /// removes such files a day later.
  void removeHalves(Sums& sums) {
    for (const fs::path& folder : {file_.parent_path(), snapshots_}) {
      if (!fs::exists(folder)) continue;
      std::vector<fs::path> halves;
      for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".palpa-new") halves.push_back(entry.path());
      sums.halves += static_cast<long>(halves.size());
      for (const fs::path& half : halves) fs::remove(half);
    }
    long files = 0;
    for (const auto& entry : fs::directory_iterator(file_.parent_path()))
      files += entry.is_regular_file();
    campaign_.require(files <= 2, "files are left behind");
  }

  Campaign& campaign_;
  const States& states_;
  const fs::path file_, snapshots_;
  std::uint64_t newest_ = 0;
};

}  // namespace
}  // namespace palpa::reliability

int main(int argc, char** argv) {
  using namespace palpa::reliability;
  Campaign campaign("save_kill", argc, argv, 0, 100);
  Random random(campaign.seed());
  const States states;
  Sums sums;
  {
    const palpa::testing_support::TemporaryFolder folder;
    Kill kill(campaign, states, folder.path());
    while (campaign.next()) kill.round(random, sums);
  }
  campaign.require(sums.halves > 0 && sums.saves > 0, "no kill hit while a file was written");
  campaign.figure("kills", static_cast<double>(campaign.rounds()));
  campaign.figure("of them during writing", static_cast<double>(sums.halves));
  campaign.figure("states written", static_cast<double>(sums.saves));
  campaign.figure("newest state in the file", static_cast<double>(sums.fromFile));
  campaign.figure("in a snapshot", static_cast<double>(sums.fromSnapshot));
  return campaign.end();
}
