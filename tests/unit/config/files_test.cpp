// The scenes of the paper and the demo.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "host/config/linkages.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/support/scene_fixture.hpp"

namespace slideway::files_test {
namespace {

using testing::contains;
constexpr double pi = std::numbers::pi;

struct Case {
    char const* file;
    double clearance;  // [m]
    double speed;      // [rad/s]
    char const* figure;
};

constexpr Case cases[] = {
    {"slider_crank_0.08mm.toml", 0.08e-3, pi, "Fig. 17a"},
    {"slider_crank_0.1mm.toml", 0.1e-3, pi, "Figs. 13a"},
    {"slider_crank_0.15mm.toml", 0.15e-3, pi, "Fig. 11"},
    {"slider_crank_0.22mm.toml", 0.22e-3, pi, "Fig. 15"},
    {"slider_crank_0.3mm.toml", 0.3e-3, pi, "Fig. 17c"},
    {"slider_crank_0.5mm.toml", 0.5e-3, pi, "Figs. 13b"},
    {"slider_crank_0.1mm_1.22pi.toml", 0.1e-3, 1.22 * pi, "Figs. 13c"},
    {"slider_crank_0.1mm_2pi.toml", 0.1e-3, 2 * pi, "Figs. 13d"},
};

std::string path_of(std::string const& file) { return std::string(SLIDEWAY_SCENES "/") + file; }

TEST(SceneFiles, AreThePapersCases) {
    for (Case const& c : cases) {
        SCOPED_TRACE(c.file);
        Scene const scene = read_scene(path_of(c.file));
        EXPECT_DOUBLE_EQ(scene.inputs.clearance_y, c.clearance);
        EXPECT_DOUBLE_EQ(scene.inputs.clearance_z, c.clearance);
        EXPECT_DOUBLE_EQ(scene.inputs.z, c.clearance / 10);
        EXPECT_DOUBLE_EQ(scene.inputs.crank_speed, c.speed);
        EXPECT_DOUBLE_EQ(scene.integrator.end_time, 4 * pi / c.speed);
        EXPECT_EQ(scene.sample_times.size(), 401u);
        EXPECT_EQ(scene.members, 1u);
        EXPECT_EQ(scene.parts, (Parts{Law::paper, Damping::point, true, false}));
        EXPECT_TRUE(contains(scene.title, c.figure)) << scene.title;
        EXPECT_EQ(read_scene(path_of(c.file), {{"contact.law", "conservative"}}).parts.law, Law::conservative);
        // what the files leave out is the default of model.md 2
        EXPECT_EQ(scene.inputs.crank_length, 0.05);
        EXPECT_EQ(scene.inputs.rod_length, 0.1422);
        EXPECT_EQ(scene.inputs.slider_young_modulus, 2.07e11);
    }
}

struct Matrix {
    double at[3][3];
};

/// Rz(ψ) Ry(ϑ) Rx(φ), ψ the pitch, ϑ the yaw, φ the roll (model.md 1).
Matrix attitude(double roll, double yaw, double pitch) {
    double const cr = std::cos(roll), sr = std::sin(roll), cy = std::cos(yaw), sy = std::sin(yaw), cp = std::cos(pitch),
                 sp = std::sin(pitch);
    return {{{cp * cy, cp * sy * sr - sp * cr, cp * sy * cr + sp * sr},
             {sp * cy, sp * sy * sr + cp * cr, sp * sy * cr - cp * sr},
             {-sy, cy * sr, cy * cr}}};
}

/// Largest penetration of the sixteen apex–face pairs (model.md 3), by rotation matrices without any shortcut, in the
/// frame of the way.
double deepest(Inputs const& in) {
    EXPECT_EQ(in.start_angle, 0);
    Matrix const slider = attitude(in.roll, in.yaw, in.pitch), way = attitude(in.way_roll, in.way_yaw, in.way_pitch);
    // The crank's pin is at (r, 0, 0) and the rod L long.
    double const from_axis[3] = {in.crank_length + std::sqrt(in.rod_length * in.rod_length - in.y * in.y - in.z * in.z),
                                 in.y - in.way_offset_y, in.z - in.way_offset_z};
    double p[3] = {}, n[3][3] = {};  // A_lᵀ (u - u_l) and A_lᵀ A_k
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            p[i] += way.at[k][i] * from_axis[k];
            for (int j = 0; j < 3; ++j) n[i][j] += way.at[k][i] * slider.at[k][j];
        }
    }
    double largest = -1;
    for (int s1 : {-1, 1}) {
        for (int s2 : {-1, 1}) {
            for (int s3 : {-1, 1}) {
                double const rho[3] = {s3 * in.slider_length / 2, s1 * in.way_width / 2 - p[1],
                                       s2 * in.way_depth / 2 - p[2]};
                double const along_y = n[0][1] * rho[0] + n[1][1] * rho[1] + n[2][1] * rho[2];
                double const along_z = n[0][2] * rho[0] + n[1][2] * rho[1] + n[2][2] * rho[2];
                largest = std::max({largest, s1 * along_y - in.way_width / 2 - in.clearance_y,
                                    s2 * along_z - in.way_depth / 2 - in.clearance_z});
            }
        }
    }
    return largest;
}

