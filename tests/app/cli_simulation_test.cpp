// palpa-cli solve and touch: the keys of their JSON, and results that can be checked by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

class CliSimulation : public testing::Test {
 protected:
  /// A box 40 × 30 × 20 (mm), E = 1 MPa, nu = 0.3, on rollers so that a uniform pressure on
  /// top compresses it without any shear.
  void writeOedometer() const {
    cli_.run(
        "new box --size 40,30,20 --edge-length 6 --youngs-modulus 1 --poisson-ratio 0.3 "
        "-o p.json");
    Json project = cli_.readJson("p.json");
    project["supports"] = Json::parse(R"([
      {"name": "floor", "kind": "roller", "where": {"patches": ["bottom"]}},
      {"name": "walls", "kind": "roller",
       "where": {"patches": ["side_xmin", "side_xmax", "side_ymin", "side_ymax"]}}])");
    project["loads"] = Json::parse(
        R"([{"name": "weight", "kind": "pressure", "where": {"patches": ["top"]}, "MPa": 0.02}])");
    cli_.writeJson("p.json", project);
  }

  Runner cli_;
};

/// Tests that pass with either engine.
class CliEngine : public CliSimulation, public testing::WithParamInterface<std::string> {
 protected:
  static std::string engine() { return "--engine " + GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(Engines, CliEngine, testing::Values("spline", "triangles"),
                         [](const auto& tested) { return tested.param; });

TEST_P(CliEngine, SolveFulfilsItsContractAndAnExactSolution) {
  writeOedometer();
  const Json report = cli_.runJson("solve p.json --sample 0,0,20 --sample 20,-3,10 " + engine());
  EXPECT_EQ(report.at("engine"), GetParam() == "spline" ? "splines" : "triangles");
  EXPECT_GT(report.at("nodes").get<int>(), 50);
  EXPECT_GT(report.at("triangles").get<int>(), 100);
  for (const char* phase : {"mesh", "assemble", "factorise", "solve"}) {
    EXPECT_GE(report.at("seconds").at(phase).get<double>(), 0) << phase;
  }
  EXPECT_GT(report.at("memory_MiB").get<double>(), 1);

  // Uniaxial strain: u_z = -p z (1 + nu)(1 - 2 nu) / (E (1 - nu)), the walls carry p nu / (1 - nu).
  const double pressure = 0.02;
  const double top = -pressure * 20 * 1.3 * 0.4 / 0.7;
  const Json& samples = report.at("samples");
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_NEAR(samples[0].at("u_mm")[2].get<double>(), top, 1e-6 * std::abs(top));
  EXPECT_NEAR(samples[0].at("traction_MPa")[2].get<double>(), -pressure, 1e-9);
  EXPECT_NEAR(samples[1].at("u_mm")[2].get<double>(), top / 2, 1e-6 * std::abs(top));
  EXPECT_NEAR(samples[1].at("traction_MPa")[0].get<double>(), -pressure * 0.3 / 0.7, 1e-7);
  EXPECT_NEAR(samples[1].at("nearest_surface_mm")[0].get<double>(), 20, 1e-9);

  const Json& floor = report.at("supports")[0];
  EXPECT_EQ(floor.at("name"), "floor");
  EXPECT_NEAR(floor.at("force_N")[2].get<double>(), pressure * 1200, 1e-6 * pressure * 1200);
  EXPECT_EQ(floor.at("moment_Nmm").size(), 3u);
  const Json& weight = report.at("loads")[0];
  EXPECT_EQ(weight.at("name"), "weight");
  EXPECT_NEAR(weight.at("force_N")[2].get<double>(), -pressure * 1200, 1e-9);
  EXPECT_NEAR(report.at("balance_N").get<double>(), 0, 1e-6);
  // Half the work of the load: p A |u_z| / 2.
  EXPECT_NEAR(report.at("energy_mJ").get<double>(), 0.5 * pressure * 1200 * std::abs(top), 1e-6);
}

TEST_F(CliSimulation, ThreadsDoNotChangeTheAnswer) {
  writeOedometer();
  const Json one = cli_.runJson("solve p.json --threads 1 --sample 3,4,20");
  const Json two = cli_.runJson("solve p.json --threads 2 --sample 3,4,20");
  EXPECT_NEAR(one.at("samples")[0].at("u_mm")[2].get<double>(),
              two.at("samples")[0].at("u_mm")[2].get<double>(), 1e-10);
}

TEST_P(CliEngine, TouchGivesForceAndStiffness) {
  cli_.run("new sphere --radius 25 -o p.json");
  // Leading minus signs are values, not options.
  const Json report = cli_.runJson(
      "touch p.json --at -25,0,0 --displace -2,0,0 --radius 8 --kind grab " + engine());
  ASSERT_EQ(report.at("contacts").size(), 1u);
  const Json& contact = report.at("contacts")[0];
  EXPECT_NEAR(contact.at("displacement_mm")[0].get<double>(), -2, 1e-9);
  EXPECT_LT(contact.at("force_N")[0].get<double>(), 0);
  EXPECT_GT(contact.at("stiffness_N_per_mm").get<double>(), 0);
  // The support has the opposite force, up to the error of the discretisation.
  const Json& reaction = report.at("supports")[0].at("force_N");
  const double force = norm(contact.at("force_N"));
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(reaction[i].get<double>(), -contact.at("force_N")[i].get<double>(), 0.01 * force);
  }
  EXPECT_LE(report.at("balance_N").get<double>(), 0.01 * force);
}

TEST_F(CliSimulation, ASweepListsTheStatesOfSingleTouches) {
  cli_.run("new sphere --radius 25 --edge-length 8 -o p.json");
  const std::string touch =
      "touch p.json --engine triangles --at 0,0,25 --kind ball --radius 10 --friction 0.3 ";
  const Json report = cli_.runJson(touch + "--displace 0,0,-2 --sweep 4");
  const Json& sweep = report.at("sweep");
  ASSERT_EQ(sweep.size(), 5u);
  EXPECT_EQ(norm(sweep[0].at("contacts")[0].at("force_N")), 0);
  EXPECT_EQ(sweep[4].at("contacts")[0].at("force_N"), report.at("contacts")[0].at("force_N"));
  // The touch of half the depth has a finer mesh under it.
  const Json half = cli_.runJson(touch + "--displace 0,0,-1");
  EXPECT_NEAR(norm(sweep[2].at("contacts")[0].at("force_N")),
              norm(half.at("contacts")[0].at("force_N")),
              0.05 * norm(half.at("contacts")[0].at("force_N")));
  EXPECT_EQ(sweep[2].at("share"), 0.5);
  // Force, deflection and stiffness fit together.
  const Json& contact = report.at("contacts")[0];
  EXPECT_NEAR(norm(contact.at("force_N")),
              norm(contact.at("deflection_mm")) * contact.at("stiffness_N_per_mm").get<double>(),
              1e-9);
  const cli_tests::Outcome table = cli_.run(touch + "--displace 0,0,-2 --sweep 4 -o curve.csv");
  EXPECT_EQ(table.exitCode, 0);
  EXPECT_NE(table.out.find("sweep      4 steps"), std::string::npos);
  EXPECT_NE(cli_.read("curve.csv").find("\n1,touch,ball,"), std::string::npos);
}

TEST_P(CliEngine, TouchIsLinear) {
  cli_.run("new cylinder --edge-length 6 -o p.json");
  const Json once = cli_.runJson("touch p.json --at 0,-20,40 --displace 0,-1,0.5 " + engine());
  const Json twice = cli_.runJson("touch p.json --at 0,-20,40 --displace 0,-2,1 " + engine());
  EXPECT_NEAR(2 * norm(once.at("contacts")[0].at("force_N")),
              norm(twice.at("contacts")[0].at("force_N")), 1e-8);
}

TEST_P(CliEngine, ForceAndDisplacementAreInverseOfEachOther) {
  cli_.run("new box --edge-length 5 -o p.json");
  const Json moved =
      cli_.runJson("touch p.json --at 5,0,20 --displace 0.1,0.2,-1 --radius 10 " + engine());
  const Json f = moved.at("contacts")[0].at("force_N");
  char force[100];
  std::snprintf(force, sizeof force, "%.17g,%.17g,%.17g", f[0].get<double>(), f[1].get<double>(),
                f[2].get<double>());
  const Json pulled =
      cli_.runJson("touch p.json --at 5,0,20 --radius 10 " + engine() + " --force " + force);
  const Json& u = pulled.at("contacts")[0].at("displacement_mm");
  EXPECT_NEAR(u[0].get<double>(), 0.1, 1e-8);
  EXPECT_NEAR(u[1].get<double>(), 0.2, 1e-8);
  EXPECT_NEAR(u[2].get<double>(), -1, 1e-8);
}

TEST_F(CliSimulation, ANodeIsSwitchedAsInTheSeed) {
  cli_.run("new box --edge-length 8 -o p.json");
  const Json info = cli_.runJson("solve p.json");
  // Some nodes are fixed; among the last ones (the top) a free one is found quickly.
  const int node = info.at("nodes").get<int>() - 1;
  const Outcome outcome =
      cli_.run("touch p.json --node " + std::to_string(node) + " --displace 0,0,-0.5 --json");
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const Json contact = outcome.json().at("contacts")[0];
  EXPECT_NEAR(contact.at("displacement_mm")[2].get<double>(), -0.5, 1e-12);
  EXPECT_LT(contact.at("force_N")[2].get<double>(), 0);
  EXPECT_EQ(cli_.run("touch p.json --node 1000000 --displace 0,0,1").exitCode, 3);
}

TEST_F(CliSimulation, RecordedTouchesArePlayed) {
  cli_.run("new box --edge-length 6 -o p.json");
  EXPECT_EQ(cli_.run("touch p.json").exitCode, 3);
  Json project = cli_.readJson("p.json");
  project["touches"] = Json::parse(R"([
    {"name": "left", "kind": "grab", "at_mm": [-10, 0, 20], "displace_mm": [0, 0, -1], "radius_mm": 5},
    {"name": "right", "kind": "grab", "at_mm": [10, 0, 20], "displace_mm": [0, 0, 1], "radius_mm": 5}])");
  cli_.writeJson("p.json", project);
  const Outcome outcome = cli_.run("touch p.json --json");
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const Json contacts = outcome.json().at("contacts");
  ASSERT_EQ(contacts.size(), 2u);
  // Mirrored touches with opposite sign: opposite forces, up to the mesh's asymmetry.
  const double left = contacts[0].at("force_N")[2].get<double>();
  const double right = contacts[1].at("force_N")[2].get<double>();
  EXPECT_NEAR(left, -right, 0.05 * std::abs(left));
}

