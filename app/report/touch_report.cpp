#include "app/report/touch_report.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <string_view>

#include "app/report/html.h"
#include "app/report/html_document.h"
#include "app/report/report_sections.h"
#include "app/report/state_picture.h"
#include "app/report/text.h"

namespace palpa::report {

namespace {

/// A state with a section in the report.
struct Section {
  std::string title;
  const app::TouchState* state;
};

/// The touches alone, then together: the order of the pictures after the first.
std::vector<Section> sectionsOf(const app::TouchStudy& study) {
  std::vector<Section> sections;
  const std::vector<modeling::Touch>& touches = study.project.touches;
  for (const app::TouchStudy::Single& each : study.alone)
    sections.push_back({"Touch “" + touches[each.touch].name + "” alone", &each.state});
  if (touches.size() == 1)
    sections.push_back({"Touch “" + touches.front().name + "”", &study.together});
  else if (!touches.empty())
    sections.push_back({"All touches at the same time", &study.together});
  return sections;
}

std::string nameOf(const modeling::Project& project) {
  return project.name.empty() ? "Project without a name" : project.name;
}

template <class SourceOf>
std::string content(const app::TouchStudy& study, const ReportSource& source,
                    const std::vector<ReportPicture>& pictures, const SourceOf& sourceOf) {
  const PlainNumbers plain;
  const auto picture = [&](std::size_t k) {
    return k < pictures.size() ? figure(sourceOf(k), pictures[k].caption) : std::string();
  };
  std::string html =
      element("h1", escaped(nameOf(study.project))) +
      element("p",
              escaped("Report of touches, " + source.date + ", Palpa " + source.version +
                      (source.file.empty() ? "" : ", from " + source.file)),
              "class=origin");
  html += picture(0);
  html += element("h2", "Touches") + touchTables(study);
  html += element("h2", "Body and model", "class=page") + modelTables(study);
  const bool isMoved = study.rest.energy > 0;
  html +=
      element("section", element("h3", "Without touches") +
                             (isMoved ? stateTable(*study.model, study.rest)
                                      : element("p", "Nothing acts on the body; nothing moves.")));
  const std::vector<Section> sections = sectionsOf(study);
  for (std::size_t k = 0; k < sections.size(); ++k)
    html += element("section", element("h2", escaped(sections[k].title), "class=page") +
                                   picture(k + 1) + stateTable(*study.model, *sections[k].state));
  const std::vector<std::string> findings = notices(study, source.notes);
  html += element("section", element("h2", "Notices", "class=page") +
                                 (findings.empty() ? element("p", "None.") : list(findings)));
  return html + element("section", element("h2", "What the model assumes") +
                                       list(assumptions(largestShare(study))));
}

}  // namespace

std::string dateNow() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  localtime_r(&now, &parts);
  static constexpr const char* kMonths[] = {"January",   "February", "March",    "April",
                                            "May",       "June",     "July",     "August",
                                            "September", "October",  "November", "December"};
  return format("%d %s %d, %02d:%02d", parts.tm_mday, kMonths[parts.tm_mon], 1900 + parts.tm_year,
                parts.tm_hour, parts.tm_min);
}

bool isReportable(const modeling::Project& project) {
  return !project.touches.empty() || !project.loads.empty() ||
         std::any_of(project.supports.begin(), project.supports.end(),
                     [](const modeling::Support& each) { return !each.displacement.isZero(0); });
}

std::vector<ReportPicture> reportPictures(const app::TouchStudy& study) {
  const PlainNumbers plain;
  const auto drawn = [&](const app::TouchState& state, const PictureOptions& options) {
    return makePicture(study.project, study.model, state, options);
  };
  std::vector<ReportPicture> pictures;
  PictureOptions atRest;
  const bool isMoved = study.rest.energy > 0;
  if (!isMoved) atRest.field = app::SurfaceQuantity::kNone;
  pictures.push_back({drawn(study.rest, atRest),
                      isMoved
                          ? "Without touches: the loads deform the body. Colours: length of the "
                            "displacement; hatched: supports."
                          : "The body at rest. Hatched: supports."});
  for (const Section& section : sectionsOf(study))
    pictures.push_back({drawn(*section.state, {}),
                        section.title +
                            ": deformed, beside its shape at rest. Colours: length of the "
                            "displacement; arrows: forces on the body."});
  return pictures;
}

std::string pictureName(std::size_t number) {
  return "picture-" + std::to_string(number);
}

std::string reportBody(const app::TouchStudy& study, const ReportSource& source,
                       const std::vector<ReportPicture>& pictures) {
  std::string html = content(study, source, pictures, pictureName);
  // Text of users has no '<'.
  constexpr std::array<std::array<std::string_view, 2>, 6> kElements{
      {{"<figure>", "<div>"},
       {"</figure>", "</div>"},
       {"<figcaption>", "<p class=caption>"},
       {"</figcaption>", "</p>"},
       {"<section>", "<div>"},
       {"</section>", "</div>"}}};
  for (const auto& [from, to] : kElements)
    for (std::size_t at = html.find(from); at != std::string::npos;
         at = html.find(from, at + to.size()))
      html.replace(at, from.size(), to);
  return html;
}

std::string reportDocument(const app::TouchStudy& study, const ReportSource& source,
                           const std::vector<ReportPicture>& pictures,
                           const std::vector<std::string>& files) {
  return documentOf(
      nameOf(study.project) + ": report of touches",
      content(study, source, pictures, [&](std::size_t k) { return dataSource(files.at(k)); }));
}

}  // namespace palpa::report
