#include "tests/reliability/campaign.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <sstream>

namespace palpa::reliability {
namespace {

std::string shortText(double value) {
  std::ostringstream text;
  text.precision(value == std::round(value) ? 15 : 4);
  text << value;
  return text.str();
}

/// Entries of a folder; one of /proc/self/fd is the handle that reads it.
int entriesOf(const char* folder) {
  return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

[[noreturn]] void endWithUsage(const std::string& name, const std::vector<std::string>& others) {
  std::string text = "usage: " + name + " [--seconds S] [--rounds N] [--seed N]";
  for (const std::string& other : others) text += " [" + other + " VALUE]";
  std::fprintf(stderr, "%s\n", text.c_str());
  std::exit(2);
}

}  // namespace

// std::uniform_int_distribution differs between libraries.
int pick(Random& random, int least, int most) {
  return least + static_cast<int>(random() % static_cast<std::uint64_t>(most - least + 1));
}

double pickReal(Random& random, double least, double most) {
  return least + (most - least) * static_cast<double>(random() >> 11U) * 0x1p-53;
}

Usage usageNow() {
  Usage usage;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  ::malloc_trim(0);
  const struct mallinfo2 heap = ::mallinfo2();
  usage.heap = static_cast<double>(heap.uordblks + heap.hblkhd);
#endif
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != "VmRSS:") continue;
    status >> usage.resident;
    usage.resident *= 1024;
  }
  status.close();
  usage.handles = entriesOf("/proc/self/fd") - 1;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream file(thread.path() / "comm");
    std::string name;
    if (std::getline(file, name)) usage.threads.insert(name);
  }
  return usage;
}

Campaign::Campaign(const char* name, int argc, char** argv, double seconds, long rounds,
                   std::vector<std::string> others)
    : name_(name), seconds_(seconds), requestedRounds_(rounds) {
  // malloc_trim() does not return the free end of any but the first arena: with one arena per
  // thread the resident size varies by 70 MiB at constant use, with a single one by 2 MiB.
  ::mallopt(M_ARENA_MAX, 1);
  for (int i = 1; i < argc; i += 2) {
    const std::string option = argv[i];
    if (i + 1 == argc) endWithUsage(name_, others);
    const char* value = argv[i + 1];
    if (std::find(others.begin(), others.end(), option) != others.end()) {
      others_.emplace_back(option, value);
      continue;
    }
    char* rest = nullptr;
    const double number = std::strtod(value, &rest);
    if (rest == value || *rest != '\0' || !(number >= 0 && number < 1e15))
      endWithUsage(name_, others);
    if (option == "--seconds")
      seconds_ = number;
    else if (option == "--rounds")
      requestedRounds_ = static_cast<long>(number);
    else if (option == "--seed")
      seed_ = static_cast<std::uint64_t>(number);
    else
      endWithUsage(name_, others);
  }
  if (seconds_ == 0 && requestedRounds_ == 0) endWithUsage(name_, others);
}

std::optional<std::string> Campaign::option(std::string_view name) const {
  for (const auto& [option, value] : others_)
    if (option == name) return value;
  return std::nullopt;
}

double Campaign::elapsed() const {
  return std::chrono::duration<double>(Clock::now() - began_).count();
}

double Campaign::fraction() const {
  const double ofTime = seconds_ > 0 ? elapsed() / seconds_ : 0;
  const double ofRounds = requestedRounds_ > 0
                              ? static_cast<double>(rounds_) / static_cast<double>(requestedRounds_)
                              : 0;
  return std::min(1.0, std::max(ofTime, ofRounds));
}

bool Campaign::next() {
  if ((requestedRounds_ > 0 && rounds_ >= requestedRounds_) ||
      (seconds_ > 0 && elapsed() >= seconds_))
    return false;
  ++rounds_;
  return true;
}

void Campaign::fail(const std::string& what) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  ++failures_;
  std::fprintf(stderr, "%s: round %ld, seed %llu: %s\n", name_.c_str(), rounds_,
               static_cast<unsigned long long>(seed_), what.c_str());
}

bool Campaign::require(bool truth, const std::string& what) {
  if (!truth) fail(what);
  return truth;
}

void Campaign::skip(const std::string& what) {
  std::fprintf(stderr, "%s: skipped: %s\n", name_.c_str(), what.c_str());
  line_ += ", skipped: " + what;
}

void Campaign::figure(const std::string& name, double value, const std::string& unit) {
  line_ += ", " + name + " " + shortText(value) + (unit.empty() ? "" : " " + unit);
}

void Campaign::figures(const Usage& before, const Usage& after) {
  std::ostringstream text;
  text.precision(1);
  text << std::fixed << ", memory " << before.resident / kMiB << " -> " << after.resident / kMiB
       << " MiB";
  if (after.heap > 0)
    text << ", heap " << before.heap / kMiB << " -> " << after.heap / kMiB << " MiB";
  text << ", handles " << before.handles << " -> " << after.handles << ", threads "
       << before.threads.size() << " -> " << after.threads.size();
  line_ += text.str();
}

void Campaign::requireFlat(const Usage& before, const Usage& after,
                           [[maybe_unused]] double maxGrowth) {
#if !defined(__SANITIZE_ADDRESS__)
  const double heap = after.heap - before.heap, resident = after.resident - before.resident;
  require(heap <= maxGrowth, "memory in use grew by " + shortText(heap / kMiB) + " MiB");
  require(resident <= maxGrowth + kFragments,
          "the resident size grew by " + shortText(resident / kMiB) + " MiB");
#endif
  require(after.handles <= before.handles,
          "there are " + std::to_string(after.handles - before.handles) + " more open handles");
  std::vector<std::string> added;
  std::set_difference(after.threads.begin(), after.threads.end(), before.threads.begin(),
                      before.threads.end(), std::back_inserter(added));
  std::string names;
  for (const std::string& name : added) names += " \"" + name + "\"";
  require(after.threads.size() <= before.threads.size(), "there are more threads:" + names);
}

int Campaign::end() {
  std::printf("%s: rounds %ld, seconds %.1f, seed %llu, failures %d%s\n", name_.c_str(), rounds_,
              elapsed(), static_cast<unsigned long long>(seed_), failures_, line_.c_str());
  return failures_ == 0 ? 0 : 1;
}

}  // namespace palpa::reliability
