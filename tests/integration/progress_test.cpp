// How far runs say they are, while their blocks are in work.
#include "host/run/progress.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "host/study/continued_sweep.hpp"
#include "host/study/ensemble_plan.hpp"
#include "tests/support/known_results.hpp"
#include "tests/support/scene_fixture.hpp"

namespace slideway::progress_test {
namespace {

/// A kernel's block with every question whether to stop, and what the progress is at each of them.
class Recorded {
public:
    Recorded(BlockKernel kernel, Progress& progress) : kernel_(std::move(kernel)), progress_(progress) {}

    BlockKernel kernel() {
        return [this](Block& block) {
            struct Asked {
                decltype(Block::stop) stop;
                void const* context;
                Recorded* of;
            } const asked{block.stop, block.stop_context, this};
            block.stop = [](void const* context, double covered) {
                auto const& a = *static_cast<Asked const*>(context);
                bool const ends = a.stop(a.context, covered);
                a.of->shares.push_back(a.of->progress_.share());
                return ends;
            };
            block.stop_context = &asked;
            kernel_(block);
        };
    }

    std::vector<double> shares;

private:
    BlockKernel const kernel_;
    Progress& progress_;
};

Scene falling(std::string const& study, std::string const& mechanism = "slider_crank") {
    return testing::scene_of("schema = 1\n[mechanism]\nkind = \"" + mechanism + "\"\n[study]\n" + study);
}

/// What a run on one thread says between its start and its end.
std::vector<double> shares_of(Scene const& scene, Isa isa, std::size_t block_members = 0) {
    auto const backend = cpu_backend(isa);
    MemberSet const members(MemberRange{0, member_count(scene)});
    EnsemblePlan plan = ensemble_plan(scene, members, *backend, 1, block_members);
    StopRequest const stop;
    Progress progress({members.count()}, Progress::Style::none, stderr, stop);
    Recorded recorded(backend->kernel(scene.parts, plan.request.shadows.count > 0), progress);
    if (is_continued(scene)) continue_columns(scene, plan, members, recorded.kernel(), {}, stop);
    run_ensemble(plan, recorded.kernel(), [](BlockResult const&) {}, stop, &progress);
    EXPECT_EQ(progress.share(), 1);
    EXPECT_TRUE(std::ranges::is_sorted(recorded.shares));
    return recorded.shares;
}

/// At least `count` values of those, strictly between nothing and all, differ.
void expect_gradual(std::vector<double> shares, std::size_t count) {
    std::erase_if(shares, [](double share) { return share <= 0 || share >= 1; });
    shares.erase(std::unique(shares.begin(), shares.end()), shares.end());
    EXPECT_GE(shares.size(), count);
}

TEST(ProgressOfARun, OfOneMemberIsTheShareOfItsTime) {
    for (Isa const isa : built_isas()) {
        if (!is_supported(isa)) continue;
        std::vector<double> const shares = shares_of(falling("duration = \"0.2 s\"\n"), isa);
        expect_gradual(shares, 20);
        // Between two questions no member gets far.
        for (std::size_t i = 1; i < shares.size(); ++i) EXPECT_LT(shares[i] - shares[i - 1], 0.1);
    }
}

TEST(ProgressOfARun, GoesOnInsideBlocksAndFromBlockToBlock) {
    std::string const spread = "[study.vary]\n\"initial.y\" = { dist = \"unif\", low = \"-0.09 mm\", high = \"0.09 mm\" }\n";
    expect_gradual(shares_of(falling("members = 40\nduration = \"20 ms\"\n" + spread), best_isa(), 20), 40);
}

TEST(ProgressOfARun, OfContinuedSweepsAndExponentsComesToItsEnd) {
    std::string const sweep = "kind = \"sweep\"\nparameter = \"joint.clearance\"\nvalues = [1e-4, 2e-4]\nmembers = 2\n"
                              "transient_revolutions = 1\nrevolutions = 2\n";
    Overrides const fast{{"mechanism.crank_speed", "100"}};
    for (std::string const more : {"exponents = 0\nstart = \"continue\"\n", "exponents = 1\n"}) {
        Scene const scene = testing::scene_of("schema = 1\n[contact]\nlaw = \"paper\"\n[study]\n" + sweep + more, fast);
        expect_gradual(shares_of(scene, best_isa()), 8);
    }
}

TEST(ProgressOfARun, CountsMembersThatFailAsDone) {
    Scene scene = falling("members = 3\nduration = \"0.2 s\"\n");
    scene.integrator.max_steps = 40;
    shares_of(scene, best_isa());
    EnsemblePlan plan = small_plan(9, 3, 1);
    plan.source = every_third_is_unusable;
    StopRequest const stop;
    Progress progress({9}, Progress::Style::none, stderr, stop);
    run_ensemble(plan, known_results, [](BlockResult const&) {}, stop, &progress);
    EXPECT_EQ(progress.share(), 1);
}

TEST(ProgressOfARun, StandsStillWhereMembersAreGivenUp) {
    StopRequest stop;
    Progress progress({4}, Progress::Style::none, stderr, stop);
    auto const kernel = [&](Block& block) {
        known_results(block);
        block.records[1] = {};
        EXPECT_FALSE(block.stop(block.stop_context, 1.75));
        stop.request();
    };
    run_ensemble(small_plan(4, 2, 1), kernel, [](BlockResult const&) {}, stop, &progress);
    EXPECT_EQ(progress.share(), 1.75 / 4);
}

}  // namespace
}  // namespace slideway::progress_test
