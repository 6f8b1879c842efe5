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

/// Throws ModelingError if a report of the project would be empty: if it has no touches and no
/// loads, and no support moves. `name`: of the project or its file, for the message.
void requireReportable(const modeling::Project& project, const std::string& name);

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

/// The same without style, for programs that lay it out themselves: the sources of the images are
/// pictureName() of their numbers.
std::string reportBody(const app::TouchStudy& study, const ReportSource& source,
                       const std::vector<ReportPicture>& pictures);

/// Source of the image with this number in reportBody().
std::string pictureName(std::size_t number);

}  // namespace palpa::report
