// [load.<name>], [spring.<name>], [stop.<name>] and [ground_motion]: what acts on a mechanism beside its weight, its contacts and its drive
// (docs/model.md 14).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/config/piece_function.hpp"
#include "kernels/key.hpp"
#include "kernels/loads/load_list.hpp"

namespace slideway {

struct Setting;

/// Tables of loads in a scene, in the order of LoadKind.  Of all but the last a scene has as many as it names.
inline constexpr std::string_view load_tables[] = {"load", "spring", "stop", "ground_motion"};
constexpr std::string_view table_of(LoadKind kind) { return load_tables[static_cast<int>(kind)]; }
constexpr bool has_named_loads(std::string_view table) { return table == "load" || table == "spring" || table == "stop"; }

/// A number that a load may have: load.<name>.force_x …
struct LoadNumber {
    LoadKind kind;
    std::string_view name, unit, meaning;
    int& (*place)(Load&);
    Rule rule = Rule::any;
    double preset = 0;
    bool planar = true;                       // it means something in a plane
    bool of_crank = false, of_slider = true;  // of a push on which of them
};
std::span<LoadNumber const> load_numbers();
LoadNumber const* find_load_number(LoadKind kind, std::string_view name);

/// Rows of the table of keys (settings.hpp) for all of that and for what else these tables may say: load.<name>.on …
std::span<Setting const> load_settings();

inline constexpr std::string_view load_bodies[] = {"slider", "crank"}, load_frames[] = {"ground", "slider"};
inline constexpr std::string_view spring_directions[] = {"line", "x"}, stop_sides[] = {"+x", "-x"};
inline constexpr std::string_view load_arguments[] = {"crank_angle", "time", "x", "vx"};  // in the order of LoadArgument, behind `nothing`

/// The table of a load, as it was read.
struct LoadTable {
    std::string path, column;
    std::uint64_t checksum = 0;  // FNV-1a of the file
    std::size_t rows = 0;
    double narrowest = 0, span = 0;  // the least distance of two rows, and that of the first and the last
    Interpolation interpolation = Interpolation::spline;
    std::shared_ptr<PieceFunction const> function;
};

/// All loads of a scene.
class SceneLoads {
public:
    struct Row {
        std::string name;  // of its table in the scene: load.plunger, ground_motion; the ground has a row for each axis
        LoadTable table;
    };

    SceneLoads() = default;
    SceneLoads(SceneLoads const&) = delete;  // loads name their rows
    SceneLoads& operator=(SceneLoads const&) = delete;

    /// Of a row the load that kernels see, its places among Inputs::load_a … filled in.
    void add(Row row, Load const& load);
    std::span<Row const> rows() const { return rows_; }
    Load const& load(std::size_t row) const { return loads_[row]; }
    /// For as long as this lives and nothing is added.
    LoadList list() const { return {loads_.data(), static_cast<int>(loads_.size())}; }

private:
    std::vector<Row> rows_;
    std::vector<Load> loads_;
};

// Keys of loads are known from the first scene on that has them: numeric_keys() has them, and a scene those of its own loads (counts_for).

/// Makes the keys of a scene's loads known.  @param names dotted, those of one scene  @return for each its place among Inputs::load_a …
/// @throws std::length_error where there are too many of them
std::vector<int> know_load_keys(std::span<std::string const> names, std::span<LoadNumber const* const> numbers);
/// All that are known.
std::vector<Key const*> known_load_keys();
std::size_t known_load_key_count();
/// Whether a key is of one of these loads.
bool is_of(Key const& key, LoadList const& loads);

}  // namespace slideway
