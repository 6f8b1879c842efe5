// Cancellation and progress of the mesher.
#include <gtest/gtest.h>

#include "modeling/mesh/mesh.h"
#include "modeling/mesh/mesh_follow.h"
#include "modeling/shapes/primitives.h"
#include "test_bodies.h"

namespace palpa::modeling {
namespace {

const std::vector<MeshRegion> kRegions{{"base", Region::below({0.1, 0, 1}, -12.0), true}};

MeshSettings settings() {
  MeshSettings result;
  result.edgeLength = 4.0;
  result.refinementLevels = 2;
  result.refineAtBorders = true;
  return result;
}

TEST(MeshJob, CancelledBeforeNothingIsDone) {
  std::stop_source source;
  source.request_stop();
  bool reported = false;
  const Job job{source.get_token(), [&](Phase, double) { reported = true; }};
  const Solid sphere = makeSphere(25.0);
  EXPECT_THROW(mesh(sphere, settings(), kRegions, job), Cancelled);
  EXPECT_FALSE(reported);
  const SurfaceMesh made = mesh(sphere, settings(), kRegions);
  EXPECT_THROW(followSolid(made, sphere, sphere, kRegions, {}, job), Cancelled);
}

// Estimates for mesh bodies simplify the surface, which takes seconds for large ones.
TEST(MeshJob, EstimatesForMeshBodiesStop) {
  std::stop_source source;
  source.request_stop();
  const Job job{source.get_token(), {}};
  const MeshBody body = test::icosphere(25.0, 4);
  EXPECT_THROW(estimateNodeCount(body, settings(), {}, {}, job), Cancelled);
  EXPECT_THROW(estimateNodeCount(Body(body), settings(), {}, {}, job), Cancelled);
  EXPECT_GT(estimateNodeCount(body, settings()), 100.0);
}

TEST(MeshJob, CancelledAtEveryReportOfProgress) {
  const Solid sphere = makeSphere(25.0);
  int reports = 0;
  mesh(sphere, settings(), kRegions, {{}, [&](Phase, double) { ++reports; }});
  ASSERT_GT(reports, 3);
  // After the last report the mesh exists.
  for (int stopAt = 0; stopAt < reports - 1; ++stopAt) {
    std::stop_source source;
    int seen = 0;
    const Job job{source.get_token(), [&](Phase, double) {
                    if (seen++ == stopAt) source.request_stop();
                  }};
    EXPECT_THROW(mesh(sphere, settings(), kRegions, job), Cancelled) << stopAt;
    EXPECT_EQ(seen, stopAt + 1) << "work went on to the next report";
  }
}

TEST(MeshJob, StoppingAfterwardsAndReportingChangeNothing) {
  const Solid sphere = makeSphere(25.0);
  std::stop_source source;
  double last = -1.0;
  bool monotone = true;
  const Job job{source.get_token(), [&](Phase phase, double fraction) {
                  EXPECT_EQ(phase, Phase::kMesh);
                  monotone = monotone && fraction >= last;
                  last = fraction;
                }};
  const SurfaceMesh made = mesh(sphere, settings(), kRegions, job);
  source.request_stop();
  EXPECT_TRUE(monotone);
  EXPECT_EQ(last, 1.0);
  EXPECT_EQ(made.positions, mesh(sphere, settings(), kRegions).positions);
}

}  // namespace
}  // namespace palpa::modeling
