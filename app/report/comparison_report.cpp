#include "app/report/comparison_report.h"

#include <algorithm>
#include <filesystem>

#include "app/core/results/largest_displacement.h"
#include "app/report/common_view.h"
#include "app/report/html.h"
#include "app/report/html_document.h"
#include "app/report/numbers.h"
#include "app/report/report_sections.h"
#include "app/report/state_picture.h"
#include "app/report/state_words.h"
#include "app/report/text.h"

namespace palpa::report {
namespace {

constexpr std::array kLetters{"A", "B"};
/// Relative error that stands for four digits, of numbers without an estimate.
constexpr double kFourDigits = 5e-4;

std::string nameOf(const ComparedVariants& variants, std::size_t k) {
  return std::filesystem::path(variants.files[k]).filename().string();
}

std::string variantsTable(const ComparedVariants& of) {
  HtmlTable table({"", "A", "B"});
  const auto add = [&](const std::string& name, const auto& text) {
    table.add({name, text(0), text(1)});
  };
  // The name alone: a page is passed on, and folders are private.
  add("File", [&](std::size_t k) { return nameOf(of, k); });
  add("Name", [&](std::size_t k) { return of.projects[k].name; });
  add("Material", [&](std::size_t k) {
    const modeling::Material& material = of.projects[k].material;
    return (material.name.empty() ? "" : material.name + ", ") +
           format("E = %.4g MPa, ν = %.4g", material.youngsModulus, material.poissonRatio);
  });
  add("Source of the constants",
      [&](std::size_t k) { return materialSource(of.projects[k].material); });
  add("Mesh", [&](std::size_t k) { return meshText(*of.models[k]); });
  add("Accuracy", [&](std::size_t k) {
    const app::TouchState& state = of.comparison.states[k].state;
    return state.errorEstimate.value_or(0) > 0 ? accuracyText(state) : std::string("not estimated");
  });
  add("Sum of all forces",
      [&](std::size_t k) { return balanceText(of.comparison.states[k].state); });
  return table.html();
}

std::string touchesTable(const app::Comparison& comparison) {
  HtmlTable table({"Touch", "Given", "Place on A, mm", "Place on B, mm", "Distance, mm"});
  for (std::size_t k = 0; k < comparison.touches.size(); ++k) {
    const app::CarriedTouch& carried = comparison.carried[k];
    table.add({comparison.touches[k].name, givenText(comparison.touches[k]),
               toText(comparison.touches[k].at, 4), toText(carried.touch.at, 4),
               format("%.3g", carried.distance) +
                   (carried.isTurned ? ", on a side that faces away" : "")});
  }
  return table.isEmpty() ? element("p", "None: the loads act alone.") : table.html();
}

/// True for a force or motion that the touch prescribes: it has no error.
bool isGiven(const app::ComparisonRow& row, const app::Comparison& comparison) {
  if (row.part != app::ComparisonRow::Part::kContact) return false;
  for (const modeling::Touch& touch : comparison.touches) {
    if (touch.name != row.name) continue;
    const modeling::TouchKindInfo& kind = modeling::infoOf(touch.kind);
    const auto given = kind.isForce ? app::ComparedFigure::kForce : app::ComparedFigure::kMoved;
    return row.figure == given && !kind.presses && !app::isPassive(touch);
  }
  return false;
}

std::string valueCell(const app::ComparisonRow& row, std::size_t k, bool isGiven) {
  if (!row.values[k]) return "–";
  if (isGiven || !(row.errors[k].value_or(0) > 0)) return rounded(*row.values[k], kFourDigits);
  return withError(*row.values[k], *row.errors[k]);
}

std::string partName(const app::ComparisonRow& row) {
  switch (row.part) {
    case app::ComparisonRow::Part::kContact:
      return "Touch “" + row.name + "”";
    case app::ComparisonRow::Part::kSupport:
      return "Support “" + row.name + "”";
    case app::ComparisonRow::Part::kBody:
      break;
  }
  return "Body";
}

std::string figuresTable(const app::Comparison& comparison) {
  HtmlTable table({"Figure", "A", "B", "B − A", "B/A − 1", ""});
  for (const app::ComparisonRow& row : comparison.rows()) {
    const app::ComparedFigureInfo& info = app::infoOf(row.figure);
    const bool given = isGiven(row, comparison);
    const auto difference = row.difference(), relative = row.relativeDifference();
    table.add(
        {partName(row) + ": " + info.label + ", " + info.unit, valueCell(row, 0, given),
         valueCell(row, 1, given), difference ? rounded(*difference, kFourDigits) : "–",
         relative ? format("%+.1f %%", 100 * *relative) : "–",
         difference.value_or(0) != 0 && row.isWithinErrors() ? "within the estimated errors" : ""});
  }
  return table.html();
}

}  // namespace

std::array<view::Picture, 2> comparisonPictures(const ComparedVariants& variants) {
  const PlainNumbers plain;
  std::array<view::Picture, 2> pictures;
  CommonView common;
  for (std::size_t k = 0; k < 2; ++k) {
    pictures[k] = makePicture(variants.projects[k], variants.models[k],
                              variants.comparison.states[k].state, {});
    pictures[k].caption.title = std::string(kLetters[k]) + ": " + nameOf(variants, k);
    common.add(pictures[k]);
  }
  common.finish();
  for (view::Picture& picture : pictures) common.applyTo(picture);
  return pictures;
}

std::string comparisonDocument(const ComparedVariants& variants, const ReportSource& source,
                               const std::array<std::string, 2>& pictures) {
  const PlainNumbers plain;
  const std::string title = nameOf(variants, 0) + " and " + nameOf(variants, 1);
  std::string html =
      element("h1", escaped(title)) + element("p",
                                              escaped("Comparison under the same touches, " +
                                                      source.date + ", Palpa " + source.version),
                                              "class=origin");
  std::string both;
  for (std::size_t k = 0; k < 2; ++k)
    both += figure(dataSource(pictures[k]), std::string(kLetters[k]) + ": " + nameOf(variants, k));
  html += element("div", both, "class=pair") +
          element("p",
                  "Both pictures have the same view, the same colours (length of the displacement) "
                  "and the same scale of arrows (forces on the body).",
                  "class=origin");
  html += element("h2", "Figures") + figuresTable(variants.comparison);
  html += element("p", escaped(format("%.0f %% of A’s surface has a point of B within %.3g mm.",
                                      100 * variants.share, variants.reach)));
  html += element("h2", "Touches") + touchesTable(variants.comparison);
  html += element("h2", "Variants") + variantsTable(variants);
  double share = 0;
  for (std::size_t k = 0; k < 2; ++k)
    share = std::max(
        share,
        app::largestDisplacement(*variants.models[k], variants.comparison.states[k].state).length /
            variants.models[k]->setup().mesh().boundingSize());
  html += element("section", element("h2", "What the models assume") + list(assumptions(share)));
  return documentOf(title + ": comparison", html);
}

}  // namespace palpa::report
