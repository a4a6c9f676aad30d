// A result does not tell which instruction set it was computed with, but for its name.
#include <filesystem>

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
        Outcome outcome = run({"run", "s.toml", "--isa", isa, "-o", output});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome;
    }
};

TEST_F(InstructionSets, HaveOneHash) {
    run_with("scalar", "scalar.nc");
    for (double const onsets : results("scalar.nc").values("contact_onsets")) EXPECT_GT(onsets, 0);
    for (Isa const isa : built_isas()) {
        if (!is_supported(isa)) continue;
        std::string const name(name_of(isa));
        run_with(name, "other.nc");
        EXPECT_EQ(hash_of("other.nc"), hash_of("scalar.nc")) << name;
        std::filesystem::remove(path("other.nc"));
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
