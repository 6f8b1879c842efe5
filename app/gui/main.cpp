#include <QApplication>
#include <QCommandLineParser>
#include <QLocale>
#include <QTimer>

#include "app/core/system/priority.h"
#include "app/gui/base/appearance.h"
#include "app/gui/base/application.h"
#include "app/gui/window/main_window.h"

int main(int argc, char** argv) {
  palpa::app::lowerPriorityOfLoadedThreads();
  palpa::gui::Application application(argc, argv);
  // The C locale has no separators of thousands.
  if (QLocale().language() == QLocale::C) QLocale::setDefault(QLocale(QLocale::English));
  QApplication::setApplicationName("Palpa");
  QApplication::setApplicationVersion(PALPA_VERSION);
  QApplication::setWindowIcon(QIcon(":/icons/palpa.svg"));
  QCommandLineParser parser;
  parser.setApplicationDescription("Model a solid and touch it.");
  parser.addHelpOption();
  parser.addVersionOption();
  parser.addPositionalArgument("file", "Project, CAD file or mesh to open.");
  parser.process(application);
  palpa::gui::applyTheme(application, palpa::gui::Settings().theme());
  palpa::gui::MainWindow window;
  window.show();
  QTimer::singleShot(0, &window, [&] { window.begin(parser.positionalArguments()); });
  return QApplication::exec();
}
