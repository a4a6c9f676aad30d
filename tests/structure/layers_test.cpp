#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/structure/layers.hpp"

namespace slideway::structure::layers_test {
namespace {

std::vector<SourceFile> layered_sources() {
    auto files = files_below({"kernels", "host"});
    std::erase_if(files, [](SourceFile const& f) { return !has_ending(f.path, {".hpp", ".cpp", ".cu"}); });
    return files;
}

template <class Rule> void expect_kept(std::vector<SourceFile> const& files, Rule rule) {
    ASSERT_FALSE(files.empty());
    for (SourceFile const& file : files) {
        for (std::string const& violation : rule(file)) ADD_FAILURE() << violation;
    }
}

SourceFile including(std::string path, std::string const& included) {
    return {std::move(path), "#include \"" + included + "\"\n"};
}

TEST(Layers, NothingIncludesUpward) { expect_kept(layered_sources(), include_violations); }

TEST(Layers, FoldersIncludeEachOtherOneWay) {
    for (std::string const& violation : circle_violations(layered_sources())) ADD_FAILURE() << violation;
}

/// The models of the tests, written as kernels are; models.hpp is how the tests run them.
std::vector<SourceFile> model_headers() {
    auto files = files_below({"tests/models"});
    std::erase_if(files,
                  [](SourceFile const& f) { return !f.path.ends_with(".hpp") || f.path == "tests/models/models.hpp"; });
    return files;
}

TEST(Layers, OnlyTheVocabularyKnowsBackends) {
    expect_kept(layered_sources(), backend_violations);
    expect_kept(model_headers(), backend_violations);
}

TEST(Layers, KernelsNeitherThrowNorAllocate) {
    expect_kept(files_below({"kernels"}), kernel_violations);
    expect_kept(model_headers(), kernel_violations);
}

TEST(Layers, CardsHoldNoPhysicsOfTheirOwn) {
    auto const files = layered_sources();
    EXPECT_EQ(std::ranges::count(files, "host/backend/cuda.cu", &SourceFile::path), 1);
    expect_kept(files, card_violations);
}

TEST(LayerRules, UpwardIncludeIsFound) {
    EXPECT_EQ(include_violations(including("kernels/laws/line.hpp", "kernels/joint/joint.hpp")).size(), 1u);
    EXPECT_EQ(include_violations(including("host/config/scene.cpp", "host/commands/run.hpp")).size(), 1u);
    EXPECT_EQ(include_violations(including("kernels/integrate.hpp", "host/config/scene.hpp")).size(), 1u);
    EXPECT_TRUE(include_violations(including("kernels/joint/joint.hpp", "kernels/laws/line.hpp")).empty());
    EXPECT_TRUE(include_violations(including("host/commands/run.cpp", "host/config/scene.hpp")).empty());
}

TEST(LayerRules, VocabularyIncludesNothingOfOurs) {
    EXPECT_EQ(include_violations(including("kernels/real.hpp", "kernels/status.hpp")).size(), 1u);
    EXPECT_EQ(include_violations(including("kernels/simd/x86.hpp", "kernels/real.hpp")).size(), 1u);
    EXPECT_TRUE(include_violations(including("kernels/real.hpp", "kernels/simd/instructions.hpp")).empty());
}

TEST(LayerRules, PlainDataIsForEveryoneAndIncludesPlainDataOnly) {
    EXPECT_TRUE(include_violations(including("kernels/models/probe.hpp", "kernels/block.hpp")).empty());
    EXPECT_TRUE(include_violations(including("host/store/writer.cpp", "kernels/observers/quantities.hpp")).empty());
    EXPECT_TRUE(include_violations(including("kernels/block.hpp", "kernels/status.hpp")).empty());
    EXPECT_EQ(include_violations(including("kernels/block.hpp", "kernels/real.hpp")).size(), 1u);
}

TEST(LayerRules, PhysicsIsKnownToTheBackendAlone) {
    EXPECT_TRUE(include_violations(including("host/backend/cpu.cpp", "kernels/integrate.hpp")).empty());
    EXPECT_EQ(include_violations(including("host/study/ensemble.cpp", "kernels/integrate.hpp")).size(), 1u);
}

TEST(LayerRules, ClosedFormsAreForTheHostAndOfPlainData) {
    EXPECT_TRUE(include_violations(including("host/config/keys.cpp", "kernels/members/complete_inputs.hpp")).empty());
    EXPECT_TRUE(include_violations(including("kernels/members/start.hpp", "kernels/inputs.hpp")).empty());
    EXPECT_EQ(include_violations(including("kernels/members/start.hpp", "kernels/math/sincos.hpp")).size(), 1u);
    EXPECT_EQ(include_violations(including("kernels/lanes/roster.hpp", "kernels/members/start.hpp")).size(), 1u);
}

TEST(LayerRules, OneUnitNamesEveryLawAndMechanism) {
    EXPECT_TRUE(include_violations(including("host/config/descriptors.cpp", "kernels/all_laws.hpp")).empty());
    EXPECT_EQ(include_violations(including("host/config/keys.cpp", "kernels/all_laws.hpp")).size(), 1u);
    EXPECT_EQ(include_violations(including("kernels/joint/joint.hpp", "kernels/all_mechanisms.hpp")).size(), 1u);
}

TEST(LayerRules, UnknownPlacesAreFound) {
    EXPECT_EQ(include_violations({"kernels/extras/thing.hpp", ""}).size(), 1u);
    EXPECT_EQ(include_violations(including("host/commands/run.cpp", "run.hpp")).size(), 1u);
}

TEST(LayerRules, CommentedIncludeDoesNotCount) {
    EXPECT_TRUE(include_violations({"kernels/laws/line.hpp", "// #include \"host/commands/run.hpp\"\n"}).empty());
    EXPECT_TRUE(include_violations({"kernels/laws/line.hpp", "/*\n#include \"host/commands/run.hpp\"\n*/\n"}).empty());
}

TEST(LayerRules, CircleOfFoldersOfOneRankIsFound) {
    auto const there = including("host/run/ensemble.cpp", "host/store/writer.hpp");
    auto const back = including("host/store/writer.cpp", "host/run/progress.hpp");
    EXPECT_TRUE(circle_violations({there}).empty());
    EXPECT_EQ(circle_violations({there, back}).size(), 2u);
}

TEST(LayerRules, InstructionSetsAndCudaAreFoundInCodeOnly) {
    EXPECT_EQ(backend_violations({"kernels/math/vec3.hpp", "auto x = _mm256_add_pd(a, b);\n"}).size(), 1u);
    EXPECT_EQ(backend_violations({"host/run/run.cpp", "xsimd::batch<double> x;\n"}).size(), 1u);
    EXPECT_EQ(backend_violations({"kernels/laws/line.hpp", "#ifdef __CUDA_ARCH__\n"}).size(), 1u);
    EXPECT_TRUE(backend_violations({"kernels/laws/line.hpp", "// as xsimd does; __CUDACC__\n"}).empty());
    EXPECT_TRUE(backend_violations({"host/commands/list.cpp", "print(\"xsimd\");\n"}).empty());
    EXPECT_TRUE(backend_violations({"kernels/real.hpp", "xsimd::batch<double> x;\n"}).empty());
    EXPECT_EQ(backend_violations({"kernels/real.hpp", "_mm_fmadd_pd(a, b, c);\n"}).size(), 1u);
    EXPECT_EQ(backend_violations({"kernels/real.hpp", "vfmaq_f64(a, b, c);\n"}).size(), 1u);
    EXPECT_TRUE(backend_violations({"kernels/simd/x86.hpp", "_mm256_fmadd_pd(a, b, c);\n"}).empty());
    EXPECT_TRUE(backend_violations({"kernels/simd/neon.hpp", "vfmaq_f64(a, b, c);\n"}).empty());
}

TEST(LayerRules, PhysicsOnCardsIsFound) {
    auto const violations = [](std::string const& text) {
        return card_violations({"host/backend/cuda.cu", text}).size();
    };
    EXPECT_EQ(violations("__global__ void drift(double* x) {\n    x[0] = x[0] + x[1];\n}\n"), 1u);
    EXPECT_EQ(violations("__global__ void drop(double* x) {\n    x[0] -= 9.81;\n}\n"), 1u);
    EXPECT_EQ(violations("__global__ void start(GridTask task) {\n    if (task.parts.friction) run(task);\n}\n"), 1u);
    EXPECT_EQ(violations("__device__ double square(double x) {\n    return power(x);\n}\n"), 1u);
    EXPECT_EQ(violations("struct Spring {\n    double stiffness;\n};\n"), 1u);
    EXPECT_EQ(violations("#include \"kernels/joint/joint.hpp\"\n"), 1u);
    EXPECT_EQ(violations("#include \"kernels/integrate.hpp\"\n// 2.0 * x + y\n"), 0u);
    EXPECT_EQ(violations("template <class Model> __global__ void go(GridTask task) {\n    run(task, Model{});\n}\n"),
              0u);
    EXPECT_EQ(card_violations({"host/backend/cuda_more.cu", ""}).size(), 1u);
    EXPECT_EQ(card_violations(including("host/backend/cuda_backend.cpp", "kernels/integrate.hpp")).size(), 1u);
    EXPECT_TRUE(card_violations(including("host/backend/cuda_backend.cpp", "kernels/block.hpp")).empty());
}

TEST(LayerRules, ThrowAndAllocationInKernelsAreFound) {
    EXPECT_EQ(kernel_violations({"kernels/laws/line.hpp", "throw 1;\n"}).size(), 1u);
    EXPECT_EQ(kernel_violations({"kernels/laws/line.hpp", "std::vector<double> x;\n"}).size(), 1u);
    EXPECT_EQ(kernel_violations({"kernels/laws/line.cpp", ""}).size(), 1u);
    EXPECT_TRUE(kernel_violations({"kernels/laws/line.hpp", "Line(Line const&) = delete;\n"}).empty());
}

}  // namespace
}  // namespace slideway::structure::layers_test
