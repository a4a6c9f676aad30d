#include "host/config/units.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <dlfcn.h>
#include <fmt/format.h>
#include <udunits2.h>

#include "host/base/csv.hpp"
#include "host/base/error.hpp"
#include "host/base/numbers.hpp"

namespace slideway {
namespace {

using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;

/// Powers of the basic units, the radian among them.
struct Signature {
    std::map<std::string, int> powers;
    bool proportional = true;  // no origin, no logarithm
    friend bool operator==(Signature const&, Signature const&) = default;
};

void add_power(void* signature, ut_unit const* basic, int power) {
    char const* const name = ut_get_name(basic, UT_ASCII);
    if (power != 0) static_cast<Signature*>(signature)->powers[name != nullptr ? name : "?"] += power;
}
ut_status add_basic(ut_unit const* unit, void* signature) { return add_power(signature, unit, 1), UT_SUCCESS; }
ut_status add_product(ut_unit const*, int count, ut_unit const* const* basics, int const* powers, void* signature) {
    for (int i = 0; i < count; ++i) add_power(signature, basics[i], powers[i]);
    return UT_SUCCESS;
}
ut_status add_scaled(ut_unit const*, double scale, ut_unit const* underlying, double origin, void* signature);
ut_status not_proportional(void* signature) { return static_cast<Signature*>(signature)->proportional = false, UT_SUCCESS; }
ut_status add_timestamp(ut_unit const*, ut_unit const*, double, void* signature) { return not_proportional(signature); }
ut_status add_logarithm(ut_unit const*, double, ut_unit const*, void* signature) { return not_proportional(signature); }
constexpr ut_visitor signature_visitor{add_basic, add_product, add_scaled, add_timestamp, add_logarithm};

ut_status add_scaled(ut_unit const*, double, ut_unit const* underlying, double origin, void* signature) {
    if (origin != 0) not_proportional(signature);
    return ut_accept_visitor(underlying, &signature_visitor, signature);
}

Signature signature_of(Unit const& unit) {
    Signature signature;
    if (ut_accept_visitor(unit.get(), &signature_visitor, &signature) != UT_SUCCESS) signature.proportional = false;
    return signature;
}

/// The units database that lies beside the object that this code is in, as in a Python wheel; "" where the system's is meant.
std::string database_beside_us() {
    namespace fs = std::filesystem;
    if (std::getenv("UDUNITS2_XML_PATH") != nullptr) return {};
    static constexpr char here = 0;
    Dl_info object{};
    std::error_code ignored;
    fs::path file = dladdr(&here, &object) != 0 && object.dli_fname != nullptr ? object.dli_fname : "";
    if (!file.is_absolute()) file = fs::read_symlink("/proc/self/exe", ignored);
    for (char const* const share : {"share", "../share"}) {
        fs::path const database = file.parent_path() / share / "udunits" / "udunits2.xml";
        if (fs::is_regular_file(database, ignored)) return database.string();
    }
    return {};
}

/// The one unit system of the process.  UDUNITS-2 keeps a status and a parser in static variables: hold `mutex`.
class UnitSystem {
public:
    std::mutex mutex;

    UnitSystem() {
        ut_set_error_message_handler(ut_ignore);  // by default it writes to stderr
        std::string const beside = database_beside_us();
        system_ = ut_read_xml(beside.empty() ? nullptr : beside.c_str());
        if (system_ == nullptr) {
            throw FileError("the units database of UDUNITS-2 cannot be read; install the package libudunits2-data");
        }
        add_symbol("deg", "degree");
        add_symbol("rev", "revolution");
    }
    ~UnitSystem() { ut_free_system(system_); }
    UnitSystem(UnitSystem const&) = delete;
    UnitSystem& operator=(UnitSystem const&) = delete;

