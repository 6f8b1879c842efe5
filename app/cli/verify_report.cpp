#include "app/cli/verify_report.h"

#include <algorithm>
#include <numeric>
#include <sstream>

#include "app/cli/text.h"

namespace palpa::cli {
namespace {

using verification::Check;
using verification::ConvergenceStep;
using verification::Omitted;
using verification::Result;

/// Columns as wide as their widest cell, two spaces apart, numbers aligned to the right.
std::string aligned(const std::vector<std::vector<std::string>>& rows,
                    const std::vector<bool>& isNumber) {
  std::vector<std::size_t> widths(isNumber.size());
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::string padding(widths[k] - row[k].size(), ' ');
      line += (k == 0 ? "" : "  ") + (isNumber[k] ? padding + row[k] : row[k] + padding);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

/// Wraps text into lines of at most kWidth characters, each after `indent` spaces.
std::string wrapped(const std::string& words, std::size_t indent) {
  constexpr std::size_t kWidth = 100;
  std::istringstream rest(words);
  std::string text, line;
  for (std::string word; rest >> word;) {
    if (!line.empty() && line.size() + 1 + word.size() > kWidth) {
      text += line + "\n";
      line.clear();
    }
    line += (line.empty() ? std::string(indent, ' ') : " ") + word;
  }
  return text + line + "\n";
}

std::vector<std::string> rowOf(const Result& result, const Check& check) {
  const bool isOrder = check.isLeast;
  return {result.name,
          result.engine,
          result.data,
          format("%d", result.coefficients),
          check.quantity,
          format(isOrder ? "%.2f" : "%.1e", check.value),
          format(isOrder ? ">= %.2f" : "<= %.1e", check.bound),
          check.passes() ? "pass" : "FAIL"};
}

Json jsonOf(const Result& result) {
  Json json{{"case", result.name},      {"engine", result.engine}, {"data", result.data},
            {"n", result.coefficients}, {"pass", result.passes()}, {"seconds", result.seconds},
            {"checks", Json::array()}};
  for (const Check& check : result.checks)
    json["checks"].push_back({{"quantity", check.quantity},
                              {check.isLeast ? "value" : "error", check.value},
                              {check.isLeast ? "least" : "tolerance", check.bound},
                              {"pass", check.passes()}});
  if (result.steps.empty()) return json;
  json["steps"] = Json::array();
  for (const ConvergenceStep& step : result.steps) {
    Json entry{{"n", step.coefficients}, {"h_mm", step.size}, {"error", step.error}};
    if (&step != &result.steps.front()) entry["order"] = step.order;
    json["steps"].push_back(entry);
  }
  return json;
}

}  // namespace

int VerifyReport::checks() const {
  return std::accumulate(results_.begin(), results_.end(), 0, [](int sum, const Result& result) {
    return sum + static_cast<int>(result.checks.size());
  });
}

int VerifyReport::failures() const {
  int count = 0;
  for (const Result& result : results_)
    for (const Check& check : result.checks) count += !check.passes();
  return count;
}

double VerifyReport::seconds() const {
  return std::accumulate(results_.begin(), results_.end(), 0.0,
                         [](double sum, const Result& result) { return sum + result.seconds; });
}

Json VerifyReport::json() const {
  Json json{{"pass", failures() == 0}, {"checks", checks()},       {"failed", failures()},
            {"seconds", seconds()},    {"results", Json::array()}, {"omitted", Json::array()}};
  for (const Result& result : results_) json["results"].push_back(jsonOf(result));
  for (const Omitted& omitted : omitted_)
    json["omitted"].push_back({{"case", omitted.name}, {"reason", omitted.reason}});
  return json;
}

std::string VerifyReport::tableOfChecks(bool all) const {
  std::vector<std::vector<std::string>> rows{
      {"case", "engine", "data", "n", "quantity", "error", "tolerance", ""}};
  for (const Result& result : results_)
    for (const Check& check : result.checks)
      if (all || !check.passes() || &check == &result.nearest())
        rows.push_back(rowOf(result, check));
  return aligned(rows, {false, false, false, true, false, true, true, false});
}

std::string VerifyReport::tablesOfSteps() const {
  std::string text;
  for (const Result& result : results_) {
    if (result.steps.empty()) continue;
    std::vector<std::vector<std::string>> rows{{"n", "h, mm", "error of u", "order"}};
    for (const ConvergenceStep& step : result.steps)
      rows.push_back({format("%d", step.coefficients), format("%.2f", step.size),
                      format("%.1e", step.error),
                      &step == &result.steps.front() ? "" : format("%.2f", step.order)});
    text +=
        "\n" + result.name + ", " + result.engine + "\n" + aligned(rows, {true, true, true, true});
  }
  return text;
}

std::string VerifyReport::omissions() const {
  if (omitted_.empty()) return {};
  std::string text = "\nNot run:\n", names;
  for (std::size_t k = 0; k < omitted_.size(); ++k) {
    names += (names.empty() ? "" : ", ") + omitted_[k].name;
    // Cases with the same reason follow each other.
    if (k + 1 < omitted_.size() && omitted_[k + 1].reason == omitted_[k].reason) continue;
    text += wrapped(names, 2) + wrapped(omitted_[k].reason, 6);
    names.clear();
  }
  return text;
}

std::string VerifyReport::text(bool all) const {
  const int count = checks(), failed = failures();
  const auto solutions = std::count_if(results_.begin(), results_.end(),
                                       [](const Result& result) { return result.engine != "-"; });
  std::string text = tableOfChecks(all) + tablesOfSteps() + omissions() + "\n";
  if (!all)
    text +=
        "Each line is the quantity that is nearest to its tolerance, or fails; --all shows all.\n";
  text += failed == 0
              ? format("All %d checks of %d solutions pass", count, static_cast<int>(solutions))
              : format("%d of %d checks FAIL", failed, count);
  return text + format(" (%.0f s).\n", seconds());
}

}  // namespace palpa::cli
