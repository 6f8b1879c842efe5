// Every menu entry and every button of the tool bars and panels is used in several situations, and
// interrupted by Escape, Return, a closed dialog or a closed window, at every dialog that it opens.
// Entries and buttons are taken from the window, so that new ones take part without further ado.
// Afterwards: no open dialog, no running job, no hidden or half file, no edit lost without a
// question.
#include <QTest>
#include <algorithm>

#include "tests/reliability/interrupter.h"
#include "tests/reliability/window_process.h"

namespace palpa::reliability {
namespace {

/// Cases of one situation in a row: entering a situation takes longer than a case.
constexpr std::size_t kInARow = 12;

struct Case {
  QString target;
  Interruption interruption{};
};

/// The cases of a situation, in random order; `next`: the first that has not been tried.
struct Series {
  Situation situation{};
  std::vector<Case> cases;
  std::size_t next = 0;
};

/// `only`: part of the names of the cases that are wanted.
Series makeSeries(Interrupter& interrupter, Situation situation, const QString& only,
                  Random& random) {
  Series series{situation, {}, 0};
  for (const QString& target : interrupter.targets(situation))
    for (const Interruption interruption : kInterruptions)
      if (nameOf(situation, target, interruption).contains(only))
        series.cases.push_back({target, interruption});
  for (std::size_t k = series.cases.size(); k > 1; --k)
    std::swap(series.cases[k - 1],
              series.cases[static_cast<std::size_t>(pick(random, 0, static_cast<int>(k) - 1))]);
  return series;
}

int drive(Campaign& campaign, const QString& folder, const ActionLog& log) {
  Random random(campaign.seed());
  Interrupter interrupter(campaign, folder, log);
  const QString only = QString::fromStdString(campaign.option("--only").value_or(""));
  std::vector<Series> all;
  // Goes on where a run with the same seed and the same cases ended.
  const auto skipped = std::stoul(campaign.option("--skip").value_or("0"));
  for (const Situation situation : kSituations) {
    all.push_back(makeSeries(interrupter, situation, only, random));
    all.back().next = std::min<std::size_t>(skipped, all.back().cases.size());
  }
  long cases = 0, targets = 0;
  for (const Series& series : all) {
    cases += static_cast<long>(series.cases.size());
    targets = std::max(targets, static_cast<long>(series.cases.size() / kInterruptions.size()));
  }
  bool isMore = true;
  while (isMore) {
    isMore = false;
    for (Series& series : all)
      for (std::size_t k = 0; k < kInARow && series.next < series.cases.size(); ++k) {
        const Case& next = series.cases[series.next++];
        // Deeper and deeper: at the first dialog, at the one that follows its answer, …
        for (int depth = 0; depth < kMaxDepth; ++depth) {
          if (!campaign.next()) goto end;
          if (!interrupter.run(series.situation, next.target, next.interruption, depth)) break;
        }
        isMore = true;
      }
  }
end:
  long tried = 0;
  for (const Series& series : all)
    tried += static_cast<long>(series.next - std::min<std::size_t>(skipped, series.cases.size()));
  campaign.figure("cases", static_cast<double>(tried));
  campaign.figure("of", static_cast<double>(cases));
  campaign.figure("entries and buttons", static_cast<double>(targets));
  for (const auto& [name, count] : interrupter.counts())
    campaign.figure(name, static_cast<double>(count));
  return campaign.end();
}

}  // namespace
}  // namespace palpa::reliability

int main(int argc, char** argv) {
  using namespace palpa::reliability;
  Campaign campaign("interrupted_actions", argc, argv, 20, 0, {"--log", "--only", "--skip"});
  return runWatched(campaign, argv, [&campaign](const QString& folder, const ActionLog& log) {
    return drive(campaign, folder, log);
  });
}
