// Kernels that are modules: where the program finds them, which it refuses, and how it comes by one that nobody has compiled yet.
#include <dlfcn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>

#include "host/backend/backend.hpp"
#include "host/backend/kernel_sources.hpp"
#include "tests/system/results.hpp"

namespace slideway::testing::kernel_modules_test {
namespace {

namespace fs = std::filesystem;

constexpr char const* scene = R"(
schema = 1
[mechanism]
kind = "free_slider"
[contact]
law = "rigid"
restitution = 0.5
[study]
members = 5
duration = "20 ms"
quantities = ["contact_onsets"]
verify = 0
[study.vary]
"initial.y" = { dist = "unif", low = "-0.09 mm", high = "0.09 mm" }
)";

/// A copy of the program in a folder of its own, which has no modules beside it.
class KernelModules : public ProgramWithResults {
protected:
    KernelModules() {
        write("s.toml", scene);
        fs::create_directories(path("tree/bin"));
        fs::copy_file(tested_program, path("tree/bin/slideway"));
    }
    ~KernelModules() override { unsetenv("SLIDEWAY_MODULES"); }

    static std::string name() { return fmt::format("slideway_rigid_SliderBase_{}", name_of(compiled_isa(best_isa()))); }
    static fs::path own() { return fs::path(tested_program).parent_path() / "kernels" / (name() + ".so"); }
    static std::string bytes(fs::path const& file) {
        std::ifstream in(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    /// The copy, with the scene.
    Outcome run_copy() const {
        std::string const at = path(".").string();
        int const status = std::system(fmt::format("cd '{0}' && tree/bin/slideway run s.toml --no-progress --force -o copy.nc >out 2>err", at).c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), file_text(path("out")), file_text(path("err"))};
    }
    void expect_refused(std::string const& part) const {
        Outcome const outcome = run_copy();
        EXPECT_EQ(outcome.code, 4) << outcome.err;
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    }
    void expect_result_of_all() {
        Outcome const whole = run({"run", "s.toml", "--no-progress", "--force", "-o", "whole.nc"}), copy = run_copy();
        ASSERT_EQ(whole.code, 0) << whole.err;
        ASSERT_EQ(copy.code, 0) << copy.err;
        EXPECT_EQ(hash_of("copy.nc"), hash_of("whole.nc"));
    }
};

TEST_F(KernelModules, ThatAreNowhereAreOneLine) { expect_refused(fmt::format("there is no {}.so", name())); }

TEST_F(KernelModules, LieBesideTheProgramWhereItIsInstalledOrWhereOneSays) {
    for (std::string const place : {"tree/bin/kernels", "tree/lib/slideway", "elsewhere"}) {
        SCOPED_TRACE(place);
        fs::create_directories(path(place));
        fs::copy_file(own(), path(place) / own().filename());
        if (place == "elsewhere") setenv("SLIDEWAY_MODULES", (path("nowhere").string() + ":" + path(place).string()).c_str(), 1);
        expect_result_of_all();
        fs::remove_all(path(place));
    }
}

TEST_F(KernelModules, OfOtherSourcesDamagedOrForeignAreRefused) {
    std::string const whole = bytes(own());
    auto const at = whole.find(SLIDEWAY_KERNEL_SOURCES);
    ASSERT_NE(at, whole.npos);
    std::string other = whole;
    other[at] = other[at] == '0' ? '1' : '0';
    fs::create_directories(path("tree/bin/kernels"));
    Dl_info mathematics{};
    ASSERT_NE(dladdr(reinterpret_cast<void const*>(&lgamma_r), &mathematics), 0);
    fs::path const file = path("tree/bin/kernels") / own().filename();
    for (auto const& [text, part] : {std::pair{other, "is of another version of slideway's kernels"}, std::pair{whole.substr(0, whole.size() / 2), "cannot be opened"},
                                     std::pair{std::string(), "cannot be opened"}, std::pair{std::string("no module\n"), "cannot be opened"},
                                     std::pair{bytes(tested_program), "cannot be opened"}, std::pair{bytes(mathematics.dli_fname), "is no module"}}) {
        std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
        expect_refused(part);
    }
}

/// In the folder of a build: here of one whose compiler is `cp`.
TEST_F(KernelModules, AreCompiledWhereTheProgramLiesInItsBuild) {
    // In a folder of somebody else's build nothing is compiled.
    write("tree/CMakeCache.txt", "CMAKE_PROJECT_NAME:STATIC=other\nCMAKE_GENERATOR:INTERNAL=Ninja\n");
    write("tree/build.ninja", "");
    expect_refused("install slideway as a whole");
    write("tree/CMakeCache.txt", "CMAKE_PROJECT_NAME:STATIC=slideway\nCMAKE_GENERATOR:INTERNAL=Ninja\nCMAKE_MAKE_PROGRAM:FILEPATH=ninja\n");
    write("tree/build.ninja", fmt::format("rule copy\n  command = mkdir -p bin/kernels && cp $in $out\nbuild bin/kernels/{0}.so: copy {1}\nbuild {0}: phony bin/kernels/{0}.so\n",
                                          name(), own().string()));
    expect_result_of_all();
    EXPECT_TRUE(fs::exists(path("tree/bin/kernels") / own().filename()));
    EXPECT_EQ(run_copy().err.find("compiles"), std::string::npos);
    // One of other sources is compiled again, one that does not compile is said.
    write("tree/bin/kernels/" + own().filename().string(), "old");
    fs::last_write_time(path("tree/bin/kernels") / own().filename(), fs::file_time_type::min());
    EXPECT_EQ(run_copy().code, 0);
    write("tree/build.ninja", fmt::format("rule fail\n  command = false\nbuild {0}: fail\n", name()));
    fs::remove(path("tree/bin/kernels") / own().filename());
    Outcome const outcome = run_copy();
    EXPECT_EQ(outcome.code, 4);
    EXPECT_NE(outcome.err.find("could not be compiled"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace slideway::testing::kernel_modules_test
