// Compiled under a name of its own (CMakeLists.txt here): it shares no code with the kernels.
#include "host/backend/linkage_numbers.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/linkage/linkage_start.hpp"

namespace slideway {

namespace {

/// As it goes together, or of a state that is given.
LinkageStart start_as(LinkagePlan const& plan, LinkageParameters<double> const& p, Inputs const& in) {
    StateNumbers given{};
    if (is_given(in)) put_linkage_start(plan, in, given.data());
    return {plan, p, is_given(in) ? given[1] : start_speed(in), is_given(in) ? given.data() : nullptr};
}

}  // namespace

LinkageAssembly assembled(LinkagePlan const& plan, Inputs const& in) {
    LinkageParameters<double> const p = linkage_parameters(plan, in);
    LinkageStart const start = start_as(plan, p, in);
    LinkageAssembly found{start.fault(), start.worst(), start.distance(), start.rate(), {}};
    start.put_as_it_is(found.state.data());
    return found;
}

std::array<double, 2> place_in_joint(LinkagePlan const& plan, Inputs const& in, int closure) {
    LinkageParameters<double> const p = linkage_parameters(plan, in);
    auto const [x, y] = start_as(plan, p, in).place_in(closure);
    return {x, y};
}

StateNumbers start_of(LinkagePlan const& plan, Inputs const& in) {
    StateNumbers state{};
    put_linkage_start(plan, in, state.data());
    return state;
}

LinkageSize size_of(LinkagePlan const& plan, Inputs const& in) {
    LinkageParameters<double> const p = linkage_parameters(plan, in);
    LinkageSize size{p.play, p.play, p.reach, p.mass};
    for (int k = 0; k < plan.closures; ++k) size.most_play = std::max(size.most_play, p.closure[k].clearance);
    return size;
}

double stiffest_rate(LinkagePlan const& plan, Inputs const& in) {
    LinkageParameters<double> const p = linkage_parameters(plan, in);
    double mass = p.mass, rate = 0;
    for (int i = 0; i < plan.bodies; ++i) mass = std::min(mass, p.body[i].mass);
    double const n = in.hertz_exponent, speed = plan.is_driven ? std::abs(in.crank_speed) * p.body[0].reach : 0;
    for (int k = 0; k < plan.closures; ++k) {
        if (!plan.closure[k].has_clearance()) continue;
        double const stiffness = p.closure[k].contact.stiffness, depth = std::pow((n + 1) * mass * speed * speed / (2 * stiffness), 1 / (n + 1));
        rate = std::max(rate, std::sqrt(n * stiffness * std::pow(depth, n - 1) / mass));
    }
    return rate;
}

double rate_on_stop(LinkagePlan const& plan, Load const& stop, Inputs const& in) {
    LinkageParameters<double> const p = linkage_parameters(plan, in);
    double least = p.mass * p.reach * p.reach;
    if (!stop.turns) least = p.mass;
    for (int i = 0; i < plan.bodies; ++i) {
        auto const& body = p.body[i];
        double const about_joint = body.inertia + body.mass * (body.center.x * body.center.x + body.center.y * body.center.y);
        if (!stop.turns) least = std::min(least, body.mass);
        else if (plan.body[i].joint != TreeJoint::prismatic && about_joint > 0) least = std::min(least, about_joint);
    }
    return std::sqrt(in.*load_inputs[stop.turns ? stop.angular_stiffness : stop.stiffness] / least);
}

}  // namespace slideway
