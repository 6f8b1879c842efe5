#include "tests/gui/films.h"

#include <QFile>
#include <QImage>
#include <map>
#include <numbers>

#include "app/gui/base/canvas.h"
#include "app/view/charts/force_plot.h"
#include "tests/gui/photographer.h"

namespace palpa::gui {
namespace {

const QSize kFrame(520, 400);
constexpr int kAnswer = 120;  // ms until the forces of a motion are computed and drawn

class Camera {
 public:
  Camera(Photographer& photographer, const QString& name)
      : photographer_(photographer), folder_(photographer.folder() + "/" + name) {
    QDir(folder_).removeRecursively();
    QDir().mkpath(folder_);
  }
  void shoot() {
    QTest::qWait(kAnswer);
    const QString file = QString("%1/%2.png").arg(folder_).arg(count_++, 3, 10, QChar('0'));
    photographer_.window().viewport().writePicture(file.toStdString(), kFrame);
  }
  ~Camera() { std::printf("%s: %d pictures\n", qPrintable(folder_), count_); }

 private:
  Photographer& photographer_;
  QString folder_;
  int count_ = 0;
};

QPoint onCircle(QPoint middle, double radius, double turn) {
  const double angle = 2 * std::numbers::pi * turn;
  return middle + QPoint(static_cast<int>(std::lround(radius * std::sin(angle))),
                         static_cast<int>(std::lround(radius * (1 - std::cos(angle)))));
}

void open(Photographer& p, const QString& project, const QString& tool) {
  p.open(project);
  p.simulate(tool);
  (void)QTest::qWaitFor([&] { return p.window().simulation().columns().columnsReady >= 1; },
                        120000);
  p.window().viewport().viewport().fit();
}

/// Visible place of the body nearest to a given pixel.
QPoint onBody(Photographer& p, QPoint wish) {
  ViewportWidget& view = p.window().viewport();
  constexpr int kStep = 4, kMaxPictures = 400;
  for (int aside = 0; aside < kMaxPictures; aside += kStep)
    for (const int side : {-1, 1}) {
      // Both neighbours are on the body, too.
      const QPoint at = wish + QPoint(side * aside, 0);
      const auto isHit = [&](int off) {
        return view.viewport()
            .surfaceAt(Eigen::Vector2d(at.x() + off, at.y()) * view.devicePixelRatioF())
            .has_value();
      };
      if (isHit(-20) && isHit(0) && isHit(20)) return at;
    }
  std::fprintf(stderr, "palpa_screenshots: no body is seen\n");
  std::exit(1);
}

/// Presses a contact in with the wheel, moves it along `way`, and removes it.
void pressAlong(Photographer& p, const QString& name, QPoint at, int notches,
                const std::function<QPoint(double)>& way, int steps) {
  Camera camera(p, name);
  p.hover(QPoint(4, 4));
  camera.shoot();
  p.press(at);
  for (int i = 0; i < notches; ++i) {
    p.wheel(at, 1);
    camera.shoot();
  }
  for (int i = 1; i <= steps; ++i) {
    p.dragTo(way(static_cast<double>(i) / steps));
    camera.shoot();
  }
  for (int i = 0; i < notches; ++i) {
    p.wheel(at, -1);
    camera.shoot();
  }
  p.release();
  p.hover(QPoint(4, 4));
  camera.shoot();
}

}  // namespace

void film(const QString& folder) {
  Photographer p(folder);
  p.size(1000, 640);
  open(p, "sphere", "Ball");
  const QPoint onSphere = onBody(p, p.middle() + QPoint(-60, -60));
  pressAlong(
      p, "sphere", onSphere, 12, [&](double turn) { return onCircle(onSphere, 60, turn); }, 36);
  p.letGo();

  open(p, "cylinder", "Grab");
  {
    Camera camera(p, "cylinder");
    const QPoint at = onBody(p, p.middle() + QPoint(-40, -90));
    p.hover(QPoint(4, 4));
    camera.shoot();
    p.press(at);
    constexpr int kOut = 10, kRound = 30;
    for (int i = 1; i <= kOut; ++i) {
      p.dragTo(at + QPoint(70, 0) * i / kOut);
      camera.shoot();
    }
    for (int i = 1; i <= kRound; ++i) {
      const double angle = 2 * std::numbers::pi * i / kRound;
      p.dragTo(at + QPoint(static_cast<int>(std::lround(70 * std::cos(angle))),
                           static_cast<int>(std::lround(-45 * std::sin(angle)))));
      camera.shoot();
    }
    for (int i = kOut - 1; i >= 0; --i) {
      p.dragTo(at + QPoint(70, 0) * i / kOut);
      camera.shoot();
    }
    p.release();
    p.hover(QPoint(4, 4));
    camera.shoot();
  }
  p.letGo();

  open(p, "gripper-finger", "Push");
  const QPoint onFinger = onBody(p, p.middle() + QPoint(-20, -150));
  pressAlong(
      p, "gripper-finger", onFinger, 14,
      [&](double way) {
        // Forward and back.
        const double share = way < 0.5 ? 2 * way : 2 - 2 * way;
        return onFinger + QPoint(0, static_cast<int>(std::lround(170 * share)));
      },
      36);
  p.letGo();
}

int plotSlide(const QString& csv, const QString& png) {
  QFile table(csv);
  if (!table.open(QIODevice::ReadOnly)) {
    std::fprintf(stderr, "palpa_screenshots: cannot read %s\n", qPrintable(csv));
    return 3;
  }
  // At 100 mm/s around R = 25 mm.
  constexpr double kSecondsPerRadian = 0.25;
  std::map<std::string, view::ForcePlot::Curve> curves;
  const QStringList lines = QString::fromUtf8(table.readAll()).trimmed().split('\n');
  for (const QString& line : lines.mid(1)) {
    const QStringList cells = line.split(',');
    if (cells.size() < 3) continue;
    auto& curve = curves[cells[0].toStdString()];
    curve.name = cells[0].toStdString();
    curve.times.push_back(kSecondsPerRadian * cells[1].toDouble());
    curve.forces.push_back(cells[2].toDouble());
  }
  std::vector<view::ForcePlot::Curve> shownCurves;
  for (auto& [name, curve] : curves) {
    curve.number = static_cast<int>(shownCurves.size());
    shownCurves.push_back(std::move(curve));
  }
  Canvas canvas;
  if (!canvas.isValid() || shownCurves.empty()) {
    std::fprintf(stderr, "palpa_screenshots: no forces in %s, or no OpenGL\n", qPrintable(csv));
    return 1;
  }
  canvas.makeCurrent();
  canvas.resize({900, 380});
  view::ForcePlot plot(canvas.window());
  plot.setPixelRatio(1.3);
  plot.setLegendShown(true);
  // The axes are known after the first drawing.
  for (int round = 0; round < 2; ++round) {
    plot.setCurves(shownCurves, 0, 2 * std::numbers::pi * kSecondsPerRadian, "N");
    plot.render();
  }
  if (canvas.image().save(png)) return 0;
  std::fprintf(stderr, "palpa_screenshots: cannot write %s\n", qPrintable(png));
  return 3;
}

}  // namespace palpa::gui
