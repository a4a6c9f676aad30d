// The observer by itself: fed with reports made up here, it must return what algebra says of them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "kernels/block.hpp"
#include "kernels/joint/joint_forces.hpp"
#include "kernels/observers/acceleration_record.hpp"
#include "kernels/observers/force_record.hpp"
#include "kernels/observers/slider_observer.hpp"

namespace slideway::observer_test {
namespace {

using Observer = SliderObserver<double>;
using Report = SliderReport<double>;
using State = std::array<double, state_size>;

constexpr Selection everything = (Selection(1) << quantity_count) - 1;

/// A report in which nothing happens.
Report quiet() {
    Report r{};
    r.contact.clear(false);
    return r;
}

Report in_mode(int surfaces, int lines, int points) {
    auto r = quiet();
    r.contact.surfaces = surfaces;
    r.contact.lines = lines;
    r.contact.points = points;
    return r;
}

Report with_energy(double energy) {
    auto r = quiet();
    r.energy = energy;
    return r;
}

/// The observer with room for its results.  @tparam switches of the law
template <bool switches> class WatchedUnder {
public:
    WatchedUnder() { row_.fill(unwritten); }

    void start(Report const& r, State const& state = {}) { observer_.start(true, r, state.data(), switches); }
    /// One step of length h whose integrands all have the given stage means.
    void step(double h, Report const& r, State const& state = {}, std::vector<double> means = {},
              bool accepted = true) {
        means.resize(Observer::integrals, 0.0);
        observer_.accept(accepted, h, means.data(), r, state.data(), switches);
    }
    void resume(Report const& r) { observer_.switch_over(true, r, switches); }
    void finish(double time, Selection selected = everything) { observer_.finish(0, time, selected, row_.data()); }
    double operator()(Quantity q, int column = 0) const {
        return row_[static_cast<std::size_t>(quantity_column(q) + column)];
    }

    EnergyAudit<double> audit() const { return observer_.audit(); }

    static constexpr double unwritten = -12345;

private:
    Observer observer_{};
    std::array<double, quantity_columns> row_{};
};

using Watched = WatchedUnder<false>;

/// Integrands, in their order, of a report whose numbers all differ.
Report busy() {
    auto r = quiet();
    for (int face = 0; face < face_count; ++face) {
        r.contact.normal_force[face] = {1.0 + face, 10.0 + face, 100.0 + face, 1000.0 + face};
    }
    r.crank_power = 2;
    r.contact.friction_power = 3;
    r.contact.damping_power = 5;
    r.contact.elastic_power = 19;
    r.crank_torque = 0.5;
    r.drive_torque = -7;
    r.position_error = 11;
    r.rod_spin = 13;
    r.rod_spin_z = 12;
    r.energy = 17;
    return r;
}

/// Y and Z face of every apex as Qian et al. 2020, Table 2 lists the faces: top {1,4,8,5}, bottom {2,3,7,6}, front {1,2,6,5},
/// back {4,3,7,8}; the forces are those of `busy`.
constexpr double apex_forces[8] = {1 + 3, 2 + 12, 11 + 13, 10 + 4, 1000 + 1002, 1001 + 102, 101 + 103, 100 + 1003};

TEST(Observer, PeaksAreTheLargestOfStartAndAcceptedSteps) {
    // The largest of each stands at the start, at the first step or at the last one.
    for (int largest = 0; largest < 3; ++largest) {
        Watched watched;
        auto const at = [&](int step) { return step == largest ? busy() : quiet(); };
        auto const tilt = [&](int step) {
            State s{};
            if (step == largest) s[4] = -0.1, s[5] = -0.2, s[6] = 0.3;
            return s;
        };
        watched.start(at(0), tilt(0));
        watched.step(1, at(1), tilt(1));
        watched.step(1, at(2), tilt(2));
        watched.finish(2);
        EXPECT_EQ(watched(Quantity::peak_normal_force), 4444 + 6 * 4) << largest;
        for (int apex = 0; apex < 8; ++apex)
            EXPECT_EQ(watched(Quantity::peak_apex_force, apex), apex_forces[apex]) << apex;
        EXPECT_EQ(watched(Quantity::peak_crank_torque), 7) << "the magnitude of the drive torque, " << largest;
        EXPECT_EQ(watched(Quantity::peak_position_error), 11);
        EXPECT_EQ(watched(Quantity::peak_rod_angular_velocity), 13);
        EXPECT_EQ(watched(Quantity::peak_tilt, 0), 0.1);
        EXPECT_EQ(watched(Quantity::peak_tilt, 1), 0.2);
        EXPECT_EQ(watched(Quantity::peak_tilt, 2), 0.3);
    }
}

/// Where an integral stands: two of which the audit keeps books come first, then its own, in the table's order, then the others.
template <Quantity q> constexpr int place = Observer::first_audited + Observer::Places::integral_of<q>;
constexpr int crank_magnitude = 0, springs = 1;
static_assert(Observer::first_audited == 2 && Observer::powers == 2 + Observer::audit_integrals);
static_assert(place<Quantity::drive_work> == 2 && place<Quantity::friction_loss> == 3 && place<Quantity::damping_loss> == 4);
static_assert(place<Quantity::load_work> == 5 && place<Quantity::ground_work> == 6 && place<Quantity::spring_loss> == 7 && place<Quantity::film_loss> == 8);

TEST(Observer, IntegrandsAreThoseOfTheTable) {
    double values[Observer::integrals];
    Observer::integrands(busy(), values);
    EXPECT_EQ(values[place<Quantity::drive_work>], 2);
    EXPECT_EQ(values[place<Quantity::friction_loss>], 3);
    EXPECT_EQ(values[place<Quantity::damping_loss>], 5);
    EXPECT_EQ(values[place<Quantity::mean_normal_force>], 4444 + 6 * 4);
    EXPECT_EQ(values[place<Quantity::rms_crank_torque>], 49);
    EXPECT_EQ(values[place<Quantity::rms_position_error>], 121);
    EXPECT_EQ(values[place<Quantity::rms_rod_angular_velocity>], 169);
    EXPECT_EQ(values[crank_magnitude], 2) << "the magnitude of the crank's power";
    for (int apex = 0; apex < 8; ++apex) EXPECT_EQ(values[place<Quantity::mean_apex_force> + apex], apex_forces[apex]) << apex;
    EXPECT_EQ(values[springs], 19) << "the springs' power";
    double powers[Observer::powers];
    Observer::powers_of(busy(), powers);
    for (int i = 0; i < Observer::powers; ++i) EXPECT_EQ(powers[i], values[i]) << i;
}

TEST(AccelerationRecord, HoldsPeaksMeanSquaresAndAreas) {
    auto const with = [](double ax, double ay, double az, double top, double front) {
        auto r = with_energy(0);
        r.acceleration = {ax, ay, az};
        r.top = top;
        r.front = front;
        return r;
    };
    AccelerationRecord<double> record{};
    record.start(true, with(1, 0, 0, 0, 0));
    record.begin_next(true, with(1, 0, 0, 0, 0));
    // A step of two stages with weights 1/4 and 3/4: ax² is 1 and 9, ay² 0 and 4, |top| 0 and 5, |front| 0 and 6.
    record.begin_step(0.25);
    record.add_stage(0.75, with(-3, 2, 0, 5, -6));
    record.accept(true, 2, with(-3, 2, 0, 5, -6));
    record.begin_next(true, with(-3, 2, 0, 5, -6));
    // One whose start has all the weight, and one that is not accepted.
    record.begin_step(1);
    record.add_stage(0, with(9, 9, 9, 9, 9));
    record.accept(true, 2, with(2, -4, 1, -1, 2));
    record.begin_step(1);
    record.accept(false, 100, with(99, 99, 99, 99, 99));
    std::array<double, quantity_columns> row{};
    record.finish(0, 4, everything, row.data());
    auto const value = [&](Quantity q, int column) {
        return row[static_cast<std::size_t>(quantity_column(q) + column)];
    };
    double const peaks[] = {3, 4, 1}, squares[] = {2 * (0.25 + 6.75) + 2 * 9, 2 * 3 + 2 * 4, 0};
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(value(Quantity::peak_acceleration, i), peaks[i]);
        EXPECT_EQ(value(Quantity::rms_acceleration, i), std::sqrt(squares[i] / 4));
    }
    EXPECT_EQ(value(Quantity::peak_channel_acceleration, 0), 5);
    EXPECT_EQ(value(Quantity::peak_channel_acceleration, 1), 6);
    EXPECT_EQ(value(Quantity::acceleration_area, 0), 2 * 3.75 + 2 * 5);
    EXPECT_EQ(value(Quantity::acceleration_area, 1), 2 * 4.5 + 2 * 6);
}

TEST(ForceRecord, HoldsPeaksMeansAndOnsetsOfEachFace) {
    auto const with = [](double force, bool touches) {
        ForceReport<double, Report> r{};
        for (int face = 0; face < face_count; ++face) {
            r.forces.force[face] = force + face, r.forces.pressure[face] = 10 * force + face, r.forces.pv[face] = 100 * force + face;
            double const depth = touches && face != 2 ? 1e-6 : -1e-6;
            r.contact.penetration[face] = {-1, depth, -1, -1};
        }
        r.forces.friction = {force, 2 * force, -2 * force}, r.forces.rod = {0, -3 * force, 4 * force}, r.forces.crank_pin = {-force, 0, 0};
        return r;
    };
    ForceRecord<double> record{};
    record.start(true, with(0, false));
    record.begin_next(true, with(0, false));
    auto const step = [&](bool accepted, double h, auto const& r) {
        record.begin_step(0.5);
        record.add_stage(0.5, r);
        record.accept(accepted, h, r);
        record.see_faces(accepted, h, r);
        if (accepted) record.begin_next(true, r);
    };
    step(true, 2, with(1, true));    // all but one are met
    step(true, 2, with(3, true));    // and stay
    step(false, 9, with(99, false)); // not accepted
    step(true, 1, with(2, false));
    Quad<double> const held[] = {{1, 1, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0, 0}};
    record.turn(true, held, with(0, true));
    record.turn(true, held, with(0, true));
    std::array<double, quantity_columns> row{};
    record.finish(0, 5, everything, row.data());
    auto const value = [&](Quantity q, int column) { return row[static_cast<std::size_t>(quantity_column(q) + column)]; };
    double const onsets[] = {2, 1, 1, 1};
    for (int face = 0; face < face_count; ++face) {
        EXPECT_EQ(value(Quantity::peak_face_force, face), 3 + face);
        EXPECT_EQ(value(Quantity::peak_pressure, face), 30 + face);
        EXPECT_EQ(value(Quantity::peak_pv, face), 300 + face);
        EXPECT_EQ(value(Quantity::mean_pv, face), (2 * 50 + 2 * 200 + 250) / 5.0 + face);
        EXPECT_EQ(value(Quantity::face_onsets, face), onsets[face]);
    }
    EXPECT_EQ(value(Quantity::peak_friction_force, 0), 9);
    EXPECT_EQ(value(Quantity::peak_rod_force, 0), 15);
    EXPECT_EQ(value(Quantity::peak_crank_pin_force, 0), 3);
}

/// Flights with a constant acceleration, of which the cubic through both ends is exact: what an apex does that touches less does not count.
TEST(ForceRecord, CountsOnsetsByTheSpeedAtTheFace) {
    auto const at = [](double depth, double rate) {
        ForceReport<double, Report> r{};
        for (int face = 0; face < face_count; ++face) {
            r.contact.penetration[face] = face == 1 ? Quad<double>{-1, -2e-4, depth, depth - 1e-5} : Quad<double>{-1, -1, -1, -1};
            r.forces.approach[face] = face == 1 ? Quad<double>{0, 5, rate, 7} : Quad<double>{0, 0, 0, 0};
        }
        return r;
    };
    ForceRecord<double> record{};
    double const h = 1e-3;
    std::array<double, impact_speed_count> expected{};
    for (double const speed : {0.0005, 0.00099, 0.00101, 0.0299, 0.0301, 0.05, 0.999, 1.001, 30.0}) {
        // It meets the face a third of the step after its start.
        double const a = speed / h, v0 = speed - a * h / 3, d0 = -(speed * h / 3 - a * h * h / 18), v1 = v0 + a * h;
        record.start(expected == std::array<double, impact_speed_count>{}, at(d0, v0));
        record.see_faces(true, 1, at(d0, v0));
        record.see_faces(false, h, at(1, 99));
        record.see_faces(true, h, at(d0 + v0 * h + a * h * h / 2, v1));
        std::size_t bin = 0;
        while (bin + 1 < impact_speed_count && speed >= impact_speed_bins[bin + 1]) ++bin;
        ++expected[bin];
    }
    Quad<double> held[] = {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}};
    record.turn(true, held, at(0, 0));
    held[1] = {0, 0, 1, 0};
    record.turn(true, held, at(0, 0.2));  // held from here on
    ++expected[5];
    std::array<double, quantity_columns> row{};
    record.finish(0, 5, everything, row.data());
    for (std::size_t bin = 0; bin < impact_speed_count; ++bin) {
        EXPECT_EQ(row[static_cast<std::size_t>(quantity_column(Quantity::impact_speeds)) + impact_speed_count + bin], expected[bin]) << bin;
        EXPECT_EQ(row[static_cast<std::size_t>(quantity_column(Quantity::impact_speeds)) + bin], 0);
    }
    EXPECT_EQ(row[static_cast<std::size_t>(quantity_column(Quantity::face_onsets)) + 1], 10);
}

