// Full disks, folders and files that may not be written or read, damaged files of the cache and of
// autosave: every one ends in an error that names the file, what was there before is unchanged, and
// work goes on once the trouble is over.
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>

#include "app/core/session/new_project.h"
#include "app/core/session/session.h"
#include "modeling/error.h"
#include "modeling/exchange/cad_export.h"
#include "modeling/project/project_file.h"
#include "modeling/shapes/primitives.h"
#include "tests/modeling/child_process.h"
#include "tests/reliability/campaign.h"

namespace palpa::reliability {
namespace {

namespace fs = std::filesystem;
using modeling::ModelingError;
using modeling::Project;
using testing_support::TemporaryFolder;

constexpr uid_t kNobody = 65534;
constexpr int kSkipped = 77;

std::string contentOf(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// A sphere with 6 · points² control points: about 40 bytes each in its file.
Project sphereOf(int points) {
  return app::makeProject(modeling::makeSphere(25, points), "sphere " + std::to_string(points));
}

/// Names and contents of all files below a folder.
std::map<std::string, std::string> everythingIn(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[entry.path().string()] = contentOf(entry.path());
  return files;
}

/// Runs `work` in a child, whose rights and limits it may spoil; it returns what is wrong, empty
/// when nothing is, or throws. True unless the child says it cannot be tried here.
bool inChild(Campaign& campaign, const std::string& name,
             const std::function<std::string()>& work) {
  std::fflush(nullptr);
  const pid_t child = testing_support::startChild([&] {
    std::string wrong;
    try {
      wrong = work();
    } catch (const std::exception& error) {
      wrong = error.what();
    }
    if (wrong == "skip") ::_exit(kSkipped);
    if (!wrong.empty()) std::fprintf(stderr, "%s: %s\n", name.c_str(), wrong.c_str());
    ::_exit(wrong.empty() ? 0 : 1);
  });
  const int result = testing_support::resultOf(child);
  if (result == kSkipped) return false;
  campaign.require(result == 0, name + (result == -1 ? " crashed" : " went wrong"));
  return true;
}

/// What a failed save says; a problem when it succeeds, is of another kind, or does not name the
/// file.
std::string complaintOf(const std::function<void()>& work, const fs::path& path) {
  try {
    work();
  } catch (const ModelingError& error) {
    if (error.kind() != ModelingError::Kind::kIo)
      return "wrong kind of error: " + std::string(error.what());
    if (std::string(error.what()).find(path.string()) == std::string::npos)
      return "the message does not name the file: " + std::string(error.what());
    return {};
  }
  return path.string() + " was written in spite of everything";
}

/// Saves, autosaves and exports where nothing of that size can be written. The files there must be
/// as before, and none may be added.
std::string everythingIsRefused(const fs::path& folder, const Project& larger) {
  const auto before = everythingIn(folder);
  const auto& solid = std::get<modeling::Solid>(larger.body);
  for (const auto& [path, work] : std::map<fs::path, std::function<void(const fs::path&)>>{
           {folder / "work.json", [&](const fs::path& to) { modeling::writeProject(larger, to); }},
           {folder / "new.json", [&](const fs::path& to) { modeling::writeProject(larger, to); }},
           {folder / "snapshots",
            [&](const fs::path& to) { modeling::Autosave(to).write(larger, "", 2); }},
           {folder / "new.step", [&](const fs::path& to) { modeling::exportCad(solid, to); }}}) {
    const std::string wrong = complaintOf([&] { work(path); }, path);
    if (!wrong.empty()) return wrong;
  }
  if (everythingIn(folder) != before) return "files have changed or were left behind";
  if (modeling::toJson(modeling::readProject(folder / "work.json")) !=
      before.at((folder / "work.json").string()))
    return "the project is not what it was";
  return {};
}

void prepare(const fs::path& folder) {
  modeling::writeProject(sphereOf(7), folder / "work.json");
  modeling::Autosave(folder / "snapshots").write(sphereOf(7), "", 1);
}

void tell(const char* file, const std::string& text) {
  std::ofstream(file) << text;
}

/// From now on mounts are seen by this process alone: as root, or as root of a name space of its
/// own where the system lets people make one.
bool separateMounts() {
  const auto user = std::to_string(::geteuid());
  const auto group = std::to_string(::getegid());
  if (::unshare(CLONE_NEWNS) != 0) {
    if (::unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
    tell("/proc/self/setgroups", "deny");
    tell("/proc/self/uid_map", "0 " + user + " 1");
    tell("/proc/self/gid_map", "0 " + group + " 1");
  }
  return ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
}

bool mountSmallDisk(const fs::path& folder, const char* size) {
  return separateMounts() && ::mount("tmpfs", folder.c_str(), "tmpfs", 0, size) == 0;
}

/// Fills a disk up to `left` bytes.
void fill(const fs::path& folder, std::size_t left) {
  struct statvfs state {};
  ::statvfs(folder.c_str(), &state);
  const std::size_t free = state.f_bsize * state.f_bfree;
  std::ofstream(folder / "filler", std::ios::binary)
      << std::string(free > left ? free - left : 0, 'x');
}

bool fullDisk(Campaign& campaign, Random& random) {
  const std::size_t left = static_cast<std::size_t>(pick(random, 0, 10)) * 4096;
  const int points = pick(random, 20, 30);
  return inChild(campaign, "full disk", [&]() -> std::string {
    const TemporaryFolder folder;
    if (!mountSmallDisk(folder.path(), "size=1m")) return "skip";
    prepare(folder.path());
    fill(folder.path(), left);
    std::string wrong = everythingIsRefused(folder.path(), sphereOf(points));
    fs::remove(folder / "filler");
    if (wrong.empty()) {
      modeling::writeProject(sphereOf(9), folder / "work.json");
      if (modeling::readProject(folder / "work.json").name != "sphere 9")
        wrong = "saving does not work again";
    }
    ::umount2(folder.path().c_str(), MNT_DETACH);
    return wrong;
  });
}

/// A limit on the size of files stands for a disk that becomes full: the write stops half-way.
void fileLimit(Campaign& campaign, Random& random) {
  const auto limit = static_cast<rlim_t>(pick(random, 0, 30000));
  inChild(campaign, "limited file size", [&]() -> std::string {
    const TemporaryFolder folder;
    prepare(folder.path());
    ::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    ::getrlimit(RLIMIT_FSIZE, &before);
    const rlimit limited{limit, before.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limited);
    std::string wrong = everythingIsRefused(folder.path(), sphereOf(25));
    ::setrlimit(RLIMIT_FSIZE, &before);
    if (wrong.empty()) modeling::writeProject(sphereOf(9), folder / "work.json");
    return wrong;
  });
}

/// Becomes somebody without rights where root's would reach everywhere.
bool dropRights() {
  return ::geteuid() != 0 || (::setgid(kNobody) == 0 && ::setuid(kNobody) == 0);
}

void closedFolder(Campaign& campaign, Random& random) {
  const int points = pick(random, 7, 12);
  inChild(campaign, "closed folder", [&]() -> std::string {
    const TemporaryFolder folder;
    prepare(folder.path());
    // The message of autosave names the folder when that cannot be made, and the file otherwise.
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
      fs::permissions(entry.path(), fs::perms::others_read | fs::perms::group_read |
                                        fs::perms::owner_read | fs::perms::others_exec |
                                        fs::perms::group_exec | fs::perms::owner_exec);
    ::chmod(folder.path().c_str(), 0555);
    std::fflush(nullptr);
    // As another user, in a child process, so that this process can clean up.
    const pid_t other = testing_support::startChild([&] {
      if (!dropRights()) ::_exit(kSkipped);
      const std::string wrong = everythingIsRefused(folder.path(), sphereOf(points));
      if (!wrong.empty()) std::fprintf(stderr, "closed folder: %s\n", wrong.c_str());
      ::_exit(wrong.empty() ? 0 : 1);
    });
    const int result = testing_support::resultOf(other);
    ::chmod(folder.path().c_str(), 0755);
    fs::permissions(folder / "snapshots", fs::perms::owner_all);
    if (result == kSkipped) return "skip";
    return result == 0 ? "" : "see above";
  });
}

/// Reading what may not be read says so.
void closedFile(Campaign& campaign) {
  inChild(campaign, "closed file", [&]() -> std::string {
    const TemporaryFolder folder;
    ::chmod(folder.path().c_str(), 0755);
    modeling::writeProject(sphereOf(7), folder / "work.json");
    ::chmod((folder / "work.json").c_str(), 0);
    const pid_t other = testing_support::startChild([&] {
      if (!dropRights()) ::_exit(kSkipped);
      const std::string wrong =
          complaintOf([&] { modeling::readProject(folder / "work.json"); }, folder / "work.json");
      if (!wrong.empty()) std::fprintf(stderr, "closed file: %s\n", wrong.c_str());
      ::_exit(wrong.empty() ? 0 : 1);
    });
    const int result = testing_support::resultOf(other);
    return result == kSkipped ? "skip" : result == 0 ? "" : "see above";
  });
}

/// Changes bytes, cuts, lengthens or replaces a file.
void spoil(const fs::path& file, Random& random) {
  std::string content = contentOf(file);
  const auto place = [&] { return random() % std::max<std::size_t>(content.size(), 1); };
  switch (pick(random, 0, 5)) {
    case 0:
      content.resize(place());
      break;
    case 1:
      content += std::string(static_cast<std::size_t>(pick(random, 1, 5000)), '\1');
      break;
    case 2:
      content = std::string(content.size(), '\0');
      break;
    case 3:
      std::fill_n(content.begin() + static_cast<std::ptrdiff_t>(content.size() / 2),
                  content.size() / 4, '\0');
      break;
    default:
      // In the head half of the time.
      for (int k = pick(random, 1, 4); k > 0; --k) {
        const std::size_t at = oneIn(random, 2) ? place() % 64 : place();
        content[at % content.size()] ^=
            static_cast<char>(1U << static_cast<unsigned>(pick(random, 0, 7)));
      }
  }
  std::ofstream(file, std::ios::binary | std::ios::trunc) << content;
}

/// Damaged solved models on disk: the model is built again, and the file is deleted.
class Cache {
 public:
  explicit Cache(Campaign& campaign) : campaign_(campaign) {
    project_ = sphereOf(7);
    project_.mesh.engine = modeling::Engine::kTriangles;
    project_.mesh.edgeLength = 8;
    options_.cache = std::make_shared<app::ModelCache>(folder_.path() / "cache", 1e9);
    built_ = app::buildTouchModel(project_, {}, {});
  }

  void round(Random& random) {
    fs::remove_all(folder_ / "cache");
    if (!campaign_.require(options_.cache->write(built_->key(), *built_->problem(), {}),
                           "the cache: " + options_.cache->trouble()))
      return;
    const fs::path file = fs::directory_iterator(folder_ / "cache")->path();
    const std::string whole = contentOf(file);
    spoil(file, random);
    const bool isSpoiled = contentOf(file) != whole;
    const auto model = app::buildTouchModel(project_, options_, {});
    campaign_.require(
        model->rest().energy == built_->rest().energy && model->problem()->conditionEstimate() > 0,
        "a damaged file of the cache was used");
    campaign_.require((model->report().readSeconds == 0) == isSpoiled,
                      "a damaged file of the cache was read, or a good one was not");
    campaign_.require(model->report().notice.empty() != isSpoiled,
                      "nothing is said about a damaged file");
    campaign_.require(fs::exists(file) != isSpoiled, "a damaged file stays");
  }

 private:
  Campaign& campaign_;
  const TemporaryFolder folder_;
  Project project_;
  app::BuildOptions options_;
  std::shared_ptr<const app::TouchModel> built_;
};

/// One of two snapshots is damaged: the other is offered, and neither stops the program.
void damagedSnapshot(Campaign& campaign, Random& random) {
  const TemporaryFolder folder;
  std::fflush(nullptr);
  for (int k = 0; k < 2; ++k)
    testing_support::resultOf(testing_support::startChild(
        [&] { modeling::Autosave(folder.path()).write(sphereOf(7 + k), "", 1); }));
  const auto list = [&] { return modeling::findRecoverable(folder.path()); };
  const auto before = list();
  if (!campaign.require(before.snapshots.size() == 2, "two snapshots are offered")) return;
  spoil(before.snapshots.front().file, random);
  const std::string good = modeling::toJson(modeling::recover(before.snapshots.back()));
  bool isThere = false;
  const modeling::RecoveryList after = list();
  for (const modeling::Snapshot& snapshot : after.snapshots) {
    const std::string text = modeling::toJson(modeling::recover(snapshot));  // must not throw
    isThere |= snapshot.file == before.snapshots.back().file && text == good;
  }
  campaign.require(isThere, "a good snapshot is not offered beside a damaged one");
  for (const std::string& problem : after.problems)
    campaign.require(problem.find(folder.path().string()) == 0, "a problem does not name its file");
}

}  // namespace
}  // namespace palpa::reliability

int main(int argc, char** argv) {
  using namespace palpa::reliability;
  Campaign campaign("disk_trouble", argc, argv, 0, 12);
  Random random(campaign.seed());
  ::umask(022);
  Cache cache(campaign);
  long onSmallDisks = 0, inCache = 0;
  while (campaign.next()) {
    onSmallDisks += fullDisk(campaign, random) ? 1 : 0;
    fileLimit(campaign, random);
    closedFolder(campaign, random);
    closedFile(campaign);
    damagedSnapshot(campaign, random);
    for (int k = 0; k < 4; ++k, ++inCache) cache.round(random);
  }
  campaign.figure("full disks", static_cast<double>(onSmallDisks));
  campaign.figure("limited files, closed folders, closed files, damaged snapshots: each",
                  static_cast<double>(campaign.rounds()));
  campaign.figure("damaged cache files", static_cast<double>(inCache));
  if (onSmallDisks == 0) campaign.skip("small disks: this system lets nobody here mount one");
  return campaign.end();
}
