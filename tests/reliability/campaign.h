#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <vector>

// What the reliability campaigns (docs/reliability.md) share. Each is a program with the options
// --seconds, --rounds and --seed that prints one line of figures and ends with 0 when nothing
// failed.
namespace palpa::reliability {

using Clock = std::chrono::steady_clock;
using Random = std::mt19937_64;

/// A whole number from `least` to `most`, the same on every machine for the same seed.
int pick(Random& random, int least, int most);
/// A number from `least` to `most`.
double pickReal(Random& random, double least, double most);
/// True once in `times`.
inline bool oneIn(Random& random, int times) {
  return pick(random, 1, times) == 1;
}

/// What the process has of the system.
struct Usage {
  double resident = 0;  ///< bytes
  double heap = 0;      ///< bytes handed out by the allocator; 0 where it does not count them
  int handles = 0;      ///< open file descriptors
  std::multiset<std::string> threads;  ///< their names
};
/// Of this process, after the allocator has returned what it does not need.
Usage usageNow();

/// Bytes by which the resident size comes and goes while nothing more is in use: freed blocks
/// between others in the allocator's arenas, one for each thread that was. Some 10 MiB were seen.
constexpr double kFragments = 32.0 * 1024 * 1024;

/// One campaign: its options, its end, its failures and figures.
class Campaign {
 public:
  /// Reads --seconds, --rounds and --seed; what is absent has the value given here (0 seconds or
  /// rounds: without that limit). Ends the program with 2 and the usage when they are wrong;
  /// `others` are further options "--name VALUE".
  Campaign(const char* name, int argc, char** argv, double seconds, long rounds,
           std::vector<std::string> others = {});

  std::uint64_t seed() const { return seed_; }
  double seconds() const { return seconds_; }
  /// Of one of the further options; nothing when absent.
  std::optional<std::string> option(std::string_view name) const;

  /// Counts a round; false when there were enough or the time is over.
  bool next();
  long rounds() const { return rounds_; }
  double elapsed() const;
  /// Elapsed part of the campaign, 0 … 1.
  double fraction() const;

  /// Says what failed, with round and seed, on stderr. May be called from any thread.
  void fail(const std::string& what);
  /// fail() unless `truth`; returns `truth`.
  bool require(bool truth, const std::string& what);
  /// Says on stderr what was left out, and adds it to the figures.
  void skip(const std::string& what);
  int failures() const { return failures_; }

  /// Adds to the line of figures, in this order.
  void figure(const std::string& name, double value, const std::string& unit = {});
  /// Memory, handles and threads at two moments.
  void figures(const Usage& before, const Usage& after);
  /// Memory must be flat: a campaign fails when what the allocator has handed out grows by more
  /// than `most` bytes, when the resident size grows by more than that and kFragments, or when
  /// handles or threads were gained. Under the address sanitizer, which keeps freed blocks, its
  /// leak check stands for memory.
  void requireFlat(const Usage& before, const Usage& after, double most);

  /// Prints the line of figures; the exit code of the program.
  int end();

 private:
  const std::string name_;
  double seconds_;
  long wanted_;
  std::uint64_t seed_ = 1;
  std::vector<std::pair<std::string, std::string>> others_;
  Clock::time_point began_ = Clock::now();
  long rounds_ = 0;
  int failures_ = 0;
  std::string line_;
};

}  // namespace palpa::reliability
