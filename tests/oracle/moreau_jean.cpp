#include "moreau_jean.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linear_solve.hpp"
#include "numbers.hpp"
#include "rigid_frame.hpp"

namespace oracle {
namespace {

using namespace detail;

/// One step's impulses: M (u⁺ − u) = h load + impulses of the corners that are inside at the midpoint, with Newton's restitution and Coulomb's
/// friction, by the fewest violated conditions among all guesses of what those do.
class Stepper {
public:
    Stepper(Inputs const& in, Parts const& parts, MoreauJeanRates rates)
        : in_(in), free_(parts.drive.turns_freely()), predicts_(rates == MoreauJeanRates::of_middle), friction_(parts.friction ? Real(in.friction_kinetic) : Real(0)) {}

    void advance(PlanarState& s, Real h) const {
        Vector3 const u(s[3], s[4], s[5]);
        PlanarState middle = s;
        if (predicts_) {
            RigidFrame const start = rigid_frame(in_, s);
            Vector3 const change = solved(start, h / 2 * start.load, {}, {}, u);
            for (int i = 0; i < 3; ++i) middle[3 + i] += change[i];
        }
        for (int i = 0; i < 3; ++i) s[i] += h / 2 * u[i], middle[i] = s[i];
        RigidFrame const f = rigid_frame(in_, middle);
        // Corners that leave by themselves take no part: what another throws back meets its wall in a step of its own.
        Vector3 const free = u + solved(f, h * f.load, {}, {}, u);
        std::vector<int> active;
        for (int c = 0; c < 4; ++c) {
            if (f.gap[c] <= 0 && f.normal[c].dot(free) < 0) active.push_back(c);
        }
        Vector3 const next = active.empty() ? free : with_contacts(f, h, u, active);
        for (int i = 0; i < 3; ++i) s[3 + i] = next[i], s[i] += h / 2 * next[i];
    }

private:
    enum Doing { open, forwards, backwards, stick };

    /// Change of u with unknown impulses of the corners, appended to the equations.
    [[nodiscard]] Vector3 solved(RigidFrame const& f, Vector3 const& load, std::vector<int> const& corners, std::vector<Doing> const& doing, Vector3 const& u,
                                 std::vector<Real>* normal = nullptr, std::vector<Real>* along = nullptr) const {
        auto const n = static_cast<Eigen::Index>(corners.size());
        Matrix system = Matrix::Identity(3 + 2 * n, 3 + 2 * n), right = Matrix::Zero(3 + 2 * n, 1);
        system.topLeftCorner(3, 3) = f.mass;
        right.topRows(3) = load;
        for (Eigen::Index k = 0; k < n; ++k) {
            int const c = corners[static_cast<std::size_t>(k)];
            Doing const what = doing[static_cast<std::size_t>(k)];
            Eigen::Index const push = 3 + 2 * k, drag = push + 1;
            system.block(0, push, 3, 1) = -f.normal[c].transpose();
            system.block(0, drag, 3, 1) = -f.tangent[c].transpose();
            if (what == open) continue;
            system.row(push).setZero();
            system.block(push, 0, 1, 3) = f.normal[c];
            right(push, 0) = -(1 + Real(in_.restitution)) * std::min(Real(0), Real(f.normal[c].dot(u)));
            if (f.normal[c].dot(u) > 0) right(push, 0) = -f.normal[c].dot(u);
            if (what == stick) {
                system.row(drag).setZero();
                system.block(drag, 0, 1, 3) = f.tangent[c];
                right(drag, 0) = -f.tangent[c].dot(u);
            } else {
                system(drag, push) = (what == forwards ? 1 : -1) * friction_;
            }
        }
        if (!free_) {
            system.row(0).setZero();
            system(0, 0) = 1;
            right(0, 0) = 0;
        }
        Matrix const x = solution(system, right);
        for (Eigen::Index k = 0; normal != nullptr && k < n; ++k) normal->push_back(x(3 + 2 * k, 0)), along->push_back(x(4 + 2 * k, 0));
        return x.topRows(3);
    }

    [[nodiscard]] Vector3 with_contacts(RigidFrame const& f, Real h, Vector3 const& u, std::vector<int> const& corners) const {
        Real best = std::numeric_limits<Real>::max();
        Vector3 found = u;
        std::vector<Doing> doing(corners.size(), open);
        auto const attempt = [&] {
            std::vector<Real> normal, along;
            Vector3 const next = u + solved(f, h * f.load, corners, doing, u, &normal, &along);
            Real worst = 0;
            for (std::size_t k = 0; k < corners.size(); ++k) {
                int const c = corners[k];
                Real const before = f.normal[c].dot(u), after = f.normal[c].dot(next), slip = f.tangent[c].dot(next);
                Real const wanted = before < 0 ? -Real(in_.restitution) * before : Real(0);
                worst = std::max(worst, doing[k] == open ? wanted - after : -normal[k]);
                if (friction_ == 0 || doing[k] == open) continue;
                if (doing[k] == stick) worst = std::max(worst, std::abs(along[k]) - friction_ * normal[k]);
                else worst = std::max(worst, doing[k] == forwards ? -slip : slip);
            }
            if (worst < best) best = worst, found = next;
        };
        auto const vary = [&](auto const& self, std::size_t k) -> void {
            if (k == corners.size()) return attempt();
            for (Doing const what : {open, forwards, backwards, stick}) {
                if (friction_ == 0 && what > forwards) continue;
                if (what == stick && std::ranges::count(doing.begin(), doing.begin() + static_cast<std::ptrdiff_t>(k), stick) > 0) continue;
                doing[k] = what;
                self(self, k + 1);
            }
        };
        vary(vary, 0);
        return found;
    }

    Inputs in_;
    bool free_, predicts_;
    Real friction_;
};

}  // namespace

std::vector<PlanarState> moreau_jean_run(Inputs const& in, Parts const& parts, long double every, int count, long double step,
                                         MoreauJeanRates rates) {
    Stepper const stepper(in, parts, rates);
    PlanarState s = planar_start(in);
    std::vector<PlanarState> samples{s};
    long const steps = std::lround(every / step);
    for (int i = 0; i < count; ++i) {
        for (long k = 0; k < steps; ++k) stepper.advance(s, every / steps);
        samples.push_back(s);
    }
    return samples;
}

}  // namespace oracle
