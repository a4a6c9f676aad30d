// What holds of every study of orbits that a user runs, and exponents: numbers depend on nothing but the scene.
#include "tests/system/orbits.hpp"

#include <algorithm>
#include <span>
#include <tuple>

#include "host/backend/backend.hpp"
#include "kernels/status.hpp"

namespace slideway::testing::orbits::orbit_test {
namespace {

struct Study {
    char const* name;
    std::string scene;
    std::vector<std::string> options;
};
void PrintTo(Study const& study, std::ostream* out) { *out << study.name; }

std::vector<Study> const studies{
    {"Lyapunov", lyapunov, {}},        {"SectionsByPhase", by_phase, {}},
    {"SectionsByState", by_state, {}}, {"SectionsByGap", by_gap, {}},
    {"FreshSweep", sweep, {}},         {"ContinuedSweep", sweep, {"--set", continued_key}}};

class EveryOrbitStudy : public OrbitProgram, public ::testing::WithParamInterface<Study> {
protected:
    ResultReader with(std::vector<std::string> options) const {
        options.insert(options.end(), GetParam().options.begin(), GetParam().options.end());
        return results_of(GetParam().scene, options);
    }
    std::string hash(std::vector<std::string> options) const {
        ResultReader const file = with(std::move(options));
        EXPECT_EQ(file.stored_hash(), file.computed_hash());
        return file.stored_hash();
    }
};

TEST_P(EveryOrbitStudy, GivesTheSameNumbersWithAnyThreads) {
    std::string const one = hash({"--threads", "1"});
    EXPECT_EQ(hash({"--threads", "2"}), one);
    EXPECT_EQ(hash({"--threads", "4"}), one);
}

TEST_P(EveryOrbitStudy, DependsOnItsSeed) {
    std::string const first = hash({"--set", "study.seed=5"});
    EXPECT_EQ(hash({"--set", "study.seed=5"}), first);
    EXPECT_NE(hash({"--set", "study.seed=6"}), first);
}

TEST_P(EveryOrbitStudy, ReplaysMembersBitForBit) {
    ResultReader const all = with({});
    std::size_t const members = all.values("status").size();
    std::vector<std::map<std::string, std::vector<double>>> expected;
    for (std::size_t i = 0; i < members; ++i) expected.push_back(member_of(all, i));
    bool const has_sections = all.has("section_count");
    auto const sections = has_sections ? sections_of(all) : std::vector<std::vector<Section>>(members);
    for (auto const& [first, last] : {std::pair<std::size_t, std::size_t>{0, 0}, {members - 2, members - 1}, {1, 4}}) {
        ResultReader const part = with({"--members", fmt::format("{}..{}", first, last)});
        ASSERT_EQ(part.values("status").size(), last - first + 1);
        for (std::size_t i = first; i <= last; ++i) {
            EXPECT_EQ(part.values("member")[i - first], static_cast<double>(i));
            for (auto const& [name, values] : member_of(part, i - first)) {
                EXPECT_EQ(values, expected[i].at(name))
                    << name << " of member " << i << " in " << first << ".." << last;
            }
            if (has_sections) {
                EXPECT_EQ(sections_of(part)[i - first], sections[i]) << i;
            }
        }
    }
}

TEST_P(EveryOrbitStudy, IsToldByInfo) {
    ResultReader const file = with({});
    Outcome const outcome = run({"info", "r.nc"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("matches the data"), std::string::npos);
    bool const by_column = outcome.out.find("Largest exponent [1/s] per column") != std::string::npos;
    bool const in_all = outcome.out.find("Lyapunov exponents [1/s]") != std::string::npos;
    EXPECT_EQ(in_all || by_column, file.has("lyapunov_exponent"));
    EXPECT_EQ(by_column, !file.attribute("sweep_parameter").empty());
    if (file.has("section_count")) {
        std::string const line = fmt::format("{} of all members", file.values("section_time").size());
        EXPECT_NE(outcome.out.find(line), std::string::npos) << outcome.out;
    }
    if (!file.has("lyapunov_exponent") || !file.attribute("sweep_parameter").empty()) return;
    auto const exponents = file.values("lyapunov_exponent");
    std::size_t const members = file.values("status").size(), width = exponents.size() / members;
    for (std::size_t j = 0; j < width; ++j) {
        double sum = 0;
        for (std::size_t i = 0; i < members; ++i) sum += exponents[i * width + j];
        std::string const mean = fmt::format("{:.4g} ± ", sum / static_cast<double>(members));
        EXPECT_NE(outcome.out.find(mean), std::string::npos) << mean << outcome.out;
    }
}

auto const name_of_study = [](auto const& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Studies, EveryOrbitStudy, ::testing::ValuesIn(studies), name_of_study);

class OrbitsOverInstructions : public OrbitProgram, public ::testing::WithParamInterface<std::tuple<Study, Isa>> {};

TEST_P(OrbitsOverInstructions, HaveTheBitsOfTheScalarRun) {
    auto const& [study, isa] = GetParam();
    if (!is_supported(isa)) GTEST_SKIP() << "this machine has no " << name_of(isa);
    auto const hash = [&, &study = study](std::string const& name) {
        std::vector<std::string> options{"--isa", name, "--threads", "2"};
        options.insert(options.end(), study.options.begin(), study.options.end());
        return results_of(study.scene, options).computed_hash();
    };
    EXPECT_EQ(hash(std::string(name_of(isa))), hash("scalar"));
}

INSTANTIATE_TEST_SUITE_P(Studies, OrbitsOverInstructions,
                         ::testing::Combine(::testing::ValuesIn(studies), ::testing::ValuesIn(built_isas())),
                         [](auto const& info) {
                             return fmt::format("{}_{}", std::get<0>(info.param).name,
                                                name_of(std::get<1>(info.param)));
                         });

// ---- exponents ----

class ExponentsOfARun : public OrbitProgram {};

TEST_F(ExponentsOfARun, HaveTheirVariables) {
    ResultReader const file = results_of(lyapunov, {"--set", "study.history=10"});
    EXPECT_EQ(file.values("status"), std::vector<double>(member_total, 0));
    using Shape = std::vector<std::size_t>;
    EXPECT_EQ(file.shape("lyapunov_exponent"), (Shape{member_total, 2}));
    EXPECT_EQ(file.shape("lyapunov_exponent_error"), (Shape{member_total, 2}));
    EXPECT_EQ(file.shape("lyapunov_history"), (Shape{member_total, 10, 2}));
    EXPECT_EQ(file.shape("kaplan_yorke_dimension"), (Shape{member_total}));
    EXPECT_EQ(file.shape("lost_offsets"), (Shape{member_total}));
    EXPECT_EQ(file.values("exponent"), (std::vector<double>{1, 2}));
    EXPECT_EQ(file.values("history"), (std::vector<double>{10, 20, 30, 40, 50, 60, 70, 80, 90, 100}));
    EXPECT_FALSE(file.has("section_count"));
    auto const end = file.values("end_time"), time = file.values("lyapunov_time"),
               resolution = file.values("lyapunov_resolution"), exponents = file.values("lyapunov_exponent");
    for (std::size_t i = 0; i < member_total; ++i) {
        EXPECT_DOUBLE_EQ(end[i], 0.06);
        EXPECT_DOUBLE_EQ(time[i], 0.05);
        EXPECT_DOUBLE_EQ(resolution[i], 1e-15 / (1e-6 * 5e-4));  // rounding over d0 and dt
        EXPECT_GE(exponents[2 * i], exponents[2 * i + 1]);
        EXPECT_TRUE(std::isfinite(exponents[2 * i + 1]));
    }
}

TEST_F(ExponentsOfARun, AreTheEndOfTheirHistory) {
    // Of so short a run QR leaves some of ten out of order: they are sorted, and each history goes with its own exponent.
    for (std::size_t const count : {1u, 10u}) {
        ResultReader const file =
            results_of(lyapunov, {"--set", fmt::format("study.exponents={}", count), "--set", "study.history=7"});
        auto const exponents = file.values("lyapunov_exponent"), history = file.values("lyapunov_history");
        EXPECT_EQ(file.values("history").back(), 100);
        for (std::size_t i = 0; i < member_total; ++i) {
            EXPECT_TRUE(std::ranges::is_sorted(std::span(exponents).subspan(count * i, count), std::ranges::greater())) << i;
            for (std::size_t j = 0; j < count; ++j) {
                double const value = exponents[count * i + j];
                EXPECT_NEAR(history[(7 * i + 6) * count + j], value, 1e-11 * (1 + std::abs(value))) << i << ' ' << j;
            }
        }
        EXPECT_EQ(file.has("kaplan_yorke_dimension"), count > 1);
    }
    EXPECT_FALSE(results_of(lyapunov, {"--set", "study.history=0"}).has("lyapunov_history"));
}

TEST_F(ExponentsOfARun, ShowEachPointOfAShortHistoryOnce) {
    for (int const points : {1, 2, 5, 6}) {
        Outcome const outcome = run_scene(lyapunov, {"--set", fmt::format("study.history={}", points)});
        std::size_t shown = 0;
        for (auto at = outcome.out.find(" after "); at != std::string::npos; at = outcome.out.find(" after ", at + 1))
            ++shown;
        EXPECT_EQ(shown, std::min<std::size_t>(5, static_cast<std::size_t>(points))) << outcome.out;
        EXPECT_NE(outcome.out.find("after 100 rescalings"), std::string::npos) << outcome.out;
    }
}

TEST_F(ExponentsOfARun, OfAFailedMemberDisturbNobody) {
    ResultReader const whole = results_of(lyapunov);
    std::uint64_t const limit = steps_of_half(whole);
    auto const accepted = whole.values("steps_accepted"), rejected = whole.values("steps_rejected");
    std::vector<std::map<std::string, std::vector<double>>> expected;
    for (std::size_t i = 0; i < member_total; ++i) expected.push_back(member_of(whole, i));
    std::vector<std::string> const options{"--set", fmt::format("integrator.max_steps={}", limit), "-o", "r.nc"};
    Outcome const outcome = run_scene(lyapunov, options);
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(outcome.out.find("nan"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("Lyapunov exponents [1/s]"), std::string::npos) << outcome.out;
    ResultReader const file = results();
    auto const status = file.values("status"), time = file.values("lyapunov_time"),
               history = file.values("lyapunov_history");
    for (std::size_t i = 0; i < member_total; ++i) {
        bool const fails = accepted[i] + rejected[i] > static_cast<double>(limit);
        EXPECT_EQ(status[i], static_cast<double>(fails ? Status::max_steps : Status::finished)) << i;
        if (!fails) {
            EXPECT_EQ(member_of(file, i), expected[i]) << i;
            continue;
        }
        EXPECT_LT(time[i], 0.05);
        std::size_t const points = history.size() / member_total;
        EXPECT_TRUE(std::isnan(history[(i + 1) * points - 1])) << i;
        if (time[i] > 0.04) {
            EXPECT_FALSE(std::isnan(history[i * points])) << "what it came to is kept";
        }
    }
    EXPECT_EQ(run({"info", "r.nc"}).code, 0);
}

TEST_F(ExponentsOfARun, OfMembersThatFailAtOnceAreNone) {
    // The rod does not reach them.
    Outcome const outcome = run_scene(lyapunov, {"--any-start", "--max-failures", "100%", "--set", "initial.z=10", "-o", "r.nc"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("There are no exponents: no member finished"), std::string::npos) << outcome.out;
    ResultReader const file = results();
    for (char const* const name :
         {"lyapunov_exponent", "lyapunov_exponent_error", "lyapunov_history", "kaplan_yorke_dimension"}) {
        for (double const x : file.values(name)) EXPECT_TRUE(std::isnan(x)) << name;
    }
    EXPECT_EQ(file.values("lyapunov_time"), std::vector<double>(member_total, 0));
}

}  // namespace
}  // namespace slideway::testing::orbits::orbit_test
