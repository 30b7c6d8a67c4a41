#include "capture/capture_search.hpp"

#include <cmath>
#include <filesystem>
#include <set>

#include <gmock/gmock.h>
#include <unistd.h>

#include "experiment/scenario_variants.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;

/// In place of runs: a robot that survives what `survives` says of (variant, direction, force,
/// seed).
class Oracle final : public CaseLauncher {
 public:
  using Rule = std::function<bool(const std::string&, double, double, std::uint64_t)>;
  explicit Oracle(Rule survives) : survives_(std::move(survives)) {}

  void launch(const std::vector<StudyCase>& cases,
              const std::function<void(const CaseResult&)>& ended) override {
    for (const StudyCase& c : cases) {
      EXPECT_TRUE(ran_.insert(c.id).second) << "the same run twice";
      CaseResult result;
      result.id = c.id;
      result.outcome =
          crashes_ ? CaseOutcome::kCrashed
          : survives_(c.point[kVariantAxis].label, std::stod(c.point[kDirectionAxis].label),
                      c.point[kForceAxis].number, c.seed)
              ? CaseOutcome::kPassed
              : CaseOutcome::kFell;
      ended(result);
    }
  }
  std::size_t count() const { return ran_.size(); }
  bool crashes_ = false;

 private:
  Rule survives_;
  std::set<std::string> ran_;
};

CaptureRequest request() {
  CaptureRequest r;
  r.scenario = BALLBOT_SOURCE_DIR "/configs/scenarios/push.yaml";
  r.variants = {{"as given", {}}};
  r.directions = 4;
  return r;
}

std::vector<CaptureEdge> searched(const CaptureRequest& r, Oracle& oracle, double up_to_N) {
  const std::string path =
      (fs::temp_directory_path() / ("capture_search_" + std::to_string(::getpid()))).string();
  fs::remove_all(path);
  const Study study = captureStudy(r, up_to_N);
  std::vector<CaptureEdge> out;
  {
    const StudyFolder folder = StudyFolder::create(path, study, loadScenarioTree(r.scenario));
    StudyEngine engine(study, folder, oracle, {});
    CaptureSearch search(r, study,
                         std::vector<double>(r.durations_s.size() * r.heights_m.size(), up_to_N));
    std::size_t left = search.casesLeft(), rounds = 0;
    for (auto cases = search.next(); !cases.empty(); cases = search.next()) {
      EXPECT_LE(cases.size(), search.casesLeft());
      engine.run(cases);
      search.take(engine);
      // Where the seeds can tell them apart the ends of the interval are searched as well.
      if (r.seeds < 4 && r.rate == 0.5) {
        EXPECT_LT(search.casesLeft(), left);
      }
      left = search.casesLeft();
      EXPECT_LT(++rounds, 30u) << "the search does not end";
      if (rounds == 30) break;
    }
    EXPECT_EQ(search.casesLeft(), 0u);
    EXPECT_EQ(search.boundaries().size(), search.edges().size());
    out = search.edges();
  }
  fs::remove_all(path);
  return out;
}

TEST(CaptureSearch, FindsTheLastForceThatIsSurvivedInEachDirection) {
  const CaptureRequest r = request();
  const auto limit = [](double deg) { return 41 + deg / 10; };
  Oracle oracle([&](const std::string&, double deg, double force, std::uint64_t) {
    return force < limit(deg);
  });
  const std::vector<CaptureEdge> edges = searched(r, oracle, 100);
  ASSERT_EQ(edges.size(), 4u);
  for (const CaptureEdge& e : edges) {
    ASSERT_TRUE(e.survived_N && e.fallen_N);
    EXPECT_LT(*e.survived_N, limit(r.directionDeg(e.direction)));
    EXPECT_EQ(*e.fallen_N - *e.survived_N, r.resolution_N);
    EXPECT_GE(*e.fallen_N, limit(r.directionDeg(e.direction)));
  }
  // Standing unpushed once with three seeds; in each direction the end and 50 steps halved.
  EXPECT_LE(oracle.count(), 3u + 4u * 3u * (1 + 6));
}

TEST(CaptureSearch, GoesByTheShareOfSeeds) {
  CaptureRequest r = request();
  r.directions = 1;
  // Seed 1 survives 30 N, 2 and 3 survive 60 N.
  const auto rule = [](const std::string&, double, double force, std::uint64_t seed) {
    return force < (seed == 1 ? 31 : 61);
  };
  Oracle half(rule), most(rule);
  EXPECT_EQ(*searched(r, half, 100)[0].survived_N, 60);
  r.rate = 0.9;
  EXPECT_EQ(*searched(r, most, 100)[0].survived_N, 30);
}

TEST(CaptureSearch, WithManySeedsSaysHowSureItIs) {
  CaptureRequest r = request();
  r.directions = 1;
  r.seeds = 20;
  // The share that survives falls from all at 40 N to none at 80 N.
  Oracle oracle([](const std::string&, double, double force, std::uint64_t seed) {
    return force < 40 + 2 * static_cast<double>(seed);
  });
  const CaptureEdge edge = searched(r, oracle, 100)[0];
  ASSERT_TRUE(edge.boundary.low && edge.boundary.high);
  EXPECT_NEAR(edge.boundary.estimate, 60, 2);
  EXPECT_LT(*edge.boundary.low, 56);
  EXPECT_GT(*edge.boundary.high, 64);
}

TEST(CaptureSearch, SaysWhereNothingFallsAndWhereAllDoes) {
  CaptureRequest r = request();
  r.variants.push_back(CaptureVariant::of("controller.kind=lqr"));
  r.directions = 2;
  Oracle oracle([](const std::string& variant, double, double, std::uint64_t) {
    return variant == "as given";
  });
  const std::vector<CaptureEdge> edges = searched(r, oracle, 21);
  ASSERT_EQ(edges.size(), 4u);
  EXPECT_EQ(*edges[0].survived_N, 22) << "whole steps, up to what was asked for at least";
  EXPECT_FALSE(edges[0].fallen_N);
  EXPECT_EQ(edges[0].boundary.kind, Boundary::Kind::kPassesEverywhere);
  EXPECT_FALSE(edges[2].survived_N);
  EXPECT_EQ(*edges[2].fallen_N, 0);
}

TEST(CaptureSearch, EndsWhereRunsCannotBeJudged) {
  const CaptureRequest r = request();
  Oracle oracle([](const std::string&, double, double, std::uint64_t) { return true; });
  oracle.crashes_ = true;
  for (const CaptureEdge& e : searched(r, oracle, 100)) {
    EXPECT_EQ(e.boundary.kind, Boundary::Kind::kUnknown);
    EXPECT_FALSE(e.survived_N || e.fallen_N);
  }
  EXPECT_EQ(oracle.count(), 3u) << "not asked for again";
}

}  // namespace
}  // namespace ballbot