TEST(ForceRecord, SeriesOfForcesAreInTheOrderOfTheTable) {
    ForceReport<double, Report> r{};
    auto& f = r.forces;
    for (int i = 0; i < face_count; ++i) f.force[i] = i, f.along[i] = 4 + i, f.across[i] = 8 + i, f.pv[i] = 12 + i;
    f.friction = {16, 17, 18}, f.contact = {19, 20, 21}, f.rod = {22, 23, 24}, f.crank_pin = {25, 26, 27};
    for (int i = first_force_series; i < series_count; ++i) EXPECT_EQ(r.series_value(i), i - first_force_series) << series_table[i].name;
    r.x = 5;
    EXPECT_EQ(r.series_value(static_cast<int>(Series::x)), 5);
}

TEST(Observer, MeansAndSumsAreIntegralsOfTheSteps) {
    Watched watched;
    watched.start(with_energy(100));
    // Two steps, h = 1 and 3: an integrand of stage mean i + 1, then twice that, integrates to 7 (i + 1).
    std::vector<double> first, second;
    for (int i = 0; i < Observer::integrals; ++i) first.push_back(i + 1), second.push_back(2 * (i + 1));
    watched.step(1, with_energy(50), {}, first);
    watched.step(3, with_energy(102.5), {}, second);
    watched.finish(4);
    double const work = 7 * (place<Quantity::drive_work> + 1), friction = 7 * (place<Quantity::friction_loss> + 1),
                 damping = 7 * (place<Quantity::damping_loss> + 1), loads = 7 * (place<Quantity::load_work> + 1);
    double const ground = 7 * (place<Quantity::ground_work> + 1), springs = 7 * (place<Quantity::spring_loss> + 1),
                 film = 7 * (place<Quantity::film_loss> + 1);
    EXPECT_EQ(watched(Quantity::drive_work), work);
    EXPECT_EQ(watched(Quantity::friction_loss), friction);
    EXPECT_EQ(watched(Quantity::damping_loss), damping);
    EXPECT_EQ(watched(Quantity::load_work), loads);
    EXPECT_EQ(watched(Quantity::ground_work), ground);
    EXPECT_EQ(watched(Quantity::spring_loss), springs);
    EXPECT_EQ(watched(Quantity::film_loss), film);
    EXPECT_EQ(watched(Quantity::energy_change), 2.5);
    EXPECT_EQ(watched(Quantity::energy_residual), 2.5 - work - loads - ground + springs + film + friction + damping);
    auto const mean = [](int at) { return 7 * (at + 1) / 4.0; };
    EXPECT_EQ(watched(Quantity::mean_normal_force), mean(place<Quantity::mean_normal_force>));
    EXPECT_EQ(watched(Quantity::rms_crank_torque), std::sqrt(mean(place<Quantity::rms_crank_torque>)));
    EXPECT_EQ(watched(Quantity::rms_position_error), std::sqrt(mean(place<Quantity::rms_position_error>)));
    EXPECT_EQ(watched(Quantity::rms_rod_angular_velocity), std::sqrt(mean(place<Quantity::rms_rod_angular_velocity>)));
    for (int apex = 0; apex < 8; ++apex)
        EXPECT_EQ(watched(Quantity::mean_apex_force, apex), mean(place<Quantity::mean_apex_force> + apex)) << apex;
}

