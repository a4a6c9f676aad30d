#pragma once

#include "kernels/block.hpp"
#include "kernels/lanes/pack.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The offset of a shadow from its member, in the scales of the state, and behind it that of the impact speeds that both remember.  These are part of
/// where a member is as long as their pairs touch; of others they mean nothing.
template <class Model, class Real> struct ShadowOffset {
    using Shadow = typename MemberState<Model, Real>::Shadow;
    using Memory = typename Model::template Memory<Real>;

    /// @param width numbers of the offset: the state's, and how many impact speeds behind them
    SLIDEWAY_HD static void read(Pack<Model, Real> const& pack, Shadow const& shadow, int width, Real* w) {
        auto const& s = pack.state;
        int const n = pack.states();
        for (int i = 0; i < n; ++i) w[i] = (shadow.y[i] - s.course.y[i]) / s.constants.scale[i];
        if constexpr (has_speeds) {
            Real const scale = Model::touch_speed(s.constants.parameters);
            for (int i = n; i < width; ++i) {
                Real const apart = (numbers(shadow.contacts.memory)[i - n] - numbers(s.contacts.memory)[i - n]) / scale;
                w[i] = select(touches(s.contacts.watch, i - n) & touches(shadow.contacts.watch, i - n), apart, Real(0.0));
            }
        }
    }

    SLIDEWAY_HD static void write(Pack<Model, Real> const& pack, Mask<Real> in, Real const* w, int width, Real length, Shadow& shadow) {
        auto const& s = pack.state;
        int const n = pack.states();
        for (int i = 0; i < n; ++i) {
            shadow.y[i] = select(in, fma(length * s.constants.scale[i], w[i], s.course.y[i]), shadow.y[i]);
        }
        if constexpr (has_speeds) {
            Real const scale = length * Model::touch_speed(s.constants.parameters);
            // Where its member touches, a shadow that did not may touch from here on, without a touch of its own.
            for (int i = n; i < width; ++i) {
                Real& number = numbers(shadow.contacts.memory)[i - n];
                Real const own = numbers(s.contacts.memory)[i - n];
                number = select(in & touches(s.contacts.watch, i - n), Model::remembered(fma(scale, w[i], own)), number);
            }
        }
    }

    /// What rounding makes of an offset.  The numbers of a member with rigid contacts may be far longer than what they are measured in.
    SLIDEWAY_HD static Real rounding(Pack<Model, Real> const& pack) {
        Real least(least_distance);
        if constexpr (IsRigid<Model>) {
            auto const& s = pack.state;
            for (int i = 0, n = pack.states(); i < n; ++i) {
                if ((pack.model.prescribed() >> i & 1u) != 0) continue;
                least = max(Real(4 * 2.220446049250313e-16) * abs(s.course.y[i]) / s.constants.scale[i], least);
            }
        }
        return least;
    }

private:
    static constexpr bool has_speeds = Memory::speeds > 0;
    template <class Watch> SLIDEWAY_FN static Mask<Real> touches(Watch const& watch, int pair) { return watch.start_depth(pair) > Real(0.0); }
    /// The impact speeds come first in it.
    SLIDEWAY_HD static Real* numbers(Memory& memory) { return reinterpret_cast<Real*>(&memory); }
    SLIDEWAY_HD static Real const* numbers(Memory const& memory) { return reinterpret_cast<Real const*>(&memory); }
};

}  // namespace slideway::inline SLIDEWAY_ISA
