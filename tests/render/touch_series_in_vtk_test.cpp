#include <gtest/gtest.h>
#include <unistd.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "app/core/live/touch_replay.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/results/state_series.h"
#include "app/core/results/touch.h"
#include "app/core/results/touch_sweep.h"
#include "modeling/error.h"
#include "modeling/project/project_file.h"

// Series of states for ParaView, read by the readers of VTK.
namespace palpa {
namespace {

namespace fs = std::filesystem;

class TouchSeriesInVtk : public testing::Test {
 protected:
  TouchSeriesInVtk() { fs::create_directories(folder_); }
  ~TouchSeriesInVtk() override { fs::remove_all(folder_); }

  static const std::shared_ptr<const app::TouchModel>& model(modeling::Engine engine) {
    static std::map<modeling::Engine, std::shared_ptr<const app::TouchModel>> models;
    auto& model = models[engine];
    if (!model) {
      modeling::Project project = modeling::readProject(PALPA_PROJECTS "/box.json");
      project.mesh.engine = engine;
      project.mesh.edgeLength = 8;
      project.mesh.accuracy = 0.05;
      model = app::buildTouchModel(project, {}, {});
    }
    return model;
  }

  struct Entry {
    double time;
    fs::path file;
  };
  /// The entries of a collection.
  std::vector<Entry> entries(const fs::path& collection) const {
    std::vector<Entry> list;
    const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(
        vtkXMLUtilities::ReadElementFromFile(collection.c_str()));
    if (!root) return list;
    EXPECT_STREQ(root->GetAttribute("type"), "Collection");
    vtkXMLDataElement* sets = root->FindNestedElementWithName("Collection");
    for (int k = 0; sets && k < sets->GetNumberOfNestedElements(); ++k) {
      vtkXMLDataElement* set = sets->GetNestedElement(k);
      list.push_back({std::stod(set->GetAttribute("timestep")),
                      collection.parent_path() / set->GetAttribute("file")});
    }
    return list;
  }

  static vtkSmartPointer<vtkPolyData> read(const fs::path& file) {
    EXPECT_TRUE(fs::exists(file)) << file;
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    return reader->GetOutput();
  }

  /// The file has the numbers of a field, bit for bit.
  static void expectEqual(vtkPolyData& mesh, const app::TouchModel& of,
                          const bem::BoundaryField& field) {
    const bem::BoundaryMesh& at = of.setup().mesh();
    ASSERT_EQ(mesh.GetNumberOfPoints(), at.nodeCount());
    ASSERT_EQ(mesh.GetNumberOfCells(), static_cast<vtkIdType>(at.triangles.size()));
    const bem::BoundaryField onMesh = of.setup().discretisation->valuesOnMesh(field);
    vtkDataArray* displacement = mesh.GetPointData()->GetArray("displacement_mm");
    vtkDataArray* traction = mesh.GetCellData()->GetArray("traction_MPa");
    ASSERT_TRUE(displacement && traction);
    for (int node = 0; node < at.nodeCount(); ++node)
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(mesh.GetPoint(node)[axis], at.nodes[node][axis]);
        EXPECT_EQ(displacement->GetComponent(node, axis), onMesh.u(3 * node + axis, 0));
      }
    const auto& corners = of.setup().meshSlots().ofCorner;
    for (std::size_t k = 0; k < corners.size(); ++k)
      for (int axis = 0; axis < 3; ++axis) {
        double sum = 0;
        for (const int slot : corners[k]) sum += onMesh.p(3 * slot + axis, 0);
        EXPECT_NEAR(traction->GetComponent(static_cast<vtkIdType>(k), axis), sum / 3,
                    1e-12 + 1e-12 * std::abs(sum));
      }
  }