/// E and U at the end of a step, and the first of the apices that touch.
Report with_contact(double energy, double potential, int apices) {
    auto r = with_energy(energy);
    r.contact.potential = potential;
    for (auto& face : r.contact.penetration) face = {-1, -1, -1, -1};
    auto& top = r.contact.penetration[0];
    top = {apices > 0 ? 1.0 : -1.0, apices > 1 ? 1.0 : -1.0, apices > 2 ? 1.0 : -1.0, -1};
    return r;
}

/// Means of a step whose springs took up `taken_up` and which lost `loss` to friction.
std::vector<double> audit_means(double taken_up, double loss) {
    std::vector<double> means(Observer::integrals, 0.0);
    means[place<Quantity::friction_loss>] = loss;
    means[springs] = taken_up;
    return means;
}

TEST(Observer, OfAConservingLawBlamesTheMethodForTheResidual) {
    Watched watched;
    watched.start(with_contact(10, 1, 1));
    watched.step(2, with_contact(13, 5, 3), {}, audit_means(0, 0.5));  // + 4
    watched.step(2, with_contact(11, 2, 3), {}, audit_means(0, 0.5));  // − 1
    auto const audit = watched.audit();
    EXPECT_EQ(audit.made, 3);
    EXPECT_EQ(audit.made, audit.residual());
    EXPECT_EQ(audit.astray, 5);
    EXPECT_EQ(audit.exchanged, 4 + 3);
    EXPECT_EQ(audit.stored, 5);
}

