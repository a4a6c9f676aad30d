#include "spatial_runs.hpp"

#include <algorithm>
#include <array>

#include "numbers.hpp"
#include "runge_kutta.hpp"

namespace oracle {
namespace {

using namespace detail;

/// The state, t, W, D_f, D_d.
using Books = std::array<Real, 16>;
constexpr std::size_t time_at = 12, work_at = 13, friction_at = 14, damping_at = 15;

class Run {
public:
    Run(Inputs const& in, Parts const& parts) : in_(in), parts_(parts) {}

    [[nodiscard]] Result at(Books const& books) const {
        State state;
        std::transform(books.begin(), books.begin() + time_at, state.begin(),
                       [](Real value) { return static_cast<double>(value); });
        return evaluate(in_, parts_, static_cast<double>(books[time_at]), state);
    }
    [[nodiscard]] Books after(Books const& start, Real h) const {
        return runge_kutta(start, h, [this](Books const& books) {
            Result const r = at(books);
            Books rates{};
            std::copy(r.derivative.begin(), r.derivative.end(), rates.begin());
            rates[time_at] = 1;
            rates[work_at] = r.power_crank, rates[friction_at] = r.power_friction, rates[damping_at] = r.power_damping;
            return rates;
        });
    }
    /// Of each pair: whether it touches, and whether it pushes.
    [[nodiscard]] std::array<bool, 32> contacts(Books const& books) const {
        Result const r = at(books);
        std::array<bool, 32> all{};
        for (std::size_t i = 0; i < 8; ++i) {
            all[i] = r.pen_y[i] > 0, all[8 + i] = r.pen_z[i] > 0;
            all[16 + i] = r.fn_y[i] > 0, all[24 + i] = r.fn_z[i] > 0;
        }
        return all;
    }

private:
    Inputs const& in_;
    Parts const& parts_;
};

}  // namespace

SpatialRun spatial_run(Inputs const& in, Parts const& parts, State const& start, long double duration,
                       long double step) {
    Run const run(in, parts);
    Books books{};
    std::copy(start.begin(), start.end(), books.begin());
    Real const energy = run.at(books).energy;
    SpatialRun result;
    auto held = run.contacts(books);
    while (books[time_at] < duration) {
        Real h = std::min(step, duration - books[time_at]);
        if (books[time_at] + h == books[time_at]) break;
        Books next = run.after(books, h);
        if (run.contacts(next) != held) {
            Real before = 0, past = h;
            while (past - before > 1e-17L) {
                Real const middle = (before + past) / 2;
                (run.contacts(run.after(books, middle)) != held ? past : before) = middle;
            }
            // The longer part ends before the change: only its last stage may look beyond, by its own error.
            next = run.after(run.after(books, before), past - before);
            held = run.contacts(next);
            ++result.changes;
        }
        books = next;
    }
    Result const last = run.at(books);
    std::transform(books.begin(), books.begin() + time_at, result.state.begin(),
                   [](Real value) { return static_cast<double>(value); });
    result.energy_change = last.energy - energy;
    result.work = books[work_at], result.friction = books[friction_at], result.damping = books[damping_at];
    return result;
}

}  // namespace oracle
