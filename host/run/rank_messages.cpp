#include "host/run/rank_messages.hpp"

#include <algorithm>
#include <cstring>
#include <new>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>

#include "host/backend/backend.hpp"
#include "host/base/error.hpp"
#include "host/base/numbers.hpp"

namespace slideway {
namespace {

static_assert(std::is_trivially_copyable_v<EnsembleTotals>, "ranks send it as bytes");

// What the bytes of a rank begin with: how it ended, a failure by what it was.
constexpr char succeeded = '+', of_scene = 's', of_file = 'f', of_device = 'd', of_memory = 'm', unknown = '-';

[[noreturn]] void refuse(std::string_view what) {
    throw SceneError(fmt::format("slideway: {} of another rank is none of this program's; start the same slideway as every rank", what));
}

/// On one line, whatever it says.
std::string line_of(std::string_view bytes) {
    std::string line(bytes);
    std::ranges::replace_if(line, [](char byte) { return static_cast<unsigned char>(byte) < 0x20 || byte == 0x7f; }, ' ');
    return line;
}

EnsembleTotals read_totals(std::string_view bytes) {
    EnsembleTotals totals;
    if (bytes.size() != sizeof totals) refuse("the result");
    std::memcpy(&totals, bytes.data(), sizeof totals);
    bool const is_known = totals.stopped >= StopReason::none && totals.stopped <= StopReason::time_limit;
    if (!is_known || !(totals.seconds >= 0)) refuse("the result");
    return totals;
}

/// Takes the text up to the next blank, which must be there.
std::string_view take_word(std::string_view& text) {
    std::size_t const end = text.find(' ');
    if (end == text.npos || end == 0) refuse("the invitation");
    std::string_view const word = text.substr(0, end);
    text.remove_prefix(end + 1);
    return word;
}

}  // namespace

std::string to_bytes(EnsembleTotals const& totals) {
    std::string bytes(1 + sizeof totals, succeeded);
    std::memcpy(bytes.data() + 1, &totals, sizeof totals);
    return bytes;
}

std::string to_bytes(std::exception_ptr const& error) {
    auto const as = [](char kind, std::exception const& found) { return kind + std::string(found.what()); };
    try {
        std::rethrow_exception(error);
    } catch (SceneError const& found) {
        return as(of_scene, found);
    } catch (FileError const& found) {
        return as(of_file, found);
    } catch (DeviceError const& found) {
        return as(of_device, found);
    } catch (std::bad_alloc const& found) {
        return as(of_memory, found);
    } catch (std::exception const& found) {
        return as(unknown, found);
    }
}

void throw_again(std::string_view bytes) {
    if (bytes.size() < 2) refuse("the error");
    std::string const line = line_of(bytes.substr(1));
    switch (bytes.front()) {
        case of_scene:
            throw SceneError(line);
        case of_file:
            throw FileError(line);
        case of_device:
            throw DeviceError(line);
        case of_memory:
            throw std::bad_alloc();
        case unknown:
            throw std::runtime_error(line);
        default:
            refuse("the error");
    }
}

EnsembleTotals sum_of(std::vector<std::string> const& ranks) {
    EnsembleTotals totals;
    double longest = 0;
    for (std::string_view const bytes : ranks) {
        if (!bytes.starts_with(succeeded)) throw_again(bytes);
        EnsembleTotals const of_rank = read_totals(bytes.substr(1));
        longest = std::max(longest, of_rank.seconds);
        totals += of_rank;
    }
    totals.seconds = longest;
    return totals;
}

std::string to_text(Invitation const& invitation) {
    return fmt::format("{} {} {}", invitation.isa, invitation.before, invitation.todo.text());
}

Invitation read_invitation(std::string_view text) {
    std::string const isa(take_word(text));
    auto const before = parse_number<std::uint64_t>(take_word(text));
    auto todo = MemberSet::parse(text);  // none where all have run, and are left to be merged
    if (!before || !todo) refuse("the invitation");
    return {isa, *before, *std::move(todo)};
}

void require_sound(Question const& question) {
    bool const is_known = question.ask == Ask::places || question.ask == Ask::abandon || question.ask == Ask::end;
    if (!is_known || (question.ask == Ask::end && question.finished > message_limit)) refuse("a question");
}

}  // namespace slideway
