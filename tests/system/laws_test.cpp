// Every contact law and every mechanism in every study that it may have, run through the program.
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "host/backend/backend.hpp"
#include "tests/support/scene_fixture.hpp"
#include "tests/system/results.hpp"

namespace slideway::testing::laws_test {
namespace {

/// The keys of a study of a few milliseconds.
constexpr std::tuple<char const*, char const*> studies[] = {
    {"ensemble", "duration = \"20 ms\"\nsamples = 5\nquantities = [\"energy_residual\", \"mode_time\"]"},
    {"lyapunov", "Ttr = \"5 ms\"\nduration = \"20 ms\"\ndt = \"0.5 ms\"\nexponents = 2"},
    {"poincare", "Ttr = \"5 ms\"\nduration = \"30 ms\"\nsection = { on = \"pitch\", value = 0 }"},
    {"sweep", "parameter = \"joint.clearance\"\nvalues = [\"0.2 mm\", \"0.1 mm\"]\ntransient_revolutions = 0\nrevolutions = 2\n"
              "exponents = 1\nrescalings_per_revolution = 20"},
    {"tolerance", "duration = \"20 ms\"\nquantities = [\"peak_normal_force\"]"},
};

class LawInStudies : public ProgramWithResults, public ::testing::WithParamInterface<Parts> {
protected:
    /// "" if the mechanism has no such study.
    std::string scene(std::string const& study, std::string const& lines) const {
        MechanismInfo const& mechanism = info(GetParam().mechanism);
        bool const repeats = mechanism.drive != DriveKind::none;
        if ((study == "lyapunov" || study == "sweep") && !(mechanism.has_exponents && repeats)) return "";
        std::string drive;
        if (mechanism.drive == DriveKind::crank) drive = "crank_speed = 300\n";
        if (mechanism.drive == DriveKind::carriage) drive = "carriage_speed = 2\nstroke = \"10 mm\"\nreversal_time = \"5 ms\"\n";
        return fmt::format(
            "schema = 1\n[mechanism]\nkind = \"{}\"\n{}[contact]\n{}[friction]\n[initial]\npitch = -1e-4\n"
            "[integrator]\nrtol = 1e-5\natol = 1e-5\n[study]\nkind = \"{}\"\nmembers = 5\n{}\n"
            "[study.vary]\n\"initial.y\" = {{ dist = \"unif\", low = \"-0.03 mm\", high = \"0.03 mm\" }}\n",
            mechanism.name, drive, mechanism.spatial ? fmt::format("law = \"{}\"\n", info(GetParam().law).name) : "", study,
            lines);
    }
};

TEST_P(LawInStudies, Runs) {
    LawInfo const& law = info(GetParam().law);
    int runs = 0;
    for (auto const& [study, lines] : studies) {
        SCOPED_TRACE(study);
        std::string const text = scene(study, lines);
        if (text.empty()) continue;
        write("s.toml", text);
        for (Isa const isa : std::set{Isa::scalar, best_isa()}) {
            std::string const name = std::string(study) + "_" + std::string(name_of(isa)) + ".nc";
            Outcome const outcome = run({"run", "s.toml", "--no-progress", "--threads", "2", "--isa", std::string(name_of(isa)), "-o", name});
            ASSERT_EQ(outcome.code, 0) << outcome.err;
        }
        ResultReader const file = results(std::string(study) + "_scalar.nc");
        for (double const status : file.values("status")) EXPECT_EQ(status, static_cast<double>(Status::finished));
        EXPECT_EQ(file.computed_hash(), hash_of(std::string(study) + "_" + std::string(name_of(best_isa())) + ".nc"));
        EXPECT_EQ(file.attribute("mechanism_meaning"), info(GetParam().mechanism).meaning);
        if (info(GetParam().mechanism).spatial) {
            EXPECT_EQ(file.attribute("contact_law_meaning"), law.words);
        }
        ++runs;
    }
    EXPECT_GE(runs, 3);
}

INSTANTIATE_TEST_SUITE_P(All, LawInStudies, ::testing::ValuesIn(mechanisms_and_laws()), [](auto const& p) {
    MechanismInfo const& mechanism = slideway::info(p.param.mechanism);
    return mechanism.name + (mechanism.spatial ? "_" + std::string(slideway::info(p.param.law).name) : "");
});

}  // namespace
}  // namespace slideway::testing::laws_test