TEST(SceneFiles, EveryStartFliesFree) {
    for (Case const& c : cases) {
        SCOPED_TRACE(c.file);
        EXPECT_LT(deepest(complete_inputs(read_scene(path_of(c.file)).inputs)), 0);
    }
    Scene const scene = read_scene(path_of("ensemble_starts.toml"));
    double largest = -1;
    for (std::uint64_t member = 0; member < scene.members; ++member) {
        Inputs const in = member_inputs(scene, member);
        ASSERT_EQ(defect(in), std::nullopt);
        largest = std::max(largest, deepest(in));
    }
    EXPECT_LT(largest, 0);
    EXPECT_GT(largest, -0.06e-3);  // and the starts use the room that they have
}

TEST(SceneFiles, TheEnsembleIsTheDemo) {
    Scene const scene = read_scene(path_of("ensemble_starts.toml"));
    EXPECT_EQ(scene.members, 1024u);
    EXPECT_EQ(scene.seed, 1u);
    EXPECT_EQ(scene.integrator.end_time, 0.1);
    EXPECT_TRUE(scene.sample_times.empty());
    EXPECT_EQ(scene.parts, (Parts{Law::paper, Damping::point, true, false}));
    EXPECT_TRUE(selects(scene.quantities, Quantity::energy_residual));
    EXPECT_EQ(scene.variations.size(), 5u);
}

/// Every member of the scene begins in free flight.
void expect_free_starts(Scene const& scene) {
    for (std::uint64_t member = 0; member < scene.members; ++member) {
        Inputs in = member_inputs(scene, member);
        if (scene.chaos.parameter != nullptr) scene.chaos.parameter->set(in, scene.chaos.values.front());
        ASSERT_EQ(defect(in), std::nullopt);
        EXPECT_LT(deepest(in), 0) << member;
    }
}

TEST(SceneFiles, ThePoincareSectionIsThePapers) {
    Scene const scene = read_scene(path_of("poincare_0.1mm.toml"));
    EXPECT_EQ(scene.study, StudyKind::poincare);
    EXPECT_EQ(scene.chaos.section, SectionSurface{});
    EXPECT_EQ(scene.chaos.span, (Span{150, true}));
    EXPECT_EQ(scene.chaos.transient, (Span{20, true}));
    EXPECT_EQ(scene.parts, (Parts{Law::paper, Damping::point, true, false}));
    EXPECT_TRUE(scene.warnings.empty());
    expect_free_starts(scene);
    Scene const conservative = read_scene(path_of("poincare_0.1mm.toml"), {{"contact.law", "conservative"}});
    EXPECT_EQ(conservative.parts.law, Law::conservative);
}

TEST(SceneFiles, TheExponentsAreOfAThousandStarts) {
    Scene const scene = read_scene(path_of("lyapunov_0.1mm.toml"));
    EXPECT_EQ(scene.study, StudyKind::lyapunov);
    EXPECT_EQ(scene.members, 1000u);
    EXPECT_EQ(scene.chaos.exponents, 1);
    EXPECT_EQ(scene.parts, (Parts{Law::paper, Damping::point, true, false}));
    EXPECT_TRUE(scene.integrator.locate_modes);
    EXPECT_TRUE(scene.warnings.empty());
    expect_free_starts(scene);
}

TEST(SceneFiles, TheSweepIsOfTheClearance) {
    Scene const scene = read_scene(path_of("sweep_clearance.toml"));
    EXPECT_EQ(scene.study, StudyKind::sweep);
    EXPECT_EQ(scene.chaos.parameter, find_key("joint.clearance"));
    ASSERT_EQ(scene.chaos.values.size(), 46u);
    EXPECT_EQ(scene.chaos.values.front(), 0.05e-3);
    EXPECT_EQ(scene.chaos.values.back(), 0.5e-3);
    EXPECT_EQ(scene.chaos.values[5], 1e-4) << "the bits of a scene of that clearance";
    EXPECT_EQ(scene.parts, (Parts{Law::paper, Damping::point, true, false}));
    EXPECT_TRUE(scene.warnings.empty());
    expect_free_starts(scene);
}

