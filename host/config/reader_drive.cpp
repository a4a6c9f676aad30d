// [drive]: what moves the mechanism.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "host/backend/own_modules.hpp"
#include "host/config/loads.hpp"
#include "host/config/reader.hpp"
#include "kernels/members/drive_period.hpp"

namespace slideway {
namespace {

constexpr std::string_view angle_unit[] = {"rad"}, speed_unit[] = {"rad/s"}, place_unit[] = {"m"}, velocity_unit[] = {"m/s"},
                           torque_units[] = {"1", "N m"};

/// Reads the table of a drive; what there must be of [drive], and what not, is checked (rules.cpp).
class DriveReader {
public:
    explicit DriveReader(Reading& reading) : reading_(reading), scene_(reading.scene) {}

    void read() {
        if (reading_.given("drive.table") == nullptr) return;
        auto drive = std::make_shared<SceneDrive>();
        if (scene_.parts.drive.by == DriveBy::profile) read_profile(*drive);
        else read_torque(*drive);
        scene_.parts.drive.table = drive->plan_table();
        scene_.drive = std::move(drive);
    }

private:
    Node const& given(std::string_view name) const { return *reading_.given(name); }
    std::size_t choice(std::string_view name, std::size_t preset) const {
        Node const* const given = reading_.given(name);
        return given == nullptr ? preset : read_choice(*given, setting(name));
    }
    bool repeats(bool preset) const {
        Node const* const given = reading_.given("drive.repeats");
        return given == nullptr ? preset : read_boolean(*given);
    }
    Interpolation interpolation() const { return static_cast<Interpolation>(choice("drive.interpolation", 0)); }

    LoadTable read_table(TableKind const& kind) const {
        Node const& column = given("drive.column");
        return read_table_of(reading_, given("drive.table"), column, read_text_value(column), kind);
    }

    void read_profile(SceneDrive& drive) const {
        bool const turns = info(scene_.parts.mechanism).drive == DriveKind::crank;
        Node const& gives = given("drive.gives");
        drive.gives = static_cast<ProfileGives>(read_choice(gives, setting("drive.gives")));
        if (drive.gives == (turns ? ProfileGives::position : ProfileGives::angle))
            refuse(gives, {turns ? "a crank has an angle" : "a carriage has no angle", turns ? "use \"angle\" or \"speed\"" : "use \"position\" or \"speed\""});
        auto const units = drive.gives == ProfileGives::angle      ? std::span(angle_unit)
                           : drive.gives == ProfileGives::position ? std::span(place_unit)
                                                                   : std::span(turns ? speed_unit : velocity_unit);
        TableKind const kind{"time", "s", units, repeats(false), interpolation(), drive.gives == ProfileGives::angle};
        if (kind.interpolation == Interpolation::linear && drive.gives != ProfileGives::speed)
            refuse(given("drive.interpolation"), {"speeds would jump at each row", "use \"spline\" or \"monotone\", or give speeds"});
        drive.table = read_table(kind);
        shape(drive, turns, given("drive.table"));
    }

    /// A speed becomes what it comes to; a crank begins at start_angle.
    void shape(SceneDrive& drive, bool turns, Node const& file) const {
        auto function = *drive.table.function;
        if (drive.gives == ProfileGives::speed) function = function.integral();
        if (!turns && drive.gives == ProfileGives::speed && function.table().repeats) bring_back(function, file);
        PieceTable const table = function.table();
        if (!table.repeats && table.low > 0)
            refuse(file, {fmt::format("its first time is {} s, and a run begins at 0", table.low), "begin it at 0 or earlier"});
        if (!turns && table.repeats && std::abs(table.advance) > 1e-9 * function.range())
            refuse(file, {fmt::format("the carriage is {:.3g} m further each time that it repeats", table.advance), "end it where it begins, or set repeats = false"});
        if (turns || drive.gives == ProfileGives::speed) function = function.less_its_value_at(0);
        // Rounding may have a run end behind its last row.
        if (!table.repeats) function = function.longer_by(1e-9);
        drive.table.function = std::make_shared<PieceFunction const>(std::move(function));
    }

    /// Speeds that are measured do not come back to the last digit: up to a hundredth of the way is shared out over the period.
    void bring_back(PieceFunction& function, Node const& file) const {
        PieceTable const table = function.table();
        double const drift = table.advance, length = table.high - table.low;
        if (std::abs(drift) > 0.01 * function.range() || drift == 0) return;
        function = function.less_a_line(drift / length);
        if (std::abs(drift) > 1e-6 * function.range())
            reading_.warn(fmt::format("{}: {} does not come back by {:.3g} m in a period: {:.3g} m/s are taken off its speeds", file.where, file.name, drift, drift / length));
    }

