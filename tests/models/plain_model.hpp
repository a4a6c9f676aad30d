#pragma once

#include "kernels/lanes/model.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/mechanisms/no_memory.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/no_watch.hpp"
#include "tests/models/event_recorder.hpp"
#include "tests/models/event_search.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What a small model of `components` states leaves at its plainest (kernels/lanes/model.hpp).
template <int components> struct PlainModel : ModelDefaults {
    static constexpr int size = components;
    static constexpr int series = components;
    static constexpr bool has_contacts = false;
    static constexpr bool has_patterns = false;
    static constexpr bool has_shadows = false;
    static constexpr bool has_crossings = false;
    static constexpr bool has_linearisation = false;
    template <class Real> struct Report {};
    template <class Real> using Memory = NoMemory<Real>;
    template <class Real> using Observer = EventRecorder<Real, 0, 0>;
    template <class Real> using Watch = NoWatch<Real>;
    template <class Model, class Real> using Search = EventSearch<Model, Real>;  // of models that state `events`

    /// Sizes against which the absolute tolerance is meant.
    template <class Parameters, class Real> SLIDEWAY_FN static void scales(Parameters const&, Real* scale) {
        for (int i = 0; i < size; ++i) scale[i] = Real(1.0);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
