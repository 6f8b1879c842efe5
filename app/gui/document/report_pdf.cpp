#include "app/gui/document/report_pdf.h"

#include <QCoreApplication>
#include <QImage>
#include <QLocale>
#include <QPageSize>
#include <QPdfWriter>
#include <QTextBlock>
#include <QTextCursor>
#include <QTextDocument>
#include <QTextTable>
#include <QUrl>

#include "app/report/touch_report.h"
#include "base/atomic_file.h"

namespace palpa::gui {
namespace {

constexpr int kDotsPerInch = 300;
constexpr double kPictureWidth = 440;  // of a page that is 643 wide

constexpr const char* kStyle =
    "h1 { font-size: 18pt; margin-bottom: 2px; }"
    "h2 { font-size: 13pt; margin-top: 18px; margin-bottom: 6px; }"
    "h3 { font-size: 10.5pt; margin-top: 12px; margin-bottom: 4px; }"
    ".page { page-break-before: always; }"
    "p, li { font-size: 9.5pt; }"
    ".origin, .caption { font-size: 8.5pt; color: #444444; margin-bottom: 8px; }"
    "td { font-size: 8pt; }"
    "th { font-size: 7.5pt; text-align: left; }";

/// Widths of the columns in per cent: of names and values, and of touches with their numbers. The
/// columns of other tables follow their content.
QList<QTextLength> columnWidths(int columns) {
  QList<int> widths;
  if (columns == 2) widths = {26, 74};
  if (columns == 7) widths = {15, 17, 17, 14, 12, 12, 13};
  if (columns == 8) widths = {12, 14, 14, 12, 11, 10, 15, 12};
  QList<QTextLength> lengths;
  for (const int width : widths) lengths << QTextLength(QTextLength::PercentageLength, width);
  return lengths;
}

/// Lines below the rows, and the whole width of the page.
void formatTable(QTextTable& table) {
  QTextTableFormat format = table.format();
  format.setWidth(QTextLength(QTextLength::PercentageLength, 100));
  format.setBorder(0);
  format.setCellSpacing(0);
  format.setCellPadding(3);
  const QList<QTextLength> widths = columnWidths(table.columns());
  if (!widths.isEmpty()) format.setColumnWidthConstraints(widths);
  if (table.columns() > 2) format.setHeaderRowCount(1);
  table.setFormat(format);
  for (int row = 0; row < table.rows(); ++row)
    for (int column = 0; column < table.columns(); ++column) {
      QTextTableCell cell = table.cellAt(row, column);
      QTextTableCellFormat cellFormat = cell.format().toTableCellFormat();
      cellFormat.setBottomBorder(0.5);
      cellFormat.setBottomBorderStyle(QTextFrameFormat::BorderStyle_Solid);
      cellFormat.setBottomBorderBrush(QColor(0xbb, 0xbb, 0xbb));
      cell.setFormat(cellFormat);
    }
}

void formatTables(const QTextFrame& frame) {
  for (QTextFrame* child : frame.childFrames()) {
    if (auto* table = qobject_cast<QTextTable*>(child)) formatTable(*table);
    formatTables(*child);
  }
}

void sizePictures(QTextDocument& document) {
  for (QTextBlock block = document.begin(); block.isValid(); block = block.next())
    for (auto it = block.begin(); !it.atEnd(); ++it) {
      if (!it.fragment().charFormat().isImageFormat()) continue;
      QTextImageFormat format = it.fragment().charFormat().toImageFormat();
      format.setWidth(kPictureWidth);
      QTextCursor cursor(&document);
      cursor.setPosition(it.fragment().position());
      cursor.setPosition(it.fragment().position() + it.fragment().length(),
                         QTextCursor::KeepAnchor);
      cursor.setCharFormat(format);
      break;  // a block with a picture has nothing else
    }
}

}  // namespace

void writeReportPdf(const std::string& body, const std::vector<std::string>& pictures,
                    const std::string& title, const std::filesystem::path& path) {
  QTextDocument document;
  QFont font("Sans Serif");
  font.setPointSizeF(9.5);
  document.setDefaultFont(font);
  document.setDefaultStyleSheet(kStyle);
  for (std::size_t k = 0; k < pictures.size(); ++k)
    document.addResource(QTextDocument::ImageResource,
                         QUrl(QString::fromStdString(report::pictureName(k))),
                         QImage::fromData(QByteArray::fromStdString(pictures[k]), "PNG"));
  document.setHtml(QString::fromStdString(body));
  formatTables(*document.rootFrame());
  sizePictures(document);

  {
    QPdfWriter writer(QString::fromStdString(path.string()));
    writer.setResolution(kDotsPerInch);
    writer.setTitle(QString::fromStdString(title));
    writer.setCreator(QCoreApplication::applicationName() + " " +
                      QCoreApplication::applicationVersion());
    const bool isMetric = QLocale().measurementSystem() == QLocale::MetricSystem;
    writer.setPageSize(QPageSize(isMetric ? QPageSize::A4 : QPageSize::Letter));
    document.print(&writer);  // with margins and page numbers
  }
  std::error_code error;
  if (!std::filesystem::exists(path, error) || std::filesystem::file_size(path, error) == 0)
    throw FileError(path.string() + ": the PDF cannot be written; check the space on the disk");
}

}  // namespace palpa::gui
