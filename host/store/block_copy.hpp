// A block's results that outlive the buffers they came from.
#pragma once

#include <span>
#include <vector>

#include "host/run/block_result.hpp"

namespace slideway {

class BlockCopy {
public:
    explicit BlockCopy(BlockResult const& block)
        : members_(of(block.members)),
          inputs_(of(block.inputs)),
          records_(of(block.records)),
          final_states_(of(block.final_states)),
          quantities_(of(block.quantities)),
          series_(of(block.series)),
          sections_(of(block.sections)),
          growths_(of(block.growths)) {}

    /// Of the copy; it must outlive what it gives.
    BlockResult view() const {
        return {members_, inputs_, records_, final_states_, quantities_, series_, sections_, growths_};
    }

private:
    template <class T> static std::vector<T> of(std::span<T const> values) { return {values.begin(), values.end()}; }

    std::vector<std::uint64_t> members_;
    std::vector<Inputs> inputs_;
    std::vector<MemberRecord> records_;
    std::vector<double> final_states_, quantities_, series_, sections_, growths_;
};

}  // namespace slideway