TEST(SceneFiles, TheTolerancesAreASensitivityStudyWithinItsLimit) {
    Scene const scene = read_scene(path_of("tolerance_0.1mm.toml"));
    EXPECT_EQ(scene.study, StudyKind::tolerance);
    EXPECT_EQ(scene.design.kind, DesignKind::saltelli);
    EXPECT_EQ(scene.variations.size(), 8u);
    EXPECT_EQ(scene.members, 256u * 10);
    EXPECT_EQ(scene.integrator.end_time, 0.1);
    EXPECT_EQ(scene.parts, (Parts{Law::conservative, Damping::rate, true, true}));
    ASSERT_EQ(scene.limits.size(), 1u);
    EXPECT_EQ(scene.limits[0].name(), "peak_normal_force");
    EXPECT_EQ(scene.limits[0].high, 1000);
    EXPECT_TRUE(scene.warnings.empty());
    expect_free_starts(scene);
}

TEST(SceneFiles, TheTolerancesStartFreeAtEveryCornerOfTheirLimits) {
    Scene const scene = read_scene(path_of("tolerance_0.1mm.toml"));
    std::size_t const count = scene.variations.size();
    for (unsigned corner = 0; corner < 1u << count; ++corner) {
        Inputs in = scene.inputs;
        for (std::size_t i = 0; i < count; ++i) {
            Distribution const& d = scene.variations[i].distribution;
            bool const bounded = d.kind == Distribution::Kind::truncated_normal;
            double const low = bounded ? d.low : d.mean - 8 * d.sd, high = bounded ? d.high : d.mean + 8 * d.sd;
            scene.variations[i].key->set(in, (corner >> i & 1u) != 0 ? high : low);
        }
        ASSERT_EQ(defect(in), std::nullopt);
        EXPECT_LT(in.friction_kinetic, in.friction_static);
        EXPECT_LT(deepest(complete_inputs(in)), 0) << corner;
    }
}

TEST(SceneFiles, TheTableIsOfSevenMechanisms) {
    Scene const scene = read_scene(path_of("tolerance_table.toml"));
    EXPECT_EQ(scene.study, StudyKind::tolerance);
    EXPECT_EQ(scene.design.kind, DesignKind::table);
    EXPECT_EQ(scene.members, 7u);
    EXPECT_TRUE(scene.warnings.empty());
    MemberTable const& table = *scene.design.table;
    EXPECT_EQ(table.values[0], 0.101e-3);
    for (std::size_t row = 0; row < table.rows(); ++row) {
        Inputs in = scene.inputs;
        for (Variation const& variation : scene.variations) {
            variation.key->set(in, table.values[row * table.columns + variation.column]);
        }
        ASSERT_EQ(defect(in), std::nullopt);
        EXPECT_LT(deepest(complete_inputs(in)), 0) << row;
    }
}

TEST(SceneFiles, TheCarriagesAreTheCasesOfTable1) {
    // Half the difference of the widths, the speed and the inclination (model.md 7).
    double const clearance[] = {0.125e-3, 0.075e-3, 0.125e-3, 0.125e-3}, speed[] = {0.06, 0.06, 0.093, 0.06},
                 inclination[] = {0, 0, 0, pi / 6};
    for (int i = 0; i < 4; ++i) {
        Scene const scene = read_scene(path_of("carriage_" + std::to_string(i + 1) + ".toml"));
        EXPECT_EQ(scene.parts, (Parts{Law::paper, Damping::point, true, false, Mechanism::carriage}));
        EXPECT_DOUBLE_EQ(scene.inputs.clearance_y, clearance[i]);
        EXPECT_DOUBLE_EQ(scene.inputs.clearance_z, clearance[i]);
        EXPECT_DOUBLE_EQ(scene.inputs.carriage_speed, speed[i]);
        EXPECT_DOUBLE_EQ(scene.inputs.inclination, inclination[i]);
        EXPECT_DOUBLE_EQ(scene.integrator.end_time, 2 * (0.15 / speed[i] + 0.02));
        EXPECT_TRUE(selects(scene.series, Series::acceleration_top));
        EXPECT_TRUE(selects(scene.quantities, Quantity::acceleration_area));
        EXPECT_TRUE(scene.warnings.empty());
        // Where the slider stands along the way is nothing to its apices.
        EXPECT_LT(deepest(complete_inputs(scene.inputs)), 0);
    }
}

