#pragma once

#include <string>
#include <vector>

#include "app/core/results/touch_study.h"
#include "app/view/viewport/picture.h"

// Report of a project with its touches: pictures, tables and notes as one HTML document.
namespace palpa::report {

/// What a report states besides the study.
struct ReportSource {
  std::string file;                  ///< of the project; empty: it has none
  std::string version;               ///< of Palpa
  std::string date;                  ///< when the report was made, see dateNow()
  std::vector<std::string> notes{};  ///< for the reader, as of the import; plain text
};

/// "25 November 2026, 09:40", in local time.
std::string dateNow();

/// False if a report of the project would be empty: if it has no touches and no loads, and no
/// support moves.
bool isReportable(const modeling::Project& project);

/// A picture of a report, to be drawn by view::pictureBytes(), with a caption in plain text.
struct ReportPicture {
  view::Picture picture;
  std::string caption;
};

/// Pixels of the pictures.
inline constexpr view::PictureSize kReportPictureSize{1200, 900};

/// The body at rest; each touch; all touches together, if there are several. Colours: length of the
/// displacement, from 0 to the largest one of each picture.
std::vector<ReportPicture> reportPictures(const app::TouchStudy& study);

/// The report as an HTML document that needs no other file: pictures and style are inside, for
/// light and dark screens, phones and paper. `pictures`: of reportPictures(), as bytes of PNG
/// files.
std::string reportDocument(const app::TouchStudy& study, const ReportSource& source,
                           const std::vector<ReportPicture>& pictures,
                           const std::vector<std::string>& files);

/// The content alone, in elements that Qt's text documents know: h1 to h3, p, ul, table, img and
/// div. The sources of the images are pictureName() of their numbers. Classes: "origin" and
/// "caption" of p, "page" of the h2 that begin a page on paper, "facts" (name, value) and "cases"
/// of tables.
std::string reportBody(const app::TouchStudy& study, const ReportSource& source,
                       const std::vector<ReportPicture>& pictures);

/// Source of the image with this number in reportBody().
std::string pictureName(std::size_t number);

}  // namespace palpa::report
