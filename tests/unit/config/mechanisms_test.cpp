// Which keys, quantities and methods count for which mechanism, and that what does not is refused.
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/scene_fixture.hpp"
#include "tests/support/scene_tables.hpp"

namespace slideway::mechanisms_test {
namespace {

using testing::contains;
using testing::error_of;
using testing::scene_of;

std::string with_kind(std::string const& kind, std::string const& lines = "") {
    return fmt::format("schema = 1\n[mechanism]\nkind = \"{}\"\n{}\n", kind, lines);
}

constexpr char const* kinds[] = {"slider_crank", "carriage", "scotch_yoke", "free_slider", "planar_slider_crank"};

TEST(SceneMechanisms, HaveTheirNames) {
    ASSERT_EQ(std::size(kinds) + 1, mechanism_kinds().size()) << "linkages have tests of their own";
    for (std::size_t i = 0; i < std::size(kinds); ++i) {
        EXPECT_EQ(static_cast<std::size_t>(scene_of(with_kind(kinds[i], "[study]\nduration = 1")).parts.mechanism), i);
    }
    EXPECT_FALSE(scene_of(with_kind("planar_slider_crank")).parts.drive.turns_freely());
    EXPECT_FALSE(scene_of(with_kind("planar_slider_crank", "[drive]\nkind = \"speed\"")).parts.drive.turns_freely());
    EXPECT_TRUE(scene_of(with_kind("planar_slider_crank", "[drive]\nkind = \"free\"")).parts.drive.turns_freely());
    EXPECT_EQ(error_of(with_kind("planar_slider_crank", "[drive]\nkind = \"loose\"")),
              "scene.toml:5: drive.kind is \"loose\" (there is no such drive); use one of speed, profile, torque, free");
}

TEST(SceneMechanisms, ReadTheirOwnKeys) {
    Scene const carriage = scene_of(
        with_kind("carriage", "carriage_speed = \"9.3 cm/s\"\nstroke = \"100 mm\"\nreversal_time = \"30 ms\""));
    EXPECT_DOUBLE_EQ(carriage.inputs.carriage_speed, 0.093);
    EXPECT_DOUBLE_EQ(carriage.inputs.stroke, 0.1);
    EXPECT_DOUBLE_EQ(carriage.inputs.reversal_time, 0.03);
    Scene const yoke = scene_of(with_kind("scotch_yoke", "crank_length = \"30 mm\"\nstart_angle = \"90 deg\""));
    EXPECT_DOUBLE_EQ(yoke.inputs.crank_length, 0.03);
    EXPECT_DOUBLE_EQ(yoke.inputs.start_angle, std::asin(1.0));
    Scene const free = scene_of(with_kind("free_slider", "[initial]\nx = \"1 cm\"\nvx = \"2 m/s\""));
    EXPECT_EQ(free.inputs.x, 0.01);
    EXPECT_EQ(free.inputs.vx, 2);
    Scene const planar = scene_of(
        with_kind("planar_slider_crank",
                  "crank_inertia = 7e-5\n[joint]\nslider_height = \"50 mm\"\n[contact]\npoint_stiffness = 1e11"));
    EXPECT_EQ(planar.inputs.crank_inertia, 7e-5);
    EXPECT_EQ(planar.inputs.slider_height, 0.05);
    EXPECT_EQ(planar.inputs.point_stiffness, 1e11);
}

struct Foreign {
    char const* table;
    char const* key;
    char const* kinds;  // for which it counts, by their letters
};

/// Its initial; y of a scotch_yoke.
char letter_of(std::string_view kind) { return kind == "scotch_yoke" ? 'y' : kind[0]; }

constexpr Foreign keys_of_some[] = {
    {"mechanism", "crank_length", "syp"},
    {"mechanism", "rod_length", "sp"},
    {"mechanism", "crank_speed", "syp"},
    {"mechanism", "start_angle", "syp"},
    {"mechanism", "crank_mass", "sp"},
    {"mechanism", "rod_mass", "sp"},
    {"mechanism", "rod_inertia", "sp"},
    {"mechanism", "rod_mass_center", "s"},
    {"mechanism", "crank_inertia", "p"},
    {"mechanism", "carriage_speed", "c"},
    {"mechanism", "stroke", "c"},
    {"mechanism", "reversal_time", "c"},
    {"mechanism", "slider_inertia_x", "scyf"},
    {"mechanism", "slider_inertia_z", "scyfp"},
    {"mechanism", "gravity", "scyfp"},
    {"mechanism", "crank_section", "sp"},
    {"mechanism", "rod_section", "sp"},
    {"joint", "slider_height", "p"},
    {"joint", "slider_depth", "p"},
    {"joint", "wall", "scyf"},
    {"material", "density", "scyfp"},
    {"joint", "way_width", "scyf"},
    {"joint", "thickness_z", "scyf"},
    {"joint", "clearance_z", "scyf"},
    {"joint", "clearance_y", "scyfp"},
    {"joint", "clearance", "scyfp"},
    {"joint", "slider_length", "scyfp"},
    {"way", "offset_y", "scyf"},
    {"contact", "edge_radius", "scyf"},
    {"contact", "chi_line", "scyf"},
    {"contact", "apex_radius", "scyfp"},
    {"contact", "young_modulus", "scyfp"},
    {"contact", "point_stiffness", "scyfp"},
    {"friction", "static", "scyfp"},
    {"initial", "x", "f"},
    {"initial", "vx", "f"},
    {"initial", "z", "scyf"},
    {"initial", "roll", "scyf"},
    {"initial", "wz", "scyfp"},
    {"initial", "pitch", "scyfp"},
};

/// A value that every key of the list may have.
constexpr char const* some_value = "0.06";

/// Calls `given(kind, dotted name, the line that refuses it or "")` for every kind and key of the list.
template <class Given> void for_every_kind_and_key(Given given) {
    for (char const* const kind : kinds) {
        for (Foreign const& key : keys_of_some) {
            std::string const name = fmt::format("{}.{}", key.table, key.key);
            bool const counts = std::string_view(key.kinds).find(letter_of(kind)) != std::string_view::npos;
            given(std::string(kind), key,
                  counts ? std::string() : fmt::format("{} has no meaning for kind = \"{}\"; remove it", name, kind));
        }
    }
}

TEST(SceneMechanisms, RefuseForeignKeysOfAScene) {
    for_every_kind_and_key([](std::string const& kind, Foreign const& key, std::string const& refusal) {
        bool const same_table = std::string(key.table) == "mechanism";
        std::string const text =
            with_kind(kind, fmt::format("{}{} = {}\n", same_table ? "" : fmt::format("[{}]\n", key.table), key.key,
                                        some_value)) +
            (kind == "free_slider" ? "[study]\nduration = 1\n" : "");
        EXPECT_EQ(error_of(text), refusal.empty() ? "" : fmt::format("scene.toml:{}: {}", same_table ? 4 : 5, refusal));
    });
}

TEST(SceneMechanisms, RefuseForeignKeysOfOptions) {
    for_every_kind_and_key([](std::string const& kind, Foreign const& key, std::string const& refusal) {
        std::string const option = fmt::format("{}.{}", key.table, key.key);
        EXPECT_EQ(error_of(with_kind(kind), {{option, some_value}}),
                  refusal.empty() ? "" : fmt::format("--set {}={}: {}", option, some_value, refusal));
    });
    // The kind may come from an option too.
    EXPECT_TRUE(contains(error_of("schema = 1\n[mechanism]\nrod_length = 0.2\n", {{"mechanism.kind", "carriage"}}),
                         "mechanism.rod_length has no meaning for kind = \"carriage\"; remove it"));
}

TEST(SceneMechanisms, RefuseForeignKeysThatVary) {
    for_every_kind_and_key([](std::string const& kind, Foreign const& key, std::string const& refusal) {
        std::string const friction = std::string(key.table) == "friction" ? "[friction]\n" : "";
        std::string const text = with_kind(
            kind,
            fmt::format(
                "{}[study]\nduration = 1\n[study.vary]\n\"{}.{}\" = {{ dist = \"unif\", low = 0.01, high = 0.011 }}\n",
                friction, key.table, key.key));
        int const line = friction.empty() ? 7 : 8;
        EXPECT_EQ(error_of(text), refusal.empty() ? "" : fmt::format("scene.toml:{}: {}", line, refusal));
    });
}

TEST(SceneMechanisms, RefuseForeignKeysOfSweeps) {
    auto const sweep = [](std::string const& kind, std::string const& key) {
        return error_of(with_kind(kind, fmt::format("[study]\nkind = \"sweep\"\nexponents = 0\nparameter = \"{}\"\n"
                                                    "values = [0.01, 0.02]\n",
                                                    key)));
    };
    EXPECT_EQ(sweep("carriage", "mechanism.stroke"), "");
    EXPECT_EQ(sweep("carriage", "mechanism.rod_length"),
              "scene.toml:7: mechanism.rod_length has no meaning for kind = \"carriage\"; remove it");
    EXPECT_EQ(sweep("planar_slider_crank", "joint.slider_height"), "");
    EXPECT_EQ(sweep("planar_slider_crank", "joint.clearance_z"),
              "scene.toml:7: joint.clearance_z has no meaning for kind = \"planar_slider_crank\"; remove it");
}

TEST(SceneMechanisms, RefuseForeignKeysOfTables) {
    testing::TableFolder const folder;
    folder.write("a.csv", "joint.clearance, joint.way_width [mm]\n1e-4, 20\n");
    auto const error = [&](std::string const& kind) {
        return folder.error(fmt::format(
            "[mechanism]\nkind = \"{}\"\n[study]\nduration = 1\ndesign = \"table\"\ntable = \"a.csv\"", kind));
    };
    EXPECT_EQ(error("carriage"), "");
    EXPECT_EQ(error("planar_slider_crank"),
              "a.csv:1: joint.way_width has no meaning for kind = \"planar_slider_crank\"; remove it");
}

TEST(SceneMechanisms, ThePlanarOneHasNoLawAndNoWay) {
    auto const planar = [](std::string const& lines) { return error_of(with_kind("planar_slider_crank", lines)); };
    EXPECT_EQ(planar("[contact]\nlaw = \"paper\""),
              "scene.toml:5: contact.law is \"paper\" (the corners of a planar_slider_crank have one law); remove it, or use \"rigid\"");
    EXPECT_EQ(planar("[way]"), "scene.toml:4: way has no meaning for kind = \"planar_slider_crank\"; remove it");
}

TEST(SceneMechanisms, ThePlanarOneHasNoStiffMethod) {
    auto const planar = [](std::string const& lines) { return error_of(with_kind("planar_slider_crank", lines)); };
    EXPECT_EQ(planar("[integrator]\nmethod = \"ros34pw2\""),
              "scene.toml:5: integrator.method is \"ros34pw2\" (the method has no Jacobian of a planar_slider_crank); "
              "use method \"auto\", \"dopri5\", \"dop853\", \"bs32\", \"rk4\" or \"verner65\"");
    for (char const* const method : {"auto", "dopri5", "dop853", "bs32", "verner65"}) {
        EXPECT_EQ(planar(fmt::format("[integrator]\nmethod = \"{}\"", method)), "");
    }
    EXPECT_EQ(planar("[integrator]\nmethod = \"rk4\"\nstep = 1e-5"), "");
    EXPECT_NE(planar("[integrator]\nmethod = \"rk4\"\nstep = 1e-5\n[contact]\nrestitution = 0.4"), "");
    EXPECT_EQ(planar("[integrator]\nlocate_modes = true"),
              "scene.toml:5: integrator.locate_modes is true (nothing switches in a planar_slider_crank); remove it");
    EXPECT_EQ(planar("[integrator]\nlocate_modes = false"), "");
    auto const warnings = scene_of(with_kind("planar_slider_crank", "[integrator]\nstiff_max_step = 1e-3")).warnings;
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0], "integrator.stiff_max_step has no effect on a planar_slider_crank");
    for (char const* const kind : {"carriage", "scotch_yoke", "free_slider"}) {
        EXPECT_EQ(error_of(with_kind(kind, "[integrator]\nmethod = \"ros34pw2\"")), "");
    }
    // Nothing switches under the law that is not there: neighbours need no located modes.
    Scene const chaotic = scene_of(with_kind("planar_slider_crank", "[study]\nkind = \"lyapunov\""));
    EXPECT_FALSE(chaotic.integrator.locate_modes);
    EXPECT_TRUE(chaotic.warnings.empty());
    EXPECT_TRUE(scene_of(with_kind("carriage", "[study]\nkind = \"lyapunov\"")).integrator.locate_modes);
}