TEST_F(CliSimulation, EveryKindOfTouchSaysWhatItDoes) {
  cli_.run("new sphere --radius 25 -o p.json");
  const auto touch = [&](const std::string& options) {
    return cli_.runJson("touch p.json --at 0,0,25 " + options).at("contacts").at(0);
  };
  EXPECT_EQ(touch("--displace 0,0,-1").at("kind"), "grab");
  const Json force = touch("--kind force --force 0.1,0,-0.5");
  EXPECT_EQ(force, touch("--force 0.1,0,-0.5"));
  EXPECT_EQ(force.at("kind"), "force");
  EXPECT_EQ(force.at("status"), "holding");
  EXPECT_NEAR(force.at("normal_force_N").get<double>(), 0.5, 0.02);
  EXPECT_NEAR(force.at("tangential_force_N").get<double>(), 0.1, 0.02);
  const Json pin = touch("--kind pin");
  EXPECT_EQ(pin.at("kind"), "pin");
  EXPECT_LT(norm(pin.at("force_N")), 1e-12);
  const Json sticks = touch("--kind push --displace 0.5,0,-2 --friction 2");
  EXPECT_EQ(sticks.at("status"), "sticking");
  const Json slides = touch("--kind push --displace 8,0,-2 --friction 0.2 --radius 8");
  EXPECT_EQ(slides.at("status"), "slipping");
  EXPECT_NEAR(slides.at("tangential_force_N").get<double>(),
              0.2 * slides.at("normal_force_N").get<double>(), 1e-6);
  EXPECT_EQ(slides.at("friction"), 0.2);
  EXPECT_GT(slides.at("stiffness_N_per_mm").get<double>(), 0);
  EXPECT_EQ(touch("--kind push --displace 0,0,2").at("status"), "open");

  const Json pressed = cli_.runJson(
      "touch p.json --at 0,0,25 --kind ball --displace 0,0,-2 --radius 12 "
      "--friction 0.5 --steps 150");
  const Json& ball = pressed.at("contacts")[0];
  EXPECT_EQ(ball.at("radius_mm"), 12);
  EXPECT_GT(ball.at("patch").at("radius_mm").get<double>(), 0.5);
  ASSERT_GE(ball.at("patch").at("masks").size(), 1u);
  double sum = 0;
  for (const Json& mask : ball.at("patch").at("masks")) sum += mask.at("force_N")[2].get<double>();
  EXPECT_NEAR(sum, ball.at("force_N")[2].get<double>(), 1e-9);
  EXPECT_NEAR(ball.at("tool_mm")[2].get<double>(), 25 + 12 - 2, 0.1);
  EXPECT_GE(pressed.at("path").at("steps"), 150) << "a divided step counts as several";
  EXPECT_EQ(pressed.at("path").at("converged"), true);

  const std::string text =
      cli_.run("touch p.json --at 0,0,25 --kind ball --displace 0,0,-2 --friction 0.5").out;
  for (const char* part : {"ball, sticking", "N into the body", "patch radius", "steps, then"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST_F(CliSimulation, FormerNamesOfOptionsWorkWithANotice) {
  cli_.run("new sphere --radius 25 --edge-length 6 -o p.json");
  const std::string solve = "solve p.json --json --threads 1 ";
  const Outcome former = cli_.run(solve + "--probe 0,0,25");
  ASSERT_EQ(former.exitCode, 0) << former.err;
  EXPECT_EQ(former.err, "palpa-cli: --probe is the former name of --sample\n");
  const Json present = cli_.runJson("solve p.json --threads 1 --sample 0,0,25");
  EXPECT_EQ(former.json().at("probes"), present.at("samples"));
  EXPECT_EQ(former.json().at("samples"), present.at("samples"));
  EXPECT_FALSE(present.contains("probes"));
  const std::string touch = "touch p.json --json --at 0,0,25 --displace 0,0,-1 --kind ";
  const Outcome probe = cli_.run(touch + "probe");
  EXPECT_EQ(probe.err, "palpa-cli: --kind probe is the former name of --kind ball\n");
  EXPECT_EQ(probe.json().at("contacts")[0].at("kind"), "ball");
  EXPECT_EQ(cli_.run("solve --help").out.find("--probe"), std::string::npos);
}

TEST_F(CliSimulation, SeveralTouchesAreGivenAtOnce) {
  cli_.run("new sphere --radius 25 -o p.json");
  const Json contacts =
      cli_.runJson(
              "touch p.json --at 0,0,25 --displace 0,0,-2 --radius 9 "
              "--at -25,0,0 --kind pin --at 0,25,0 --kind push --displace 0,-1,0.2 "
              "--friction 0.1")
          .at("contacts");
  ASSERT_EQ(contacts.size(), 3u);
  EXPECT_EQ(contacts[0].at("kind"), "grab");
  EXPECT_EQ(contacts[0].at("radius_mm"), 9);
  EXPECT_EQ(contacts[1].at("name"), "touch 2");
  EXPECT_EQ(contacts[1].at("kind"), "pin");
  EXPECT_LT(norm(contacts[1].at("displacement_mm")), 1e-9);
  EXPECT_GT(norm(contacts[1].at("force_N")), 0.01);
  EXPECT_EQ(contacts[2].at("friction"), 0.1);
  // The same touches in the project give the same contacts.
  Json project = cli_.readJson("p.json");
  project["touches"] = Json::parse(R"([
    {"name": "touch 1", "kind": "grab", "at_mm": [0, 0, 25], "displace_mm": [0, 0, -2], "radius_mm": 9},
    {"name": "touch 2", "kind": "pin", "at_mm": [-25, 0, 0]},
    {"name": "touch 3", "kind": "push", "at_mm": [0, 25, 0], "displace_mm": [0, -1, 0.2],
     "friction": 0.1}])");
  cli_.writeJson("p.json", project);
  EXPECT_EQ(cli_.runJson("touch p.json").at("contacts"), contacts);
  const std::string info = cli_.run("info p.json").out;
  EXPECT_NE(info.find("touch 2: pin at (-25, 0, 0), held in place"), std::string::npos) << info;
  EXPECT_NE(info.find("push at (0, 25, 0), moved by (0, -1, 0.2) mm, friction 0.1"),
            std::string::npos)
      << info;
}

TEST_F(CliSimulation, TouchesWithoutMeaningAreRefusedWithAReason) {
  cli_.run("new box --edge-length 8 -o p.json");
  const auto refusal = [&](const std::string& options) {
    const Outcome outcome = cli_.run("touch p.json " + options);
    EXPECT_EQ(outcome.exitCode, 2) << options << "\n" << outcome.err;
    return outcome.err;
  };
  const std::string at = "--at 0,0,20 ";
  const std::pair<std::string, const char*> cases[] = {
      {at + "--kind squeeze --displace 0,0,-1", "known are grab, force, push, ball, pin"},
      {at + "--displace 0,0,-1 --friction 0.3", "--friction needs --kind push or ball"},
      {at + "--kind push --displace 0,0,-1 --friction -1", "--friction: expected a number"},
      {at + "--kind push --force 0,0,-1", "has --displace, but no --force"},
      {at + "--kind ball", "--kind ball needs --displace"},
      {at + "--kind force --displace 0,0,-1", "--kind force needs --force"},
      {at + "--displace 0,0,-1 --displace 0,0,-2", "--displace is given twice"},
      {"--kind pin " + at + "--at 5,0,20 --displace 0,0,-1", "stands before the first --at"},
      {at + "--displace 0,0,-1 --steps 0", "--steps: expected a whole number"},
      {at + "--displace 0,0,-1 --sweep 0", "--sweep: expected a whole number from 1 to 1000"},
      {"--node 5 --displace 0,0,-1 --sweep 3", "--sweep has no meaning for a single node"},
      {"--friction 0.2", "--friction needs --at"},
      {"--node 3 --displace 0,0,-1 --friction 0.2", "no meaning for a single node"}};
  for (const auto& [options, expected] : cases)
    EXPECT_NE(refusal(options).find(expected), std::string::npos) << options;
}

TEST_F(CliSimulation, ResultsGoToFiles) {
  cli_.run("new box --edge-length 8 -o p.json");
  for (const char* name : {"r.json", "r.vtp", "r.stl", "r.obj", "r.ply"}) {
    const Outcome outcome =
        cli_.run(std::string("touch p.json --quiet --at 0,0,20 --displace 0,0,-1 -o ") + name);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_TRUE(outcome.out.empty());
    EXPECT_GT(std::filesystem::file_size(cli_.path(name)), 500u) << name;
  }
  EXPECT_TRUE(cli_.readJson("r.json").contains("contacts"));
  EXPECT_NE(cli_.read("r.vtp").find("displacement_mm"), std::string::npos);
  EXPECT_EQ(cli_.run("solve p.json -o r.xyz").exitCode, 3);
  EXPECT_EQ(cli_.run("solve p.json -o no/such/folder/r.json").exitCode, 3);
}

TEST_F(CliSimulation, OptionsWithoutMeaningAreUsageErrors) {
  cli_.run("new box --edge-length 8 -o p.json");
  for (const char* arguments :
       {"touch p.json --at 0,0,20", "touch p.json --displace 0,0,1",
        "touch p.json --at 0,0,20 --displace 0,0,1 --force 0,0,1",
        "touch p.json --at 0,0,20 --node 3 --displace 0,0,1", "touch p.json --node 3 --force 0,0,1",
        "touch p.json --node x --displace 0,0,1", "touch p.json --at 0,0 --displace 0,0,1",
        "touch p.json --at 0,0,nan --displace 0,0,1",
        "touch p.json --at 0,0,20 --displace 0,0,1 --radius 0",
        "touch p.json --at 0,0,20 --displace 0,0,1 --kind bite", "solve p.json --sample 1,2",
        "solve p.json --edge-length -1", "solve p.json --threads -1", "solve"}) {
    const Outcome outcome = cli_.run(arguments);
    EXPECT_EQ(outcome.exitCode, 2) << arguments << "\n" << outcome.err;
    EXPECT_EQ(outcome.err.rfind("palpa-cli: ", 0), 0u) << outcome.err;
  }
  EXPECT_EQ(cli_.run("touch p.json --at 0,0,60 --displace 0,0,1").exitCode, 3);
}

/// A large ball beside a sharp edge: its contact once ran away over the edge, because the curvature
/// that normals on both sides of an edge seem to show is huge.
TEST_F(CliSimulation, ABallBesideAnEdgeStaysWhereItTouches) {
  const std::string file = PALPA_TEST_DATA "/projects/touches/ball_beside_edge.json";
  for (const char* accuracy : {"0.01", "0.009"}) {
    const Json report = cli_.runJson("touch " + file + " --engine splines --accuracy " + accuracy);
    const Json& contact = report.at("contacts")[0];
    EXPECT_NEAR(contact.at("normal_force_N").get<double>(), 0.44, 0.05);
    EXPECT_NEAR(contact.at("at_mm")[2].get<double>(), 53.3, 1);
  }
}

}  // namespace
}  // namespace palpa::cli_tests
