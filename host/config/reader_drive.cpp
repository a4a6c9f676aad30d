// [drive]: what moves the mechanism.
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "host/backend/own_modules.hpp"
#include "host/config/loads.hpp"
#include "host/config/reader.hpp"

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

}  // namespace slideway