    Unit parse(std::string const& text) const { return {ut_parse(system_, text.c_str(), UT_UTF8), ut_free}; }

private:
    void add_symbol(char const* symbol, char const* name) {
        Unit const unit = parse(name);
        if (unit) ut_map_symbol_to_unit(symbol, UT_ASCII, unit.get());
    }
    ut_system* system_ = nullptr;
};

UnitSystem& unit_system() {
    static UnitSystem system;
    return system;
}

std::string example_of(std::string_view unit) {
    static std::map<std::string_view, std::string_view> const examples = {{"m", "mm"}, {"rad", "deg"}, {"rad/s", "rpm or deg/s"}, {"m/s", "mm/s"},
                                                                         {"Pa", "GPa"}, {"kg", "g"}, {"s", "ms"}};
    auto const found = examples.find(unit);
    return found == examples.end() ? fmt::format("use a unit like {}", unit) : fmt::format("use a unit like {} or {}", unit, found->second);
}

/// What most scenes say, without the database: reading that is a sixth of the work of a small run.
std::optional<double> usual_factor(std::string_view given, std::string_view unit) {
    struct Usual { std::string_view given, unit; double factor; };
    static constexpr Usual usual[] = {{"mm", "m", 1e-3}, {"um", "m", 1e-6},        {"ms", "s", 1e-3},  {"us", "s", 1e-6},
                                      {"g", "kg", 1e-3}, {"mm/s", "m/s", 1e-3}, {"MPa", "Pa", 1e6}, {"GPa", "Pa", 1e9}};
    if (given == unit && unit != "1") return 1;
    auto const found = std::ranges::find_if(usual, [&](Usual const& u) { return u.given == given && u.unit == unit; });
    return found == std::end(usual) ? std::nullopt : std::optional(found->factor);
}

std::variant<double, Problem> factor_of(std::string const& given, std::string_view unit) {
    if (auto const factor = usual_factor(given, unit)) return *factor;
    std::string const advice = unit == "1" ? "use a plain number" : example_of(unit), wanted = unit == "1" ? "a plain number" : std::string(unit);
    UnitSystem& system = unit_system();
    std::scoped_lock const lock(system.mutex);
    Unit const from = system.parse(given);
    if (!from) return Problem{fmt::format("UDUNITS-2 knows no unit \"{}\"", given), advice};
    Unit const to = system.parse(std::string(unit));
    Signature const signature = signature_of(from);
    double value = NAN;
    if (signature.proportional && signature == signature_of(to)) {
        std::unique_ptr<cv_converter, decltype(&cv_free)> const converter(ut_get_converter(from.get(), to.get()), cv_free);
        if (converter) value = cv_convert_double(converter.get(), 1.0);
    }
    if (value > 0 && std::isfinite(value)) return value;
    return Problem{fmt::format("the unit \"{}\" does not convert to {}", given, wanted), advice};
}

/// number · 10^shift, rounded once.
double shifted(std::string_view number, int shift) {
    auto const e = number.find_first_of("eE");
    std::string_view const mantissa = number.substr(0, e);
    int exponent = 0;
    if (e != std::string_view::npos) {
        std::string_view digits = number.substr(e + 1);
        if (digits.starts_with('+')) digits.remove_prefix(1);
        exponent = parse_number<int>(digits).value_or(0);
    }
    // "0e2147483647 km"
    return parse_number<double>(fmt::format("{}e{}", mantissa, static_cast<long long>(exponent) + shift)).value_or(NAN);  // beyond double
}

double scaled(std::string_view number, double value, double factor) {
    int const shift = static_cast<int>(std::lround(std::log10(factor)));
    bool const power_of_ten = std::abs(factor * std::pow(10.0, -shift) - 1) < 1e-14;
    return power_of_ten ? shifted(number, shift) : value * factor;
}

constexpr std::size_t longest_unit = 100;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// UDUNITS-2 takes numbers in a unit for factors: "1 500 rpm" would be 500 rpm.  Digits are welcome in exponents alone, behind the letter
/// or the sign of power that they belong to: "m2", "s-1", "m^2", "m**-2".
bool has_factor(std::string_view unit) {
    if (unit.starts_with("1/")) unit.remove_prefix(2);
    for (std::size_t i = 0; i < unit.size(); ++i) {
        if (!is_digit(unit[i])) continue;
        std::size_t before = i;
        if (before > 0 && (unit[before - 1] == '-' || unit[before - 1] == '+')) --before;
        bool const power = before > 0 && (unit[before - 1] == '^' || (before > 1 && unit.substr(before - 2, 2) == "**"));
        auto const letter = before > 0 ? static_cast<unsigned char>(unit[before - 1]) : 0;
        if (!power && !std::isalpha(letter) && letter < 0x80) return true;
        while (i < unit.size() && is_digit(unit[i])) ++i;
    }
    return false;
}

bool is_unit_text(std::string_view text) {
    constexpr std::string_view never_first = "+-.,";
    constexpr std::string_view never{"\0\n", 2};  // UDUNITS-2 writes a line's end that it meets to the standard output
    return text.size() <= longest_unit && text.find_first_of(never) == text.npos && !has_factor(text) &&
           (text.empty() || never_first.find(text.front()) == text.npos);
}

/// What was meant by digits behind a number: "1 500 rpm", "1,5 mm".
std::string meant(std::string_view number, std::string_view rest) {
    auto const digits = std::find_if_not(rest.begin() + (rest.front() == ',' ? 1 : 0), rest.end(), is_digit);
    auto const count = digits - rest.begin();
    if (rest.front() == ',' && count > 1) return fmt::format("write a point: \"{}.{}\"", number, rest.substr(1));
    if (count == 3 && digits != rest.end()) return fmt::format("write \"{}{}\"", number, rest);
    return "write one number and its unit";
}

}  // namespace

double UnitFactor::operator()(std::string_view number, double value) const {
    if (factor_ == 1 || !std::isfinite(value)) return value;
    double const si = scaled(number, value, factor_);
    return std::isnan(si) ? value * factor_ : si;  // beyond the range of double: infinite or zero
}

std::variant<UnitFactor, Problem> unit_factor(std::string_view given, std::string_view unit) {
    if (!is_unit_text(given)) return Problem{"it is no unit", unit == "1" ? std::string("use a plain number") : example_of(unit)};
    auto factor = factor_of(std::string(given), unit);
    if (auto* const problem = std::get_if<Problem>(&factor)) return std::move(*problem);
    return UnitFactor(std::get<double>(factor));
}

std::variant<double, Problem> to_si(std::string_view text, std::string_view unit) {
    constexpr std::string_view blanks = " \t";
    std::string const example = unit == "1" ? "use a plain number like 0.5" : fmt::format("use a text like \"1 {}\"", unit);
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    text = text.substr(0, text.find_last_not_of(blanks) + 1);
    if (text.starts_with('+')) text.remove_prefix(1);

    double value = 0;
    auto const [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem == std::errc::result_out_of_range) return Problem{"beyond the range of double", "use a number between 1e-307 and 1e308"};
    if (problem != std::errc()) return Problem{"it does not begin with a number", example};
    if (!std::isfinite(value)) return Problem{"not a finite number", "use a finite number"};

    std::string_view const number = text.substr(0, static_cast<std::size_t>(end - text.data()));
    std::string_view rest = text.substr(number.size());
    rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
    if (rest.empty() && unit == "1") return value;
    if (rest.empty()) return Problem{"a text needs a unit", fmt::format("write the unit, \"{} {}\", or the number without quotes", number, unit)};
    if (!is_unit_text(rest)) return Problem{fmt::format("what follows the number {} is no unit", number), meant(number, rest)};
    auto factor = factor_of(std::string(rest), unit);
    if (auto* const fault = std::get_if<Problem>(&factor)) return std::move(*fault);
    double const si = scaled(number, value, std::get<double>(factor));
    if (!std::isfinite(si)) return Problem{fmt::format("beyond the range of double in {}", unit), "use another number"};
    return si;
}

ColumnHeader column_header(std::string_view text) {
    auto const bracket = text.find('[');
    ColumnHeader header{std::string(trimmed(text.substr(0, bracket))), {}, false};
    if (bracket == text.npos) return header;
    header.is_open = !text.ends_with(']');
    header.unit = trimmed(text.substr(bracket + 1, text.size() - bracket - (header.is_open ? 1 : 2)));
    return header;
}

std::variant<UnitFactor, Problem> ColumnHeader::factor_to(std::string_view si_unit) const {
    if (!unit) return UnitFactor(1);
    if (is_open) return Problem{"its unit has no end", fmt::format("write \"{} [{}]\"", name, si_unit)};
    return unit_factor(*unit, si_unit);
}

bool is_plain_si(std::string_view unit) {
    constexpr std::string_view known[] = {"m", "kg", "s", "rad", "N", "J", "W", "Pa", "Hz", "K", "A", "V"};
    constexpr std::string_view between = " /.*^-0123456789";
    bool any = unit == "1";
    for (auto at = unit.find_first_not_of(between); at != unit.npos; at = unit.find_first_not_of(between, at)) {
        auto const end = std::min(unit.find_first_of(between, at), unit.size());
        if (std::ranges::find(known, unit.substr(at, end - at)) == std::end(known)) return false;
        any = true, at = end;
    }
    return any;
}

}  // namespace slideway
