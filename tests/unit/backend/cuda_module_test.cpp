// The module with the kernels for cards, as a program finds it: none, one that is no module, one of another version, one of its own.
#include "host/backend/cuda_module.hpp"

#include <cstdlib>
#include <type_traits>

#include <fmt/format.h>

#include "host/backend/commit.hpp"
#include "tests/support/shell.hpp"
#include "tests/system/small_run.hpp"

namespace slideway::testing::cuda_module_test {
namespace {

std::string module_file(std::string const& kind) { return fmt::format("{}/card_module_{}.so", SLIDEWAY_CARD_MODULES, kind); }

/// SLIDEWAY_CUDA_MODULE while it lives.
class Named {
public:
    explicit Named(std::string const& file) { setenv("SLIDEWAY_CUDA_MODULE", file.c_str(), 1); }
    Named(Named const&) = delete;
    ~Named() { unsetenv("SLIDEWAY_CUDA_MODULE"); }
};

/// What asking for a card throws; its type must be that one exactly.
template <class Error> std::string words_of(CardShare const& share = {}) {
    try {
        cuda_backend(share);
    } catch (NoDevice const& error) {
        EXPECT_TRUE((std::is_same_v<Error, NoDevice>)) << error.what();
        return error.what();
    } catch (DeviceError const& error) {
        EXPECT_TRUE((std::is_same_v<Error, DeviceError>)) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "there is a card";
    return "";
}

TEST(CudaModule, ThatIsNamedMustBeThere) {
    std::string const file = module_file("of_nobody");
    Named const named(file);
    EXPECT_EQ(words_of<DeviceError>(),
              fmt::format("cuda: SLIDEWAY_CUDA_MODULE is {}, and that is no file; unset it, or use --backend cpu", file));
}

TEST(CudaModule, ThatIsNoLibraryIsRefused) {
    std::string const file = SLIDEWAY_SOURCE "/LICENSE";
    Named const named(file);
    std::string const words = words_of<DeviceError>();
    EXPECT_TRUE(words.starts_with(fmt::format("cuda: {} cannot be opened (", file))) << words;
    EXPECT_TRUE(words.ends_with("; use --backend cpu")) << words;
}

TEST(CudaModule, ThatIsALibraryOfOthersIsRefused) {
    std::string const file = module_file("of_others");
    Named const named(file);
    EXPECT_EQ(words_of<DeviceError>(), fmt::format("cuda: {} is no module of slideway; use --backend cpu", file));
}

TEST(CudaModule, OfAnotherVersionIsRefused) {
    for (auto const& [kind, build] : {std::pair{"older", "slideway 0.0.9, commit abc, GNU 1"},
                                      std::pair{"other_interface", "slideway 9.9.9, commit def, GNU 99"}}) {
        std::string const file = module_file(kind);
        Named const named(file);
        EXPECT_EQ(words_of<DeviceError>(),
                  fmt::format("cuda: {} is of {}, this program of {}; build both from the same sources, or use --backend cpu",
                              file, build, SLIDEWAY_BUILD));
    }
}

TEST(CudaModule, OfChangedSourcesIsRefused) {
    std::string const file = module_file("other_layout");
    Named const named(file);
    EXPECT_EQ(words_of<DeviceError>(), fmt::format("cuda: {} is of other sources than this program, both of {}; build both "
                                                   "from the same sources, or use --backend cpu", file, SLIDEWAY_BUILD));
}

// They cross the border as what they are, from its functions and from its objects.
TEST(CudaModule, OfItsOwnLetsErrorsArrive) {
    Named const named(module_file("own"));
    EXPECT_EQ(words_of<NoDevice>({0, 1}), "cuda: no card in this module; use --backend cpu");
    EXPECT_EQ(words_of<DeviceError>({1, 2}), "cuda: a broken card; use --backend cpu");
    auto const card = cuda_backend({2, 3});
    EXPECT_EQ(card->machine(), "no GPU, sm_00");
    EXPECT_THROW(card->bounds({}), DeviceError);
    Block block;
    EXPECT_THROW(card->kernel({}, false)(block), DeviceError);
}

/// Runs of the program, none of which finds a card.
class RunWithoutCard : public SmallRun {
protected:
    /// The line about the backend of a run large enough for a card.
    std::string said() const {
        Outcome const outcome = run({"run", "s.toml", "-o", "s.nc", "--threads", "1", "--set", "study.duration=1 us",
                                     "study.members=1000"});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.err.substr(0, outcome.err.find('\n'));
    }
    std::string listed() const {
        std::string const all = run({"list"}).out;
        auto const at = all.find("\n  cuda  ");
        return all.substr(at, all.find('\n', at + 1) - at);
    }
    std::string const processor_ = fmt::format("backend cpu ({}, {} lanes)", name_of(best_isa()), lanes_of(best_isa()));
};

TEST_F(RunWithoutCard, ForTheModuleIsOfAnotherVersion) {
    std::string const file = module_file("older");
    Named const named(file);
    std::string const words =
        fmt::format("cuda: {} is of slideway 0.0.9, commit abc, GNU 1, this program of {}", file, SLIDEWAY_BUILD);
    expect_refusal(4, words, {"run", "s.toml", "-o", "s.nc", "--no-progress", "--backend", "cuda"});
    EXPECT_FALSE(std::filesystem::exists(path("s.nc")));
    EXPECT_EQ(said(), processor_ + ": " + words);
    EXPECT_NE(listed().find(words), std::string::npos) << listed();
}

TEST_F(RunWithoutCard, ForTheModuleFindsNone) {
    Named const named(module_file("own"));
    expect_refusal(4, "cuda: no card in this module; use --backend cpu", {"run", "s.toml", "-o", "s.nc", "--no-progress", "--backend", "cuda"});
    EXPECT_EQ(said(), processor_);
}

// A copy of the program in folders of its own, as installed.
TEST_F(RunWithoutCard, ForNoModuleLiesWhereItIsLookedFor) {
    namespace fs = std::filesystem;
    for (char const* const folder : {"bin", "lib/slideway"}) fs::create_directories(path(folder));
    fs::copy_file(SLIDEWAY_BINARY, path("bin/slideway"));
    auto const refusal = [&] {
        auto const outcome = run_shell(path(""), "unset SLIDEWAY_CUDA_MODULE; bin/slideway run s.toml -o s.nc --no-progress --backend cuda");
        EXPECT_EQ(outcome.code, 4);
        return outcome.err;
    };
    std::string const root = fs::canonical(path("")).string();
    EXPECT_EQ(refusal(), fmt::format("cuda: no libslideway_cuda.so beside the program in {0}/bin, nor in {0}/lib/slideway; build it "
                                     "(-DSLIDEWAY_CUDA=ON), or use --backend cpu\n", root));
    // Nobody who asked for no card hears of it.
    auto const unasked = run_shell(path(""), "bin/slideway run s.toml -o s.nc --set study.members=1000 'study.duration=1 us'");
    EXPECT_EQ(unasked.code, 0);
    EXPECT_TRUE(unasked.err.starts_with("backend cpu (")) << unasked.err;
    EXPECT_EQ(unasked.err.find("cuda"), std::string::npos) << unasked.err;
    // Beside the program comes before where it is installed.
    fs::copy_file(module_file("own"), path("lib/slideway/libslideway_cuda.so"));
    EXPECT_EQ(refusal(), "cuda: no card in this module; use --backend cpu\n");
    fs::copy_file(module_file("of_others"), path("bin/libslideway_cuda.so"));
    EXPECT_EQ(refusal(), fmt::format("cuda: {}/bin/libslideway_cuda.so is no module of slideway; use --backend cpu\n", root));
}

}  // namespace
}  // namespace slideway::testing::cuda_module_test
