// A number in a text, all of the text or none.
#pragma once

#include <charconv>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

namespace slideway {

/// What stands where there is no number.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// What the whole text says, without blanks or a +; nothing where it is no number or beyond the type.
/// @param base of an integer: parse_number<int>("ff", 16)
template <class Number, class... Base> std::optional<Number> parse_number(std::string_view text, Base... base) {
    Number value{};
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base...);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace slideway
