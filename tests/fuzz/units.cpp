// Numbers with units.  The first byte says in which unit they are wanted.
#include <array>
#include <cmath>
#include <string>
#include <variant>

#include "host/base/csv.hpp"
#include "host/config/units.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace slideway::fuzz {
namespace {

void require_one_line(Problem const& problem) {
    accepted([&] { throw SceneError(problem.reason + "; " + problem.advice); });
}

/// "0.1 mm" has the bits that the factor of mm gives 0.1.
void compare_with_factor(std::string_view text, std::string_view unit, double value) {
    auto const blank = text.find(' ');
    if (blank == text.npos) return;
    std::string_view const number = text.substr(0, blank);
    double plain = 0;
    if (number.empty() || number.front() == '+' || !read_plain_number(number, plain)) return;
    auto const factor = unit_factor(trimmed(text.substr(blank + 1)), unit);
    auto const* const convert = std::get_if<UnitFactor>(&factor);
    if (convert == nullptr) return;
    require((*convert)(number, plain) == value, "the same by its factor", text);
}

}  // namespace
}  // namespace slideway::fuzz

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    using namespace slideway;
    static constexpr std::array<char const*, 12> units = {"1",  "m",  "rad",    "s",        "kg",     "rad/s",
                                                          "Pa", "m/s", "kg m2", "s/m", "N", "N/m"};
    std::string_view text = fuzz::text_of(data, size);
    std::string_view const unit = units[fuzz::take_choice(text, units.size())];
    auto const result = to_si(text, unit);
    if (auto const* const problem = std::get_if<Problem>(&result)) {
        fuzz::require_one_line(*problem);
        return 0;
    }
    double const value = std::get<double>(result);
    fuzz::require(!std::isnan(value), "a number with a unit is a number", text);
    fuzz::compare_with_factor(text, unit, value);
    return 0;
}