TEST(SceneFiles, TheFreeSliderFallsFree) {
    Scene const scene = read_scene(path_of("free_slider_drop.toml"));
    EXPECT_EQ(scene.parts, (Parts{Law::conservative, Damping::point, true, false, Mechanism::free_slider}));
    EXPECT_EQ(scene.inputs.vx, 0.05);
    EXPECT_LT(deepest(complete_inputs(scene.inputs)), 0);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(SceneFiles, TheScotchYokeIsTheStandardSceneWithoutARod) {
    Scene const scene = read_scene(path_of("scotch_yoke.toml")), crank = read_scene(path_of("slider_crank_0.1mm.toml"));
    EXPECT_EQ(scene.parts, (Parts{Law::kelvin_voigt, Damping::point, true, false, Mechanism::scotch_yoke}));
    for (char const* const key : {"mechanism.crank_length", "mechanism.crank_speed", "joint.clearance_y", "joint.clearance_z",
                                  "friction.static", "initial.z", "initial.roll", "initial.yaw", "initial.pitch"}) {
        EXPECT_EQ(find_key(key)->get(scene.inputs), find_key(key)->get(crank.inputs)) << key;
    }
    EXPECT_TRUE(std::isnan(find_key("contact.apex_stiffness")->get(scene.inputs)));
    EXPECT_EQ(find_key("contact.apex_damping")->get(scene.inputs), 2000);
    EXPECT_EQ(scene.integrator.end_time, crank.integrator.end_time);
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_LT(deepest(complete_inputs(scene.inputs)), 0);
}

TEST(SceneFiles, EveryMechanismHasOne) {
    std::set<Mechanism> found;
    for (auto const& entry : std::filesystem::directory_iterator(SLIDEWAY_SCENES)) {
        if (entry.path().extension() != ".toml") continue;
        Mechanism const mechanism = read_scene(entry.path().string()).parts.mechanism;
        found.insert(is_linkage(mechanism) ? any_linkage : mechanism);
    }
    EXPECT_EQ(found.size(), mechanism_kinds().size());
}

TEST(SceneFiles, RunUnderEveryLaw) {
    for (auto const& entry : std::filesystem::directory_iterator(SLIDEWAY_SCENES)) {
        if (entry.path().extension() != ".toml") continue;
        std::string const path = entry.path().string();
        if (!info(read_scene(path).parts.mechanism).spatial) continue;
        for (LawInfo const& law : laws()) {
            Scene const scene = read_scene(path, {{"contact.law", std::string(law.name)}});
            EXPECT_EQ(info(scene.parts.law).name, law.name) << path;
            EXPECT_TRUE(law.has(scene.parts.damping)) << path << " " << law.name;
            for (std::uint64_t i = 0; i < std::min<std::uint64_t>(scene.members, 3); ++i)
                EXPECT_EQ(defect(member_inputs(scene, i), scene.parts), std::nullopt) << path << " " << law.name;
        }
    }
}

TEST(SceneFiles, ThePlanarMechanismIsTheBenchmarks) {
    Scene const scene = read_scene(path_of("planar_flores.toml"));
    Inputs const& in = scene.inputs;
    Parts parts;
    parts.mechanism = Mechanism::planar_slider_crank, parts.damping = Damping::restitution, parts.drive.by = slideway::DriveBy::nothing;
    EXPECT_EQ(scene.parts, parts);
    double const given[] = {in.crank_length,    in.rod_length,  in.slider_length, in.slider_height,
                            in.clearance_y,     in.crank_mass,  in.rod_mass,      in.slider_mass,
                            in.crank_inertia,   in.rod_inertia, in.crank_speed,   in.slider_inertia_z,
                            in.point_stiffness, in.restitution, in.hertz_exponent};
    // model.md 7: a and b are half the sizes of the block; the rod's −75 rad/s keep the slider on its line, r ω = L 75.
    double const model[] = {0.153,  0.306,  2 * 0.05, 2 * 0.025, 1e-3, 0.038, 0.038, 0.076,
                            7.4e-5, 5.9e-4, 150,      2.7e-6,    1e11, 0.4,   1.5};
    for (std::size_t i = 0; i < std::size(model); ++i) EXPECT_DOUBLE_EQ(given[i], model[i]) << i;
    EXPECT_EQ(in.vy, 0);
    EXPECT_EQ(in.crank_length * in.crank_speed, in.rod_length * 75);
    EXPECT_EQ(scene.integrator.end_time, 0.2);
    ASSERT_EQ(scene.sample_times.size(), 201u);
    EXPECT_DOUBLE_EQ(scene.sample_times[5], 5e-3);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(SceneFiles, ResolveToThemselves) {
    int files = 0;
    for (auto const& entry : std::filesystem::directory_iterator(SLIDEWAY_SCENES)) {
        if (entry.path().extension() != ".toml") continue;
        std::string const resolved = resolved_toml(read_scene(entry.path().string()));
        EXPECT_EQ(resolved_toml(testing::scene_of(resolved)), resolved) << entry.path();
        ++files;
    }
    EXPECT_GE(files, 20);
}

}  // namespace
}  // namespace slideway::files_test