    void read_torque(SceneDrive& drive) const {
        std::size_t const over = read_choice(given("drive.over"), setting("drive.over"));
        static constexpr LoadArgument arguments[] = {LoadArgument::crank_speed, LoadArgument::crank_angle, LoadArgument::time};
        static constexpr std::string_view units[] = {"rad/s", "rad", "s"};
        scene_.parts.drive.over = arguments[over];
        drive.table = read_table({drive_arguments[over], units[over], torque_units, repeats(arguments[over] == LoadArgument::crank_angle), interpolation()});
    }

    Reading& reading_;
    Scene& scene_;
};

}  // namespace

void choose_drive(Reading& reading) {
    Scene& scene = reading.scene;
    Node const* const former = reading.given(former_crank);
    Node const* const table = former != nullptr ? former : reading.given("drive");
    if (table == nullptr) return;
    Node const* const kind = former != nullptr ? former : reading.given("drive.kind");
    DriveBy by = DriveBy::speed;
    if (former != nullptr) {
        bool const free = read_choice(*former, "crank", former_cranks) == 1;
        if (free) by = DriveBy::nothing;
        reading.warn(fmt::format("{}: mechanism.crank is of an earlier version; {}", former->where, free ? "write [drive] and kind = \"free\" below" : "remove it"));
    } else if (kind != nullptr) {
        by = static_cast<DriveBy>(read_choice(*kind, setting("drive.kind")));
    }
    MechanismInfo const& mechanism = info(scene.parts.mechanism);
    if (mechanism.drive == DriveKind::none || module_of(scene.parts.mechanism) != nullptr)
        refuse_meaningless(table->where, "drive", scene.parts.mechanism);
    scene.parts.drive.by = by;
    if (scene.parts.drive.turns_freely()) {
        auto const form = turning_form(scene.parts.mechanism);
        if (!form) refuse(*kind, {fmt::format("a {} has no crank that could turn freely", mechanism.name), "use \"speed\" or \"profile\""});
        scene.parts.mechanism = *form;
    }
}

void read_drive(Reading& reading) { DriveReader(reading).read(); }

void finish_drive(Scene& scene) {
    if (scene.parts.drive.by != DriveBy::profile) return;
    Inputs& in = scene.inputs;
    PieceFunction const& profile = *scene.drive->table.function;
    double const fastest = profile.steepest();
    in.profile_speed = profile.slope(0);
    // Tolerances are meant against the drive's rate: that of a crank as fast as the fastest here, times the scale, of a carriage as fast and as far.
    if (info(scene.parts.mechanism).drive == DriveKind::crank) in.crank_speed = fastest;
    if (info(scene.parts.mechanism).drive == DriveKind::carriage && fastest > 0) in.carriage_speed = fastest, in.stroke = profile.range();
}

void check_profile(Reading const& reading, double longest) {
    Scene const& scene = reading.scene;
    if (scene.parts.drive.by != DriveBy::profile || scene.parts.drive.table->repeats) return;
    PieceTable const& table = *scene.parts.drive.table;
    double const end = table.low + scene.drive->table.span;
    if (longest > table.high)
        refuse(*reading.given("drive.table"), {fmt::format("it ends at {:.10g} s, and the run at {:.10g} s", end, longest), "add rows, end the run earlier, or set repeats = true"});
}

// The period of what drives a mechanism: a revolution of its crank, or the carriage's way there and back; and what of it members may have.

namespace {

/// Low and high ends beyond which none of 1e15 draws lies.
std::pair<double, double> ends_of(Distribution const& d) {
    constexpr double deviations = 8, rare = 1e-15;
    switch (d.kind) {
        case Distribution::Kind::constant: return {d.mean, d.mean};
        case Distribution::Kind::normal: return {d.mean - deviations * d.sd, d.mean + deviations * d.sd};
        case Distribution::Kind::weibull: return {d.low + d.scale * std::pow(rare, 1 / d.shape), d.low + d.scale * std::pow(-std::log(rare), 1 / d.shape)};
        case Distribution::Kind::lognormal: {
            // Of ln(x - low): variance ln(1 + (sd/m)²) and mean ln m - variance/2, m = mean - low.
            double const m = d.mean - d.low, variance = std::log1p((d.sd / m) * (d.sd / m));
            double const median = m * std::exp(-variance / 2), spread = std::exp(deviations * std::sqrt(variance));
            return {d.low + median / spread, d.low + median * spread};
        }
        case Distribution::Kind::uniform:
        case Distribution::Kind::triangular:
        case Distribution::Kind::truncated_normal:
        case Distribution::Kind::values: break;
    }
    return {d.low, d.high};
}

/// Magnitudes that members may have of a key, in which they may differ: those of their own values, or of an end that they share.  None: one, the scene's.
std::optional<Range> magnitudes(Scene const& scene, Key const& key) {
    std::optional<Range> range;
    auto const take = [&](double low, double high) {
        double const least = low <= 0 && high >= 0 ? 0 : std::min(std::abs(low), std::abs(high)), most = std::max(std::abs(low), std::abs(high));
        range = range ? Range{std::min(range->low, least), std::max(range->high, most)} : Range{least, most};
    };
    auto const take_each = [&](std::vector<double> const& values) {
        for (double const value : values) take(value, value);
    };
    for (Variation const& variation : scene.variations) {
        if (variation.key != &key) continue;
        if (variation.column != Variation::no_column) {
            MemberTable const& table = *scene.design.table;
            for (std::size_t row = 0; row < std::min<std::size_t>(table.rows(), scene.members); ++row) {
                double const value = table.values[row * table.columns + variation.column];
                if (!broken_rule(key, value)) take(value, value);  // other members fail before they run
            }
        } else if (variation.distribution.kind == Distribution::Kind::values) {
            take_each(variation.distribution.list);
        } else {
            auto const [low, high] = ends_of(variation.distribution);
            take(low, high);
        }
    }
    if (scene.chaos.parameter == &key) take_each(scene.chaos.values);
    return range;
}

}  // namespace

double drive_period(Parts const& parts, Inputs const& inputs) { return drive_period(info(parts.mechanism), parts.drive, inputs); }

double turn_length(Scene const& scene) { return scene.goes_by_turns() ? 2 * std::numbers::pi : drive_period(scene.parts, scene.inputs); }

double first_time_at(double phase, Parts const& parts, Inputs const& inputs) { return first_time_at(phase, info(parts.mechanism), parts.drive, inputs); }

double steady_period(Parts parts, Inputs const& inputs) {
    parts.drive = {};
    return drive_period(parts, inputs);
}

std::string why_no_period(Parts const& parts) {
    if (parts.drive.by == DriveBy::profile) return "the drive's profile does not repeat";
    if (parts.drive.by == DriveBy::torque) return "no speed is given of a crank on a motor";
    if (parts.drive.by == DriveBy::nothing) return "nothing drives a free crank";
    if (info(parts.mechanism).drive != DriveKind::none) return "mechanism.crank_speed is 0";
    return std::string("nothing drives a ") + info(parts.mechanism).name;
}

PeriodRange drive_periods(Scene const& scene) {
    Inputs shortest = scene.inputs, longest = scene.inputs;
    PeriodRange range{0, 0, nullptr};
    /// @param at_least, at_most whose period has the key's least and largest magnitude
    auto const vary = [&](std::string_view name, Inputs& at_least, Inputs& at_most) {
        Key const& key = *find_key(name);
        auto const varied = magnitudes(scene, key);
        if (varied && range.varied == nullptr) range.varied = &key;
        double const own = std::abs(key.get(scene.inputs));
        key.set(at_least, varied ? varied->low : own);
        key.set(at_most, varied ? varied->high : own);
    };
    if (info(scene.parts.mechanism).drive == DriveKind::carriage) {
        vary("mechanism.carriage_speed", longest, shortest);
        vary("mechanism.stroke", shortest, longest);
        vary("mechanism.reversal_time", shortest, longest);
    } else if (std::isfinite(drive_period(scene.parts, Inputs{}))) {
        vary("mechanism.crank_speed", longest, shortest);
    }
    range.least = drive_period(scene.parts, shortest);
    range.most = drive_period(scene.parts, longest);
    return range;
}

double fastest_period(Scene const& scene) {
    if (scene.parts.drive.by == DriveBy::speed) {
        // What scatters by less has the steps of the scene's own member.
        constexpr double little = 0.8;
        double const own = drive_period(scene.parts, scene.inputs), least = drive_periods(scene).least;
        return scene.study == StudyKind::sweep || least < little * own ? least : own;
    }
    auto const largest = [&](std::string_view name) {
        Key const& key = *find_key(name);
        auto const varied = magnitudes(scene, key);
        return varied ? varied->high : std::abs(key.get(scene.inputs));
    };
    Inputs in = scene.inputs;
    if (scene.parts.drive.turns_freely()) {
        in.crank_speed = std::max(largest("mechanism.crank_speed"), largest("drive.no_load_speed"));
    } else {
        double const scale = largest("drive.scale");
        in.crank_speed *= scale, in.carriage_speed *= scale, in.stroke *= scale;
    }
    return steady_period(scene.parts, in);
}

double shortest_reversal(Scene const& scene) {
    auto const varied = magnitudes(scene, *find_key("mechanism.reversal_time"));
    // Members at 0 fail before they run.
    return varied && varied->low > 0 ? varied->low : scene.inputs.reversal_time;
}

}  // namespace slideway
