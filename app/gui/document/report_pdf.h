#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpa::gui {

/// Lays out a report on pages (A4, or Letter where the user's locale has inches) and writes them as
/// a PDF file. `body`: of report::reportBody(); `pictures`: bytes of its PNG files. Needs a
/// QGuiApplication. Throws FileError if the file cannot be written.
void writeReportPdf(const std::string& body, const std::vector<std::string>& pictures,
                    const std::string& title, const std::filesystem::path& path);

}  // namespace palpa::gui