TEST(SceneMechanisms, HaveTheirQuantitiesAndSeries) {
    auto const asked = [](std::string const& kind, std::string const& name) {
        return error_of(
            with_kind(kind, fmt::format("[study]\nduration = 1\nsamples = 11\nquantities = [\"{}\"]", name)));
    };
    EXPECT_EQ(asked("carriage", "crank_torque"),
              "scene.toml:7: crank_torque is no quantity of a carriage; see `slideway list`");
    EXPECT_EQ(asked("scotch_yoke", "rod_angular_velocity"),
              "scene.toml:7: rod_angular_velocity is no quantity of a scotch_yoke; see `slideway list`");
    EXPECT_EQ(asked("free_slider", "drive_work"),
              "scene.toml:7: drive_work is no quantity of a free_slider; see `slideway list`");
    EXPECT_EQ(asked("planar_slider_crank", "mean_apex_force"),
              "scene.toml:7: mean_apex_force is no quantity of a planar_slider_crank; see `slideway list`");
    EXPECT_NE(asked("planar_slider_crank", "roll"), "");
    EXPECT_NE(asked("slider_crank", "crank_angle"), "");
    for (char const* const name : {"drive_work", "x", "acceleration_top", "peak_channel_acceleration"}) {
        EXPECT_EQ(asked("carriage", name), "") << name;
        EXPECT_EQ(asked("scotch_yoke", name), "") << name;
    }
    for (char const* const name : {"crank_torque", "rod_angle", "y", "peak_normal_force"}) {
        EXPECT_EQ(asked("planar_slider_crank", name), "") << name;
    }
}

