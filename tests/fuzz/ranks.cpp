// What ranks say to each other: results of their work and errors, the invitation, questions.  The first byte says which.
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/backend/backend.hpp"
#include "host/run/rank_messages.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace slideway::fuzz {
namespace {

/// Bytes of a rank, as many as the first of them say.
std::string take_bytes(std::string_view& text) {
    std::size_t const size = std::min<std::size_t>(take_choice(text, 256), text.size());
    std::string bytes(text.substr(0, size));
    text.remove_prefix(size);
    return bytes;
}

/// Errors of other ranks may be of any kind; each is one line too.
template <class Work> bool passed(Work const& work) {
    return accepted([&] {
        try {
            work();
        } catch (DeviceError const& error) {
            throw FileError(error.what());
        } catch (std::bad_alloc const&) {
            throw FileError("out of memory");
        } catch (std::logic_error const&) {
            require(false, "no message leads out of its bytes");
        } catch (SceneError const&) {
            throw;
        } catch (FileError const&) {
            throw;
        } catch (std::runtime_error const& error) {
            throw FileError(error.what());
        }
    });
}

void read_results(std::string_view text) {
    std::vector<std::string> ranks;
    while (!text.empty()) ranks.push_back(take_bytes(text));
    EnsembleTotals sum;
    if (!passed([&] { sum = sum_of(ranks); })) return;
    EnsembleTotals again = sum_of({to_bytes(sum)});
    require(again.ended == sum.ended && again.stopped == sum.stopped && again.seconds == sum.seconds, "a sum is sent as it is");
}

void read_invitation_of(std::string_view text) {
    Invitation invitation;
    if (!passed([&] { invitation = read_invitation(text); })) return;
    require(read_invitation(to_text(invitation)) == invitation, "an invitation reads the same", text);
}

void read_question(std::string_view text) {
    Question question;
    std::memcpy(&question, text.data(), std::min(text.size(), sizeof question));
    bool const sound = passed([&] { require_sound(question); });
    if (sound && question.ask == Ask::end) require(question.finished <= message_limit, "nobody is asked for more than a message holds");
}

}  // namespace
}  // namespace slideway::fuzz

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    using namespace slideway;
    std::string_view text = fuzz::text_of(data, size);
    switch (fuzz::take_choice(text, 4)) {
        case 0:
            fuzz::read_results(text);
            break;
        case 1:
            fuzz::read_invitation_of(text);
            break;
        case 2:
            fuzz::read_question(text);
            break;
        default:
            fuzz::passed([&] { throw_again(text); });
    }
    return 0;
}
