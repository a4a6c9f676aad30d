// A base that does not say where its state stands among the series.
#include "kernels/laws/kelvin_voigt.hpp"
#include "kernels/laws/one_law.hpp"
#include "kernels/mechanisms/scotch_yoke.hpp"
#include "kernels/models/mechanism_model.hpp"

namespace slideway::inline SLIDEWAY_ISA {

struct OwnBase {
    static constexpr int size = 10;
};
template <> struct LanesOf<OwnBase> : SpatialLanes<OwnBase> {};

using Laws = OneLaw<KelvinVoigt, PointDamping>;
template struct MechanismModel<ScotchYoke, OwnBase, Laws>;

}  // namespace slideway::inline SLIDEWAY_ISA
