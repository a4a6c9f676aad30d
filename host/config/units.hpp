// Numbers with units, by UDUNITS-2.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "host/config/keys.hpp"

namespace slideway {

/// The value of `text` ("0.1 mm", "30 rpm") in the SI unit `unit`, or why it has none.
///
/// Stricter than UDUNITS-2, which takes the radian for the number 1: angles count as a dimension here, so that
/// "5 Hz" is no angular speed and "3 rad" no plain number.  Units with an origin or a logarithm are refused.  `deg` and
/// `rev` are added to the units of UDUNITS-2.  A text without a unit is good for unit "1" alone.  A factor
/// that is a power of ten moves the decimal point, so that "0.1 mm" and 1e-4 have the same bits.  Thread-safe.
/// @throws FileError when UDUNITS-2's database is not installed.
std::variant<double, Problem> to_si(std::string_view text, std::string_view unit);

/// From one unit to an SI unit, found once for many numbers; the bits are those of `to_si`.
class UnitFactor {
public:
    explicit UnitFactor(double factor) : factor_(factor) {}
    /// @param number its decimal digits without a leading +, @param value the same as a double; in SI units
    double operator()(std::string_view number, double value) const;

private:
    double factor_;
};
/// The factor from `given` ("mm") to the SI unit `unit`, or why there is none.  @throws FileError as `to_si`
std::variant<UnitFactor, Problem> unit_factor(std::string_view given, std::string_view unit);

/// What stands above a column: "joint.clearance [mm]", a name and perhaps the unit of its numbers.
struct ColumnHeader {
    std::string name;
    std::optional<std::string> unit;
    bool is_open = false;  // its bracket does not end

    /// The factor to an SI unit, 1 without a unit, or why there is none.  @throws FileError as `to_si`
    std::variant<UnitFactor, Problem> factor_to(std::string_view si_unit) const;
};
ColumnHeader column_header(std::string_view text);

/// Whether a unit is "1", or made of units of SI without prefixes (but kg), as "N s/m" is: values are taken as they are.
bool is_plain_si(std::string_view unit);

}  // namespace slideway
