#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "kernels/observers/quantities.hpp"
#include "kernels/observers/signals.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Of a mechanism without signals: its lanes are those of its base.
struct NoSignals { static constexpr int count = 0; };

/// Those of a mechanism's info, for constants.
template <class Mechanism> struct OwnSignals {
    static constexpr int count = static_cast<int>(Mechanism::info.signals.size());
    static constexpr int quantity_count = signal_quantity_count(Mechanism::info.signals);
    static constexpr auto quantities = [] {
        std::array<SignalQuantity, static_cast<std::size_t>(quantity_count)> all{};
        std::size_t next = 0;
        for_each_signal_quantity(Mechanism::info.signals, [&](SignalQuantity const& one) { all[next++] = one; });
        return all;
    }();
};
template <class Mechanism> using SignalsOf = std::conditional_t<Mechanism::info.signals.empty(), NoSignals, OwnSignals<Mechanism>>;

/// A report that tells the signals too.
template <class Real, class Report, int count> struct SignalReport : Report {
    Real signal[count];

    /// Value of an entry of `series_table`, or behind it of a signal, beyond the state.
    SLIDEWAY_FN Real series_value(int entry) const { return entry < series_count ? Report::series_value(entry) : signal[entry - series_count]; }
};

/// The quantities of a mechanism's signals, beside those that its observer keeps: behind them in a member's row, in the integrals of steps and in a
/// Selection.  Means are of the stages, with the stepper's order; the others go by the accepted steps, largest
/// and smallest values by what is inside of them too.
/// @tparam Observer SliderObserver
template <class Real, class Observer, class Signals> class SignalObserver : public Observer {
public:
    using Report = SignalReport<Real, typename Observer::Report, Signals::count>;
    static constexpr int columns = Observer::columns + Signals::quantity_count;

private:
    static constexpr int count = Signals::quantity_count;
    template <int k> static constexpr SignalQuantity quantity = Signals::quantities[k];
    /// How many of the first `end` are integrals.
    static constexpr int integrals_before(int end) {
        int sum = 0;
        for (int k = 0; k < end; ++k) sum += Signals::quantities[static_cast<std::size_t>(k)].integrates() ? 1 : 0;
        return sum;
    }
    template <int k> static constexpr int place = Observer::integrals + integrals_before(k);
    static constexpr Selection bit(int k) { return Selection{1} << (quantity_count + k); }
    static constexpr Selection integrating = [] {
        Selection set = 0;
        for (int k = 0; k < count; ++k) set |= Signals::quantities[static_cast<std::size_t>(k)].integrates() ? bit(k) : 0;
        return set;
    }();
    static constexpr Selection peaking = [] {
        Selection set = 0;
        for (int k = 0; k < count; ++k) {
            auto const statistic = Signals::quantities[static_cast<std::size_t>(k)].statistic;
            set |= statistic == Statistic::maximum || statistic == Statistic::minimum ? bit(k) : 0;
        }
        return set;
    }();
    template <int k> static constexpr int peak = Observer::peaks + k - integrals_before(k);
    template <int> struct Number {};
    template <class Function> SLIDEWAY_FN static void each(Function const& see) {
        [&]<int... k>(std::integer_sequence<int, k...>) { (see(Number<k>{}), ...); }(std::make_integer_sequence<int, count>{});
    }

public:
    static constexpr int integrals = Observer::integrals + integrals_before(count);

    SLIDEWAY_HD static constexpr bool needs_stages(Selection q) { return Observer::needs_stages(q) || (q & integrating) != 0; }
    SLIDEWAY_HD static constexpr bool integrates_more(Selection q) { return Observer::integrates_more(q) || (q & integrating) != 0; }

    SLIDEWAY_FN static void integrands(Report const& r, Real* values) {
        Observer::integrands(r, values);
        each([&]<int k>(Number<k>) {
            if constexpr (quantity<k>.integrates()) {
                Real const x = r.signal[quantity<k>.signal];
                values[place<k>] = quantity<k>.statistic == Statistic::mean ? x : Real(x * x);
            }
        });
    }

    SLIDEWAY_FN void start(Mask<Real> fresh, Report const& r, Real const* state, bool switches) {
        Observer::start(fresh, r, state, switches);
        each([&]<int k>(Number<k>) {
            Real const first = quantity<k>.integrates() ? Real(0.0) : r.signal[quantity<k>.signal];
            kept_[k] = select(fresh, first, kept_[k]);
        });
    }

    SLIDEWAY_FN void accept(Mask<Real> accepted, Real h, Real const* integral, Report const& r, Real const* state, bool switches) {
        Observer::accept(accepted, h, integral, r, state, switches);
        each([&]<int k>(Number<k>) {
            Real next = r.signal[quantity<k>.signal];
            if constexpr (quantity<k>.integrates()) next = fma(h, integral[place<k>], kept_[k]);
            else if constexpr (quantity<k>.statistic == Statistic::maximum) next = max(next, kept_[k]);
            else if constexpr (quantity<k>.statistic == Statistic::minimum) next = min(next, kept_[k]);
            kept_[k] = select(accepted, next, kept_[k]);
        });
    }

    /// What is no integral has a place: a smallest value turned, and one at the end, which is not raised.
    static constexpr int peaks = Observer::peaks + count - integrals_before(count);
    SLIDEWAY_HD static constexpr bool needs_peaks(Selection q) { return Observer::needs_peaks(q) || (q & peaking) != 0; }
    SLIDEWAY_FN static void tell_peaks(Report const& r, Real const* state, Real* values) {
        Observer::tell_peaks(r, state, values);
        each([&]<int k>(Number<k>) {
            if constexpr (quantity<k>.integrates()) return;
            Real const x = r.signal[quantity<k>.signal];
            values[peak<k>] = quantity<k>.statistic == Statistic::minimum ? negated(x) : x;
        });
    }
    SLIDEWAY_FN void raise_peaks(Mask<Real> in, Real const* values) {
        Observer::raise_peaks(in, values);
        each([&]<int k>(Number<k>) {
            constexpr auto statistic = quantity<k>.statistic;
            if constexpr (statistic == Statistic::maximum) kept_[k] = select(in, max(values[peak<k>], kept_[k]), kept_[k]);
            else if constexpr (statistic == Statistic::minimum) kept_[k] = select(in, min(negated(values[peak<k>]), kept_[k]), kept_[k]);
        });
    }

    SLIDEWAY_HD void finish(int index, double time, Selection selected, double* row) const {
        Observer::finish(index, time, selected, row);
        double const mean = time > 0 ? 1 / time : 0;
        each([&]<int k>(Number<k>) {
            if ((selected & bit(k)) == 0) return;
            double const value = lane(kept_[k], index);
            row[Observer::columns + k] = !quantity<k>.integrates()                       ? value
                                         : quantity<k>.statistic == Statistic::mean ? value * mean
                                                                                       : sqrt(value * mean);
        });
    }

private:
    Real kept_[count > 0 ? count : 1];  // of a mean its integral
};

}  // namespace slideway::inline SLIDEWAY_ISA
