// Projects, meshes and CAD files are opened, touched and closed again and again: memory, handles
// and threads must stay as they are.
#include <array>
#include <fstream>
#include <thread>

#include "app/core/session/new_project.h"
#include "app/core/session/session.h"
#include "app/core/system/destroy_in_background.h"
#include "modeling/exchange/cad_export.h"
#include "modeling/exchange/import.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/project_file.h"
#include "modeling/shapes/primitives.h"
#include "tests/modeling/child_process.h"
#include "tests/reliability/touch_user.h"

namespace palpa::reliability {
namespace {

using namespace std::chrono_literals;

constexpr auto kPatience = 120s;

/// A tetrahedron's surface, divided a few times, as an OBJ file.
void writeMesh(const std::filesystem::path& file) {
  const modeling::Solid solid = modeling::makeSphere(25);
  modeling::MeshSettings settings;
  settings.edgeLength = 8;
  const modeling::SurfaceMesh mesh = modeling::mesh(solid, settings);
  std::ofstream out(file);
  for (const auto& position : mesh.positions) out << "v " << position.transpose() << '\n';
  for (const auto& [a, b, c] : mesh.triangles)
    out << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
}

/// What is opened, one after the other.
struct Files {
  explicit Files(std::filesystem::path in) : folder(std::move(in)) {
    modeling::Project sphere = app::makeProject(modeling::makeSphere(25), "sphere");
    sphere.mesh.engine = modeling::Engine::kTriangles;
    sphere.mesh.edgeLength = 8;
    modeling::writeProject(sphere, folder / "triangles.json");
    modeling::Project cylinder = app::makeProject(modeling::makeCylinder(20, 40), "cylinder");
    cylinder.mesh.engine = modeling::Engine::kSplines;
    cylinder.mesh.elementLength = 14;
    modeling::writeProject(cylinder, folder / "splines.json");
    writeMesh(folder / "mesh.obj");
    modeling::exportCad(modeling::makeBox({40, 30, 20}), folder / "box.step");
  }
  static constexpr std::array kNames{"triangles.json", "splines.json", "mesh.obj",
                                     "box.step",       "splines.json", "triangles.json"};
  const std::filesystem::path folder;
};

app::Session::Options optionsIn(const std::filesystem::path& folder) {
  app::Session::Options options;
  options.cacheFolder = folder / "cache";
  options.cacheLimit = 200 * kMiB;
  options.autosaveFolder = folder / "autosave";
  options.autosaveEvery = 0s;
  return options;
}

std::unique_ptr<app::Session> open(const Files& files, const std::string& name) {
  const auto options = optionsIn(files.folder);
  if (name.ends_with(".json")) return std::make_unique<app::Session>(files.folder / name, options);
  modeling::Project project =
      app::makeProject(modeling::importBody(files.folder / name).body, name);
  project.mesh.engine = modeling::Engine::kTriangles;
  project.mesh.edgeLength = 9;
  return std::make_unique<app::Session>(std::move(project), options);
}

/// Opens, solves, touches, edits, autosaves and closes; sometimes before the model is there.
void cycle(Campaign& campaign, const Files& files, Random& random) {
  const std::string name =
      Files::kNames[static_cast<std::size_t>(campaign.rounds()) % Files::kNames.size()];
  const auto session = open(files, name);
  if (oneIn(random, 8)) return;
  if (!campaign.require(session->pipeline().waitUntilSettled(kPatience), name + " does not settle"))
    return;
  const auto model = session->pipeline().model();
  if (!campaign.require(model != nullptr, name + ": " + session->pipeline().status().error)) return;
  {
    app::TouchLoop loop;
    const std::vector<Place> places = placesOf(*model);
    const std::uint64_t number = loop.setModel(model);
    TouchUser user(loop, random(), 3);
    app::TouchSnapshot snapshot;
    const auto end = Clock::now() + kPatience;
    bool isTouched = false;
    for (int moves = 0; (moves < 20 || !isTouched) && Clock::now() < end; ++moves) {
      user.act(places);
      std::this_thread::sleep_for(1ms);
      loop.read(snapshot);
      for (const auto& contact : snapshot.touched())
        isTouched |= snapshot.model == number && contact.force.norm() > 0;
    }
    campaign.require(isTouched, name + ": no force");
  }
  session->perform(modeling::RenameProject{"edited"});
  session->autosaveIfDue(Clock::now());
  session->autosaveIfDue(Clock::now() + 1s);
  session->close();
}

}  // namespace
}  // namespace palpa::reliability

int main(int argc, char** argv) {
  using namespace palpa::reliability;
  Campaign campaign("open_close", argc, argv, 0, 60);
  Random random(campaign.seed());
  const palpa::testing_support::TemporaryFolder folder;
  const Files files(folder.path());
  // What is made once and kept (libraries, threads, the allocator's stock) is there after a third.
  Usage before;
  bool isWarm = false;
  while (campaign.next()) {
    cycle(campaign, files, random);
    if (isWarm || campaign.fraction() < 1.0 / 3) continue;
    palpa::app::waitUntilDestroyed();
    before = usageNow();
    isWarm = true;
  }
  palpa::app::waitUntilDestroyed();
  const Usage after = usageNow();
  campaign.figures(before, after);
  campaign.requireFlat(before, after, 2 * kMiB);
  return campaign.end();
}