TEST(Observer, OfASwitchingLawLeavesToTheLawWhatItMadeByASwitch) {
    using Switching = WatchedUnder<true>;
    // Springs that took up 3 hold 7 after a switch: the law made 4, and the method the rest of E's 4.5.
    Switching switching;
    switching.start(with_contact(10, 1, 1));
    switching.step(1, with_contact(14.5, 8, 2), {}, audit_means(3, 0));
    EXPECT_EQ(switching.audit().residual(), 4.5);
    EXPECT_EQ(switching.audit().made, 0.5);
    EXPECT_EQ(switching.audit().astray, 0.5);
    EXPECT_EQ(switching.audit().exchanged, 3);
    // With the same apices in touch no switch is to blame, nor where a step leaps into the way or out of it.
    for (auto const& [before, after] : {std::pair{2, 2}, {0, 2}, {2, 0}}) {
        Switching leaping;
        leaping.start(with_contact(10, 1, before));
        leaping.step(1, with_contact(14.5, 8, after), {}, audit_means(3, 0));
        EXPECT_EQ(leaping.audit().made, 4.5) << before << ' ' << after;
    }
}

TEST(Observer, ResumesWhereTheLawChangedWithoutAStep) {
    WatchedUnder<true> watched;
    watched.start(with_contact(10, 1, 2));
    watched.resume(with_contact(12, 3, 2));  // located, it makes 2
    watched.step(1, with_contact(12, 3, 2));
    EXPECT_EQ(watched.audit().made, 0);
    EXPECT_EQ(watched.audit().residual(), 2);
}