TEST(SceneMechanisms, LimitOnlyWhatTheyHave) {
    auto const limited = [](std::string const& kind, std::string const& name) {
        return error_of(with_kind(
            kind, fmt::format("[study]\nkind = \"tolerance\"\n[study.limits]\n\"{}\" = {{ max = 1 }}", name)));
    };
    EXPECT_EQ(limited("carriage", "peak_crank_torque"),
              "scene.toml:7: peak_crank_torque is no quantity of a carriage; see `slideway list`");
    EXPECT_EQ(limited("carriage", "peak_channel_acceleration[top]"), "");
    EXPECT_EQ(limited("carriage", "peak_acceleration[z]"), "");
    EXPECT_TRUE(contains(limited("carriage", "peak_channel_acceleration[left]"), "one of top, front"));
}

Selection series_of(std::string const& kind, std::string const& asked = "") {
    return scene_of(with_kind(kind, fmt::format("[study]\nduration = 1\nsamples = 11\nquantities = [{}]", asked)))
        .series;
}

TEST(SceneMechanisms, StoreTheirStatesInEveryTimeSeries) {
    auto const set = [](std::initializer_list<Series> list) {
        Selection of = 0;
        for (Series const s : list) of |= selection_of(s);
        return of;
    };
    Selection const ten = 0x3ff;
    EXPECT_EQ(series_of("slider_crank"), ten);
    EXPECT_EQ(series_of("carriage"), ten);
    EXPECT_EQ(series_of("scotch_yoke"), ten);
    EXPECT_EQ(series_of("carriage", "\"x\""), ten | selection_of(Series::x));
    EXPECT_EQ(series_of("free_slider"), ten | set({Series::x, Series::vx}));
    EXPECT_EQ(series_of("planar_slider_crank"),
              set({Series::crank_angle, Series::rod_angle, Series::pitch, Series::crank_angular_velocity,
                   Series::rod_angular_velocity, Series::wz, Series::y, Series::vy}));
}

