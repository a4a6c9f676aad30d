// One block of members as the bytes of a result file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/run/block_result.hpp"
#include "host/store/data_file.hpp"
#include "host/store/provenance.hpp"
#include "host/store/result_layout.hpp"

namespace slideway {

/// An ordinary result file of the block's members that have ended; those that were cut short are not in it.
struct ShardImage {
    MemberSet members;
    std::vector<std::byte> bytes;  // empty if none have ended
};

/// The rows of those members of a block that have ended, into an empty file.
/// @param layout of the run; its members do not count.  @param study the study's columns of the block's members.  @return the members
MemberSet write_block(DataFile& file, ResultLayout layout, BlockResult const& block, StudyValues const& study);

/// @param layout of the run; its members do not count.  @param study the study's columns of the block's members.
/// @param name of the file, for messages.  @throws FileError
ShardImage shard_image(std::string const& name, ResultLayout layout, Provenance const& provenance,
                       BlockResult const& block, StudyValues const& study);

}  // namespace slideway
