// What ranks say to each other, as bytes and back.  Bytes of another program, or of another build of this one, are refused in one line.
#pragma once

#include <cstdint>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "host/run/ensemble.hpp"
#include "host/run/member_set.hpp"

namespace slideway {

/// More bytes than this are no message.
inline constexpr std::uint64_t message_limit = 0x7fffffff;

/// How the work of a rank ended: what it came to, or an error, which there is of the same kind and has the same line.
std::string to_bytes(EnsembleTotals const& totals);
std::string to_bytes(std::exception_ptr const& error);
/// @throws the error of these bytes; SceneError if they are none
[[noreturn]] void throw_again(std::string_view bytes);
/// What all ranks came to; their longest time.  @throws the first error among them; SceneError for what is neither
EnsembleTotals sum_of(std::vector<std::string> const& ranks);

/// What rank 0 tells the others before they begin.
struct Invitation {
    std::string isa;           // of its kernels
    std::uint64_t before = 0;  // members that earlier runs have finished
    MemberSet todo;
    friend bool operator==(Invitation const&, Invitation const&) = default;
};
/// "avx2 48 0-15,40-63"
std::string to_text(Invitation const& invitation);
/// @throws SceneError if it is no such text
Invitation read_invitation(std::string_view text);

enum class Ask : std::uint64_t { places, abandon, end };  // `end` is followed by as many bytes as it says it `finished`

/// What a rank asks of rank 0, as it is sent.
struct Question {
    std::uint64_t wanted = 0, finished = 0;
    Ask ask = Ask::places;
};
/// @throws SceneError for what no rank asks
void require_sound(Question const& question);

}  // namespace slideway
