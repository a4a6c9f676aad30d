// How many members a worker takes at once.
#pragma once

#include <cstddef>
#include <cstdint>

#include "host/backend/backend.hpp"

namespace slideway {

struct BlockSizes {
    std::size_t fixed = 0;  // > 0: always so many
    BlockBounds bounds;
    double seconds = 10;  // that a block should take: a process that is killed loses the blocks it works on
};

/// On a processor, where workers have a core each:
/// the last members of a block leave lanes idle, so blocks should be large; a crash loses those in work, and the last ones of a run leave
/// threads idle, so they should be small.  Large ensembles begin with small blocks, whose time tells how many members make up
/// `seconds`, and how much work their ends leave undone; towards the end of the run blocks shrink with what is left.
/// On a machine that workers share a block is never less than fills it, whatever their number: two kernels that fill half a card each
/// take as long as one that fills it, and the ends of some blocks overlap with others.
class BlockSizer {
public:
    static constexpr std::uint64_t untried = 512;  // members of a block whose cost nobody knows, at most
    /// @param workers threads of all ranks.
    BlockSizer(BlockSizes const& sizes, std::uint64_t members, int workers);
    /// @param left members that nobody has taken.
    std::uint64_t next(std::uint64_t left) const;
    /// What a block took.  @param utilisation of its lanes, useful over executed lane steps
    void measured(std::uint64_t members, double seconds, double utilisation);

private:
    std::uint64_t in_time() const;

    BlockSizes const sizes_;
    std::uint64_t const members_, workers_;
    double seconds_per_member_ = 0;  // 0: not known yet
    double idle_members_ = 0;        // what the end of a block leaves idle, in members' work
};

}  // namespace slideway