  fs::path folder_ = fs::temp_directory_path() / ("palpa-series-" + std::to_string(getpid()));
};

TEST_F(TouchSeriesInVtk, StatesOfASweepComeBack) {
  for (const modeling::Engine engine : {modeling::Engine::kTriangles, modeling::Engine::kSplines}) {
    const app::TouchModel& body = *model(engine);
    const std::vector<modeling::Touch> touches{
        {"press", {-8, 0, 20}, modeling::TouchKind::kBall, {0, 0, -1}, 6.0}};
    const fs::path collection = folder_ / "a sweep & more.pvd";
    std::vector<app::SweepRow> rows;
    app::sweepTouches(body, touches, 4, 0, {},
                      [&](app::SweepRow row) { rows.push_back(std::move(row)); });
    app::writeSweepSeries(body, rows, 0, collection, {});
    const std::vector<Entry> list = entries(collection);
    ASSERT_EQ(list.size(), 5u);
    for (std::size_t k = 0; k < list.size(); ++k) {
      EXPECT_EQ(list[k].time, static_cast<double>(k) / 4);
      const app::TouchState state = app::playTouches(body, app::scaled(touches, list[k].time));
      expectEqual(*read(list[k].file), body, state.field);
    }
  }
}

TEST_F(TouchSeriesInVtk, AReplayComesBackAtItsTimes) {
  const auto body =
      std::make_shared<const app::TouchableModel>(model(modeling::Engine::kTriangles));
  app::TouchRecording recording;
  using Command = app::TouchCommand;
  const Eigen::Vector3d place(-8, 0, 20), none = Eigen::Vector3d::Zero();
  const bem::ContactTool grab{bem::ContactTool::Kind::kGrab, 6, 0};
  const auto moved = [](double depth) { return Eigen::Vector3d(0, 0, -depth); };
  recording.entries.push_back({10, Command{Command::Kind::kBegin, 1, grab, place, moved(0.5)}});
  recording.entries.push_back({60, Command{Command::Kind::kSet, 1, grab, none, moved(1.5)}});
  recording.entries.push_back({100, Command{Command::Kind::kEnd, 1, grab, none, none}});
  recording.steps = 120;
  const fs::path collection = folder_ / "replay.pvd";
  app::ReplaySeries series(body, 40, collection);
  std::vector<app::TouchSnapshot> snapshots;
  app::replay(body, recording, {}, [&](const app::TouchSnapshot& snapshot) {
    series.add(snapshot, snapshots.size());
    snapshots.push_back(snapshot);
  });
  series.commit();
  const std::vector<Entry> list = entries(collection);
  ASSERT_EQ(list.size(), 5u);  // 0, 25, 50, 75, 100 ms of 120
  app::TouchField field(body);
  double largest = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    EXPECT_DOUBLE_EQ(list[k].time, 0.025 * static_cast<double>(k));
    const auto mesh = read(list[k].file);
    expectEqual(*mesh, body->model(), field.field(snapshots[25 * k]));
    largest = std::max(largest, mesh->GetPointData()->GetArray("displacement_mm")->GetMaxNorm());
  }
  EXPECT_GT(largest, 1.4);
}

const modeling::MeshFile kTriangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}, {}};

TEST_F(TouchSeriesInVtk, AShorterSeriesReplacesALongerOne) {
  const fs::path collection = folder_ / "s.pvd";
  const auto write = [&](int count) {
    modeling::MeshSeries series(collection);
    for (int k = 0; k < count; ++k) series.add(kTriangle, k);
    series.commit();
  };
  write(4);
  std::ofstream(folder_ / "s" / "note.txt") << "mine";
  write(2);
  EXPECT_EQ(entries(collection).size(), 2u);
  std::set<std::string> names;
  for (const auto& each : fs::directory_iterator(folder_ / "s"))
    names.insert(each.path().filename().string());
  EXPECT_EQ(names, (std::set<std::string>{"s_00000.vtp", "s_00001.vtp", "note.txt"}));
}

TEST_F(TouchSeriesInVtk, WithoutCommitNothingIsLeft) {
  const fs::path collection = folder_ / "s.pvd";
  {
    modeling::MeshSeries series(collection);
    series.add(kTriangle, 0);
  }
  EXPECT_TRUE(fs::is_empty(folder_));
  std::stop_source stop;
  stop.request_stop();
  Job cancelled;
  cancelled.stop = stop.get_token();
  EXPECT_THROW(app::writeSweepSeries(*model(modeling::Engine::kTriangles),
                                     std::vector<app::SweepRow>(3), 0, collection, cancelled),
               Cancelled);
  EXPECT_TRUE(fs::is_empty(folder_));
  // What cannot be written is said before anything is computed.
  EXPECT_THROW(modeling::MeshSeries(folder_ / "s.vtp"), modeling::ModelingError);
  EXPECT_THROW(modeling::MeshSeries(folder_ / "none" / "s.pvd"), Error);
  std::ofstream(folder_ / "s") << "a file where the folder would be";
  EXPECT_THROW(modeling::MeshSeries{collection}, modeling::ModelingError);
  EXPECT_FALSE(fs::exists(collection));
}

}  // namespace
}  // namespace palpa
