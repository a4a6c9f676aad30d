#include "host/scene/integrator_keys.hpp"

#include <algorithm>
#include <cmath>

namespace slideway {

double fixed_steps(IntegratorSettings const& settings) {
    // The kernels stretch the last step by up to a millionth rather than leave a crumb.
    return std::max(1.0, std::ceil(settings.end_time / settings.fixed_step - 1e-6));
}

}  // namespace slideway
