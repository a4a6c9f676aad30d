#pragma once

#include "kernels/block.hpp"
#include "kernels/joint/contact_report.hpp"
#include "kernels/lane_copy.hpp"
#include "kernels/lanes/model.hpp"
#include "kernels/mechanisms/planar_report.hpp"
#include "kernels/real.hpp"
#include "kernels/simd/expect.hpp"

namespace slideway::inline SLIDEWAY_ISA {

namespace detail {

/// Numbers of the apices of each face of one lane: those of the Y faces, those of the Z faces.
template <class Real> SLIDEWAY_HD void put_apices(Quad<Real> const* faces, int index, double* of_y, double* of_z) {
    for (int face = 0; face < face_count; ++face) {
        double* const to = face < 2 ? of_y : of_z;
        auto const& q = faces[face];
        to[face_apex(face, 0)] = lane(q.a, index);
        to[face_apex(face, 1)] = lane(q.b, index);
        to[face_apex(face, 2)] = lane(q.c, index);
        to[face_apex(face, 3)] = lane(q.d, index);
    }
}

/// Penetrations and forces of one lane.
template <class Real> SLIDEWAY_HD void put_contact(ContactReport<Real> const& c, int index, ProbeResult& result) {
    put_apices(c.penetration, index, result.penetration_y, result.penetration_z);
    put_apices(c.normal_force, index, result.normal_force_y, result.normal_force_z);
}

/// What else forces of faces are told from.
template <class Forces> SLIDEWAY_HD void put_forces(Forces const& forces, int index, ProbeResult& result) {
    for (int k = first_force_series; k < series_count; ++k) result.forces[k - first_force_series] = lane(forces.series_value(k), index);
    put_apices(forces.approach, index, result.approach_y, result.approach_z);
    put_apices(forces.sliding, index, result.sliding_y, result.sliding_z);
    double* torque = result.torque;
    for (auto const& part : {forces.torque.x, forces.torque.y, forces.torque.z}) *torque++ = lane(part, index);
}

/// Of the planar slider: its four corners, in the places of the first four apices.
template <class Real> SLIDEWAY_HD void put_contact(PlanarContact<Real> const& c, int index, ProbeResult& result) {
    auto const put = [&](double* to, double* unused, Quad<Real> const& q) {
        double const corners[8] = {lane(q.a, index), lane(q.b, index), lane(q.c, index), lane(q.d, index)};
        for (int i = 0; i < 8; ++i) to[i] = i < 4 ? corners[i] : not_a_number, unused[i] = not_a_number;
    };
    put(result.penetration_y, result.penetration_z, c.penetration[0]);
    put(result.normal_force_y, result.normal_force_z, c.normal_force[0]);
}

}  // namespace detail

/// Evaluates a table of states, a pack at a time; the last pack is filled up with the last row.
template <class Model, class Real> SLIDEWAY_HD void probe(ProbeTable const& table, Model const& model = {}) {
    Model telling = model;
    telling.tell_forces(true);
    constexpr int width = lanes<Real>;
    constexpr int size = Model::size;
    StateCount<Model> const n(model);
    SLIDEWAY_EXPECT(table.rows == 0 || (table.inputs != nullptr && table.times != nullptr && table.results != nullptr));
    typename Model::template Parameters<Real> p;
    typename Model::template Report<Real> report;
    typename Model::template Memory<Real> memory;
    start_memory(memory);
    for (std::size_t first = 0; first < table.rows; first += width) {
        Real t, state[size], rates[size];
        for (int i = 0; i < width; ++i) {
            std::size_t const row = first + i < table.rows ? first + i : table.rows - 1;
            auto of_row = model.parameters(table.inputs[row]);
            // A planar state has the crank's angle at t for its start, and a drive would turn on by ω t: loads alone hear of t.
            constexpr bool at_start = requires { of_row.start_time; };
            if constexpr (at_start) of_row.start_time = table.times[row];
            set_lane(t, i, at_start ? 0 : table.times[row]);
            load_lane(p, i, of_row);
            double start[size];
            model.initial_state(table.inputs[row], start);
            for (int j = 0; j < n; ++j) set_lane(state[j], i, start[j]);
        }
        auto const faults = telling.template derivative<true>(t, state, p, memory, rates, &report);
        for (int i = 0; i < width && first + i < table.rows; ++i) {
            auto& result = table.results[first + i];
            bool finite = true;
            for (int j = 0; j < n; ++j) {
                result.derivative[j] = lane(rates[j], i);
                finite = finite && result.derivative[j] - result.derivative[j] == 0;
            }
            auto const& c = report.contact;
            if constexpr (requires { c.put(i, result); }) c.put(i, result);
            else detail::put_contact(c, i, result);
            result.power_crank = lane(report.crank_power, i);
            result.power_friction = lane(c.friction_power, i);
            result.power_damping = lane(c.damping_power, i);
            result.power_load = lane(report.load_power, i);
            result.power_ground = lane(report.ground_power, i);
            result.loss_springs = lane(report.spring_loss, i);
            result.loss_film = lane(report.film_loss, i);
            result.surfaces = static_cast<int>(lane(c.surfaces, i));
            result.lines = static_cast<int>(lane(c.lines, i));
            result.points = static_cast<int>(lane(c.points, i));
            result.energy = lane(report.energy, i);
            result.contact_potential = lane(c.potential, i);
            result.crank_torque = lane(report.crank_torque, i);
            if constexpr (requires { report.forces; }) detail::put_forces(report.forces, i, result);
            double* signal = result.signals;
            if constexpr (requires { report.signal; }) for (Real const& value : report.signal) *signal++ = lane(value, i);
            result.status = holds(faults.geometry, i)         ? Status::geometry
                            : holds(faults.contact_domain, i) ? Status::contact_domain
                            : finite                          ? Status::finished
                                                              : Status::nonfinite;
        }
    }
}

}  // namespace slideway::inline SLIDEWAY_ISA
