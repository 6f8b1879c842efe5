// Text of reports: what users wrote, and numbers with their errors.
#include <gtest/gtest.h>

#include <clocale>
#include <string>

#include "app/report/html.h"
#include "app/report/numbers.h"
#include "app/report/text.h"

namespace palpa::report {
namespace {

TEST(ReportText, TextOfUsersIsNeverMarkup) {
  EXPECT_EQ(escaped("a < b && c > 'd' \"e\""),
            "a &lt; b &amp;&amp; c &gt; &#39;d&#39; &quot;e&quot;");
  EXPECT_EQ(escaped("Größe µm, 指"), "Größe µm, 指");
  EXPECT_EQ(escaped("line\nand\ttab"), "line\nand\ttab");
}

TEST(ReportText, BytesThatAreNoTextBecomeReplacementCharacters) {
  const std::string sign = "\xEF\xBF\xBD";
  EXPECT_EQ(escaped(std::string("a\0b\x1b\x7f", 5)), "a" + sign + "b" + sign + sign);
  EXPECT_EQ(escaped("\xff<"), sign + "&lt;");
  EXPECT_EQ(escaped("\xc3"), sign) << "cut off";
  EXPECT_EQ(escaped("\xe2\x82<"), sign + sign + "&lt;") << "the '<' is no continuation";
  EXPECT_EQ(escaped("\xc0\xbc"), sign + sign) << "an overlong '<'";
  EXPECT_EQ(escaped("\xed\xa0\x80"), sign + sign + sign) << "half of a surrogate pair";
  EXPECT_EQ(escaped("\xf0\x9f\x96\x90"), "\xf0\x9f\x96\x90");
}

TEST(ReportText, TablesEscapeCellsAndNames) {
  HtmlTable table({"Touch", "Force \"F\" <N>"});
  table.add({"<b>", "1 & 2"});
  const std::string html = table.html();
  EXPECT_EQ(html.find("<b>"), std::string::npos);
  EXPECT_NE(html.find("data-name=\"Force &quot;F&quot; &lt;N&gt;\""), std::string::npos) << html;
  EXPECT_NE(html.find("1 &amp; 2"), std::string::npos);
}

TEST(ReportText, NumbersEndAtTheirError) {
  EXPECT_EQ(withError(4.7212, 0.01), "4.72 ± 0.05");
  EXPECT_EQ(withError(-4.7212, 0.01), "-4.72 ± 0.05");
  EXPECT_EQ(withError(0, 0.01), "0");
  EXPECT_EQ(withError(4.7212, 1e15), "5 ± more than 100 %");
  EXPECT_EQ(withError(0.36056, 0), "0.3606");
  EXPECT_EQ(rounded(Eigen::Vector3d(0.0004, 0, -2.3312), 0.02), "(0, 0, -2.33)");
}

TEST(ReportText, NumbersHaveAPointInAnyLocale) {
  // The thread's locale wins over the process's, which Qt sets.
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "C"}) {
    if (!std::setlocale(LC_NUMERIC, name)) continue;
    {
      const PlainNumbers plain;
      EXPECT_EQ(format("%.2f", 1.5), "1.50") << name;
      EXPECT_EQ(withError(4.7212, 0.01), "4.72 ± 0.05") << name;
    }
    // Afterwards the process's locale is back.
    const std::string comma = std::localeconv()->decimal_point;
    EXPECT_EQ(format("%.2f", 1.5), "1" + comma + "50") << name;
  }
  std::setlocale(LC_NUMERIC, "C");
}

}  // namespace
}  // namespace palpa::report
