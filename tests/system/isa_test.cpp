// A result does not tell which instruction set it was computed with, but for its name.
#include <filesystem>

#include <fmt/format.h>

#include "host/backend/backend.hpp"
#include "tests/support/shell.hpp"
#include "tests/system/results.hpp"

namespace slideway::testing::isa_test {
namespace {

constexpr char const* scene = R"(
schema = 1
[contact]
law = "conservative"
[friction]
[study]
members = 8
duration = "12 ms"
quantities = ["energy_residual", "contact_onsets"]
[study.vary]
"initial.y" = { dist = "unif", low = "-0.09 mm", high = "0.09 mm" }
)";

class InstructionSets : public ProgramWithResults {
protected:
    InstructionSets() { write("s.toml", scene); }
    Outcome run_with(std::string const& isa, std::string const& output) const {
        Outcome outcome = run({"run", "s.toml", "--isa", isa, "--force", "-o", output});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome;
    }
    void expect_one_hash_with(std::vector<std::string> const& laws) const;
};

/// A study of each mechanism with some laws, and with neighbours where it has exponents: what is compiled for an instruction set.
void InstructionSets::expect_one_hash_with(std::vector<std::string> const& laws) const {
    struct Machine {
        char const *words, *starts;
    };
    constexpr char const* of_space = "\"initial.y\" = {dist=\"unif\", low=-9e-5, high=9e-5}, \"initial.roll\" = {dist=\"unif\", low=-1e-3, high=1e-3}";
    constexpr char const* of_plane = "\"initial.pitch\" = {dist=\"unif\", low=-1e-3, high=1e-3}";
    for (Machine const& machine : {Machine{"kind = \"slider_crank\"\ncrank_speed = 60.0", of_space}, {"kind = \"carriage\"\nreversal_time = 2e-4\nstroke = 1e-3\ncarriage_speed = 0.5", of_space},
                                   {"kind = \"scotch_yoke\"\ncrank_speed = 60.0", of_space}, {"kind = \"free_slider\"", of_space},
                                   {"kind = \"planar_slider_crank\"\ncrank_speed = 60.0", of_plane}}) {
        bool const planar = machine.starts == of_plane, drives = std::string_view(machine.words).find("free") == std::string_view::npos;
        for (std::string const& law : laws) {
            if (planar && law != "paper" && law != "rigid") continue;
            for (bool const exponents : {false, true}) {
                if (exponents && (!drives || (!planar && law != "paper" && law != "rigid"))) continue;
                SCOPED_TRACE(fmt::format("{} {} exponents: {}", machine.words, law, exponents));
                std::string const contact = law == "rigid" ? "law = \"rigid\"\nrestitution = 0.5\n" : planar ? "" : "law = \"" + law + "\"\n";
                std::string const study = exponents ? "kind = \"lyapunov\"\ntransient_revolutions = 0\nrevolutions = 0.1\nrescalings_per_revolution = 200\nmembers = 3\n"
                                                    : "duration = \"8 ms\"\nmembers = 9\nquantities = [\"energy_residual\", \"contact_onsets\"]\n";
                write("s.toml", fmt::format("schema = 1\n[mechanism]\n{}\n[contact]\n{}[friction]\n[study]\nverify = 0\n{}vary = {{ {} }}\n", machine.words, contact, study,
                                            machine.starts));
                for (Isa const isa : built_isas()) {
                    if (!is_supported(isa)) continue;
                    std::string const name(name_of(isa));
                    run_with(name, name + ".nc");
                    EXPECT_EQ(hash_of(name + ".nc"), hash_of("scalar.nc")) << name;
                }
            }
        }
    }
}

TEST_F(InstructionSets, HaveOneHashWithEachLaw) { expect_one_hash_with({"paper", "conservative", "kelvin_voigt", "foundation"}); }
TEST_F(InstructionSets, HaveOneHashWithRigidContacts) { expect_one_hash_with({"rigid"}); }

/// Starts that touch know their speed from then on, of neighbours too: what that costs is not for those beside them in a pack to pay.
TEST_F(InstructionSets, HaveOneHashWhereSomeStartsTouch) {
    for (std::string const study : {"kind = \"lyapunov\"\ntransient_revolutions = 0\nrevolutions = 0.001\n", "duration = \"0.8 ms\"\n"}) {
        write("s.toml", "schema = 1\n[contact]\nlaw = \"foundation\"\nrestitution = 0.5\n[friction]\n[study]\nseed = 7\nmembers = 13\nverify = 0\n" + study +
                            "[study.vary]\n\"initial.y\" = {dist=\"unif\", low=\"-0.105 mm\", high=\"0.105 mm\"}\n\"initial.vy\" = {dist=\"unif\", low=-0.02, high=0.02}\n");
        for (Isa const isa : built_isas()) {
            if (!is_supported(isa)) continue;
            std::string const name(name_of(isa));
            run_with(name, name + ".nc");
            EXPECT_EQ(hash_of(name + ".nc"), hash_of("scalar.nc")) << name << ", " << study;
        }
    }
}

TEST_F(InstructionSets, OfMachinesWithoutFusedMultiplyAddAreScalarAndSlow) {
    if (!is_supported(Isa::scalar_libm)) GTEST_SKIP() << "scalar_libm is not in this build";
    Outcome const outcome = run_with("scalar_libm", "libm.nc");
    std::string const slow = "scalar, the C library's fused multiply-add: slow";
    EXPECT_NE(outcome.err.find("backend cpu (" + slow + ")"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.out.find(slow), std::string::npos) << outcome.out;
    EXPECT_NE(run({"check", "s.toml", "--isa", "scalar_libm"}).out.find(slow), std::string::npos);
    EXPECT_EQ(results("libm.nc").attribute("isa"), "scalar");
    // One goes on with what the other began.
    EXPECT_EQ(run({"run", "s.toml", "--isa", "scalar_libm", "--shard", "1/2", "-o", "both.nc", "--no-progress"}).code, 0);
    EXPECT_EQ(run({"run", "s.toml", "--isa", "scalar", "--resume", "-o", "both.nc", "--no-progress"}).code, 0);
    EXPECT_EQ(hash_of("both.nc"), hash_of("libm.nc"));
}

TEST_F(InstructionSets, HaveOneHashWhereTheCLibraryHasNoInstructionEither) {
    if (!is_supported(Isa::scalar_libm)) GTEST_SKIP() << "scalar_libm is not in this build";
    run_with("scalar", "scalar.nc");
    // The GNU C library then takes its own arithmetic; others do not know the variable, and the test says nothing.
    std::string const without = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2 ";
    ShellOutcome const outcome = run_shell(
        path(""), without + "'" SLIDEWAY_BINARY "' run s.toml --no-progress --isa scalar_libm --threads 1 -o libm.nc");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(hash_of("libm.nc"), hash_of("scalar.nc"));
}

TEST_F(InstructionSets, HaveOneHashOnAProcessorOf2006) {
    if (!is_supported(Isa::scalar_libm)) GTEST_SKIP() << "scalar_libm is not in this build";
    if (run_shell(path(""), "command -v qemu-x86_64").code != 0) GTEST_SKIP() << "qemu-user is not installed";
    run_with("scalar", "here.nc");
    ShellOutcome const outcome = run_shell(
        path(""), "qemu-x86_64 -cpu core2duo '" SLIDEWAY_BINARY "' run s.toml --backend cpu --threads 1 -o there.nc");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("the C library's fused multiply-add: slow"), std::string::npos) << outcome.err;
    EXPECT_EQ(hash_of("there.nc"), hash_of("here.nc"));
}

}  // namespace
}  // namespace slideway::testing::isa_test