TEST(Observer, TellsTouchingPairsApart) {
    ContactReport<double> contact;
    contact.clear(false);
    for (auto& face : contact.penetration) face = {-1, 0, -1, 0};
    EXPECT_EQ(contact.pattern(), 0);
    double bit = 1;
    for (auto& face : contact.penetration) {
        for (double* depth : {&face.a, &face.b, &face.c, &face.d}) {
            double const before = std::exchange(*depth, 1e-12);
            EXPECT_EQ(contact.pattern(), bit);
            *depth = before;
            bit *= 2;
        }
    }
}

TEST(Observer, SharesAStepBetweenTwoModesByHalves) {
    Watched watched;
    watched.start(in_mode(0, 0, 0));
    watched.step(2, in_mode(0, 0, 0));   // free 2
    watched.step(4, in_mode(0, 0, 1));   // free 2, point 2
    watched.step(8, in_mode(0, 2, 1));   // point 4, line 4
    watched.step(16, in_mode(1, 0, 0));  // line 8, surface 8
    watched.step(32, in_mode(1, 2, 0));  // surface 32
    watched.step(64, in_mode(0, 0, 0));  // surface 32, free 32
    watched.finish(126);
    EXPECT_EQ(watched(Quantity::mode_time, 0), 36);
    EXPECT_EQ(watched(Quantity::mode_time, 1), 6);
    EXPECT_EQ(watched(Quantity::mode_time, 2), 12);
    EXPECT_EQ(watched(Quantity::mode_time, 3), 72);
}

