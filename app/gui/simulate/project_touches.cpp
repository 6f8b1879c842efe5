#include "app/gui/simulate/project_touches.h"

namespace palpa::gui {
namespace {

constexpr int kPoll = 10;  // ms between two looks at the first part

}  // namespace

ProjectTouches::ProjectTouches(const Editor& editor, Simulation& simulation, QObject* parent)
    : QObject(parent), editor_(editor), simulation_(simulation), motion_(simulation, this) {
  timer_.setInterval(kPoll);
  connect(&timer_, &QTimer::timeout, this, [this] {
    if (!motion_.isSettled()) return;
    timer_.stop();
    begin(true);  // on the deformed surface
  });
  connect(&simulation, &Simulation::leaving, &timer_, &QTimer::stop);
  connect(&editor, &Editor::projectReplaced, this, [this] {
    timer_.stop();
    motion_.stop();
  });
}

void ProjectTouches::play() {
  if (!simulation_.drawn()) return;
  simulation_.endAll();
  motion_.stop();
  begin(false);
  timer_.start();
}

void ProjectTouches::begin(bool pressing) {
  for (const modeling::Touch& touch : editor_.project().touches)
    if (modeling::infoOf(touch.kind).presses == pressing) motion_.begin(touch);
}

}  // namespace palpa::gui
