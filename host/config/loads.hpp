// [load.<name>], [spring.<name>], [stop.<name>], [ground_motion] and [film]: what acts on a mechanism beside its weight, its contacts and its drive
// (docs/explanation/model.md 14).  And [way_profile.<name>] and [way_ends]: how the faces of its way run, and how far (docs/explanation/model.md 18).
#pragma once

#include <deque>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/config/piece_function.hpp"
#include "kernels/key.hpp"
#include "kernels/loads/drive_plan.hpp"
#include "kernels/loads/load_list.hpp"

namespace slideway {

struct Node;
struct Reading;
struct Setting;

/// Tables of loads in a scene, in the order of LoadKind.
inline constexpr std::string_view load_tables[] = {"load", "spring", "stop", "ground_motion", "way_profile", "way_ends", "film"};
constexpr std::string_view table_of(LoadKind kind) { return load_tables[static_cast<int>(kind)]; }
constexpr bool has_named_loads(std::string_view table) { return table == "load" || table == "spring" || table == "stop" || table == "way_profile"; }

/// What a load acts on, a bit each.
inline constexpr unsigned on_spatial_slider = 1, on_planar_slider = 2, on_crank = 4, on_linkage = 8, on_sliders = on_spatial_slider | on_planar_slider;

/// A number that a load may have: load.<name>.force_x …
struct LoadNumber {
    LoadKind kind;
    std::string_view name, unit, meaning;
    int& (*place)(Load&);
    unsigned of = on_sliders | on_linkage;  // of loads on which
    Rule rule = Rule::any;
    double preset = 0;

    /// Of a scene.  @param dotted its name there, which is kept elsewhere  @param at its place among Inputs::load_a …
    Key key(std::string_view dotted, int at) const;
};
std::span<LoadNumber const> load_numbers();
LoadNumber const* find_load_number(LoadKind kind, std::string_view name);

/// Rows of the table of keys (settings.hpp) for all of that and for what else these tables may say: load.<name>.on …
std::span<Setting const> load_settings();

inline constexpr std::string_view load_bodies[] = {"slider", "crank"}, load_frames[] = {"ground", "slider", "body"};
/// Which faces of a way have a profile, and bits of them as in Load::faces.
inline constexpr std::string_view profiled_faces[] = {"all", "y", "z", "y_plus", "y_minus", "z_plus", "z_minus"};
inline constexpr int profiled_face_bits[] = {0b1111, 0b0011, 0b1100, 0b0001, 0b0010, 0b0100, 0b1000};
inline constexpr std::string_view spring_directions[] = {"line", "x"}, stop_sides[] = {"+x", "-x", "+angle", "-angle"};
inline constexpr std::string_view load_arguments[] = {"crank_angle", "time", "x", "vx", "crank_speed"};  // in the order of LoadArgument, behind `nothing`

/// What a load has of its table (find_table of load.<name>.table).
struct LoadTable {
    std::string column;
    std::size_t rows = 0;
    double narrowest = 0, span = 0;  // the least distance of two rows, and that of the first and the last
    Interpolation interpolation = Interpolation::spline;
    std::shared_ptr<PieceFunction const> function;
};

/// What a table is to be.
struct TableKind {
    std::string_view argument, argument_unit;        // the column that rises
    std::span<std::string_view const> value_units;   // what the other one may be in
    bool repeats;
    Interpolation interpolation;
    bool advances = false;  // where it repeats, it need not close
    bool opens = false;     // its values are not negative
};
/// Of a file beside a scene.  @param file names it  @param asking for the column  @throws SceneError
LoadTable read_table_of(Reading& reading, Node const& file, Node const& asking, std::string const& column, TableKind const& kind);

/// All loads of a scene.
class SceneLoads {
public:
    struct Row {
        std::string name;  // of its table in the scene: load.plunger, ground_motion; the ground has a row for each axis
        LoadTable table;
        std::string words = {};  // what the resolved scene says of a load on a linkage beside numbers and table
    };

    SceneLoads() = default;
    SceneLoads(SceneLoads const&) = delete;  // loads name their rows
    SceneLoads& operator=(SceneLoads const&) = delete;

    /// Of a row the load that kernels see, its places among Inputs::load_a … filled in.
    void add(Row row, Load const& load);
    /// Makes the key of a number that the scene gives a load.  @param name dotted  @return its place among Inputs::load_a …; there are
    /// most_load_numbers of them
    int add_key(std::string name, LoadNumber const& number);
    std::span<Row const> rows() const { return rows_; }
    std::deque<Key> const& keys() const { return keys_; }
    Key const* find_key(std::string_view name) const;
    Load const& load(std::size_t row) const { return loads_[row]; }
    /// For as long as this lives and nothing is added.
    LoadList list() const { return {loads_.data(), static_cast<int>(loads_.size())}; }

private:
    std::vector<Row> rows_;
    std::vector<Load> loads_;
    std::deque<std::string> names_;
    std::deque<Key> keys_;
};

/// The first load whose table is over time, or over more than one turn of the crank: where a member begins, it begins anew.  "" where there is none.
std::string_view jumping_load(SceneLoads const* loads);
/// Whether a table over this is not the same where a column of a continued sweep begins, at time 0 in the first turn.
bool jumps_at_columns(LoadArgument over, LoadTable const& table);

// [drive]: what moves a mechanism (docs/explanation/model.md 15).

inline constexpr std::string_view drive_names[] = {"speed", "profile", "torque", "free"};  // in the order of DriveBy
/// What scenes of earlier versions say in the place of drive.kind, and those of their results: "driven" or "free".
inline constexpr std::string_view former_crank = "mechanism.crank", former_cranks[] = {"driven", "free"};
inline constexpr std::string_view drive_arguments[] = {"crank_speed", "crank_angle", "time"};

/// What the column of a profile is.
enum class ProfileGives { angle, speed, position };
inline constexpr std::string_view profile_names[] = {"angle", "speed", "position"};

/// The table of a scene's drive: its `function` is what the kernels see, angle or place where the column is a speed.
struct SceneDrive {
    LoadTable table;
    ProfileGives gives = ProfileGives::angle;

    SceneDrive() = default;
    SceneDrive(SceneDrive const&) = delete;  // kernels point to what is in it
    SceneDrive& operator=(SceneDrive const&) = delete;

    /// The same for kernels, for as long as this lives.
    PieceTable const* plan_table() {
        plan_table_ = table.function->table();
        return &plan_table_;
    }

private:
    PieceTable plan_table_;
};

}  // namespace slideway
