#include "app/report/html_document.h"

#include "app/core/page/touch_page_file.h"
#include "app/report/html.h"

namespace palpa::report {

extern const char* const kReportStyle;  // resources/report/style.css

std::string figure(const std::string& source, const std::string& caption) {
  return element("figure", "<img src=\"" + source + "\" alt=\"" + escaped(caption) + "\">\n" +
                               element("figcaption", escaped(caption)));
}

std::string list(const std::vector<std::string>& items) {
  std::string html;
  for (const std::string& item : items) html += element("li", escaped(item));
  return element("ul", html);
}

std::string dataSource(const std::string& png) {
  return "data:image/png;base64," + app::base64(png);
}

std::string documentOf(const std::string& title, const std::string& content) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src "
         "data:; "
         "style-src 'unsafe-inline'\">\n" +
         element("title", escaped(title)) + element("style", kReportStyle) + "</head>\n<body>\n" +
         element("main", content) + "</body>\n</html>\n";
}

}  // namespace palpa::report
