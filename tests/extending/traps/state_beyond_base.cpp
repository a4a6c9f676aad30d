// A mechanism with an eleventh number in its state, on a base that takes over how another one finds ten.
#include "kernels/laws/kelvin_voigt.hpp"
#include "kernels/laws/one_law.hpp"
#include "kernels/mechanisms/scotch_yoke.hpp"
#include "kernels/models/mechanism_model.hpp"

namespace slideway::inline SLIDEWAY_ISA {

struct OwnBase : SliderBase {
    static constexpr int size = 11;
};
template <> struct LanesOf<OwnBase> : SpatialLanes<OwnBase> {};
struct Turning : ScotchYoke {
    static constexpr MechanismInfo info = [] {
        auto info = ScotchYoke::info;
        info.states = 11;
        info.state[10] = Series::crank_angle;
        return info;
    }();
};

using Laws = OneLaw<KelvinVoigt, PointDamping>;
template struct MechanismModel<Turning, OwnBase, Laws>;

}  // namespace slideway::inline SLIDEWAY_ISA