TEST(SceneMechanisms, ResolveToThemselves) {
    char const* const studies[] = {
        "[study]\nduration = 1\nsamples = 11\nquantities = [\"x\", \"peak_normal_force\"]\n",
        "[study]\nkind = \"poincare\"\nTtr = 1\nduration = 1\nsection = { on = \"pitch\", value = \"1 deg\" }\n",
    };
    for (char const* const kind : kinds) {
        for (char const* const study : studies) {
            Scene const scene = scene_of(with_kind(kind, study));
            std::string const resolved = resolved_toml(scene);
            EXPECT_TRUE(contains(resolved, fmt::format("kind = \"{}\"\n", kind)));
            Scene const again = scene_of(resolved);
            EXPECT_EQ(resolved_toml(again), resolved);
            EXPECT_EQ(again.parts, scene.parts);
            EXPECT_EQ(again.series, scene.series);
            EXPECT_EQ(again.chaos.section, scene.chaos.section);
            EXPECT_EQ(again.integrator.max_step, scene.integrator.max_step);
        }
    }
    EXPECT_TRUE(
        contains(resolved_toml(scene_of(with_kind("planar_slider_crank", "[drive]\nkind = \"free\""))), "[drive]\nkind = \"free\"\n"));
    EXPECT_FALSE(contains(resolved_toml(scene_of(with_kind("planar_slider_crank"))), "law = "));
    EXPECT_FALSE(contains(resolved_toml(scene_of(with_kind("carriage"))), "rod_length"));
    EXPECT_FALSE(contains(resolved_toml(scene_of(with_kind("scotch_yoke"))), "rod_length"));
}

}  // namespace
}  // namespace slideway::mechanisms_test
