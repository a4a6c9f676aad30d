// The card that tests run on, and the processor beside it.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "host/backend/backend.hpp"
#include "tests/support/varied_blocks.hpp"

namespace slideway::testing {

#if defined(SLIDEWAY_SIMULATED_MODULE)
inline constexpr char const* simulated_module = SLIDEWAY_SIMULATED_MODULE;
#else
inline constexpr char const* simulated_module = nullptr;
#endif

/// Tests of a card are skipped where there is none; a simulated one there always is.
class Card : public ::testing::Test {
protected:
    void SetUp() override {
        if (simulated_module != nullptr) setenv("SLIDEWAY_CUDA_MODULE", simulated_module, 1);
        try {
            card_ = cuda_backend();
        } catch (NoDevice const& error) {
            if (simulated_module != nullptr) FAIL() << error.what();
            GTEST_SKIP() << error.what();
        }
    }

    /// Whether its kernels round as the processor's do.
    bool has_bits_of_the_processor() const { return !card_->isa().ends_with("-fmad"); }

    void run(OwnedBlock& block) const { kernel_of(*card_, block.plan())(block.block); }

    static BlockKernel kernel_of(Backend const& backend, BlockPlan const& plan) {
        return backend.kernel(plan.parts, plan.shadows.count > 0);
    }
    static void run_on_processor(OwnedBlock& block) { kernel_of(*cpu_backend(Isa::scalar), block.plan())(block.block); }

    std::shared_ptr<Backend const> card_;
};

}  // namespace slideway::testing
