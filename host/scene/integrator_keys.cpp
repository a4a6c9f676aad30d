#include "host/scene/integrator_keys.hpp"

#include <algorithm>
#include <cmath>

namespace slideway {

bool has_effect(std::string_view key, Method method, MechanismInfo const& mechanism) {
    bool const of_faces = key == "stiff_tolerance" || key == "stiff_max_step" || key == "locate_modes";
    if (of_faces && !mechanism.spatial) return false;
    bool const fixed = method == Method::rk4;
    if (key == "step") return fixed;
    if (key == "rtol" || key == "atol" || key == "max_step") return !fixed;
    if (key == "stiff_tolerance" || key == "stiff_max_step") {
        return method == Method::automatic || method == Method::ros34pw2;
    }
    if (key == "locate_modes") return !fixed && method != Method::ros34pw2;
    return true;
}

double fixed_steps(IntegratorSettings const& settings) {
    // The kernels stretch the last step by up to a millionth rather than leave a crumb.
    return std::max(1.0, std::ceil(settings.end_time / settings.fixed_step - 1e-6));
}

}  // namespace slideway