TEST(Observer, CountsOnsetsFromFreeFlightAlone) {
    Watched watched;
    watched.start(in_mode(0, 1, 0));    // a start in contact is none
    watched.step(1, in_mode(1, 0, 0));  // harder, but no onset
    watched.step(1, in_mode(0, 0, 0));  // leaving
    watched.step(1, in_mode(0, 0, 0));
    watched.step(1, in_mode(0, 0, 3));  // first
    watched.step(1, in_mode(0, 1, 0));
    watched.step(1, in_mode(0, 0, 1));
    watched.step(1, in_mode(0, 0, 0));
    watched.step(1, in_mode(2, 0, 0));  // second
    watched.step(1, in_mode(0, 0, 0));
    watched.finish(9);
    EXPECT_EQ(watched(Quantity::contact_onsets), 2);
}

/// In all quantities.
void expect_equal(Watched const& found, Watched const& wanted) {
    for (int q = 0; q < quantity_count; ++q) {
        for (int column = 0; column < quantity_table[q].columns; ++column) {
            EXPECT_EQ(found(static_cast<Quantity>(q), column), wanted(static_cast<Quantity>(q), column)) << quantity_table[q].name;
        }
    }
}

TEST(Observer, TakesNothingFromARejectedLane) {
    Watched seen, unseen;
    std::vector<double> const means(Observer::integrals, 4.0);
    State const tilted{0, 0, 0, 0, 1, 1, 1};
    for (auto* watched : {&seen, &unseen}) {
        watched->start(in_mode(0, 0, 1));
        watched->step(2, with_energy(3));
    }
    auto report = busy();
    report.contact.surfaces = 1;
    unseen.step(2, report, tilted, means, false);
    for (auto* watched : {&seen, &unseen}) {
        watched->step(2, in_mode(0, 1, 0));
        watched->finish(4);
    }
    expect_equal(unseen, seen);
}

TEST(Observer, BeginsEveryMemberAnew) {
    Watched fresh, used;
    used.start(busy(), {0, 0, 0, 0, 1, 1, 1});
    used.step(5, in_mode(1, 0, 0), {}, std::vector<double>(Observer::integrals, 6.0));
    used.step(5, quiet());
    used.step(5, in_mode(1, 0, 0));
    for (auto* watched : {&fresh, &used}) {
        watched->start(with_energy(1));
        watched->step(1, with_energy(2), {}, std::vector<double>(Observer::integrals, 1.0));
        watched->finish(1);
    }
    expect_equal(used, fresh);
}

TEST(Observer, WritesTheSelectedQuantitiesAlone) {
    for (int chosen = 0; chosen < quantity_count; ++chosen) {
        Watched watched;
        watched.start(busy());
        watched.step(1, busy());
        watched.finish(1, Selection(1) << chosen);
        bool const elsewhere =
            selects(AccelerationRecord<double>::quantities | ForceRecord<double>::quantities, static_cast<Quantity>(chosen));
        for (int q = 0; q < quantity_count; ++q) {
            for (int column = 0; column < quantity_table[q].columns; ++column) {
                bool const written = watched(static_cast<Quantity>(q), column) != Watched::unwritten;
                EXPECT_EQ(written, q == chosen && !elsewhere)
                    << quantity_table[q].name << " where " << quantity_table[chosen].name << " is asked for";
            }
        }
    }
}

TEST(Observer, AMemberThatNeverMovedHasFiniteMeans) {
    Watched watched;
    watched.start(quiet());
    watched.finish(0);
    EXPECT_EQ(watched(Quantity::mean_normal_force), 0);
    EXPECT_EQ(watched(Quantity::rms_crank_torque), 0);
}

}  // namespace
}  // namespace slideway::observer_test
