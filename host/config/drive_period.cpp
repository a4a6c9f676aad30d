#include "host/config/drive_period.hpp"

#include "host/config/descriptors.hpp"
#include "kernels/members/drive_period.hpp"

namespace slideway {

double drive_period(Parts const& parts, Inputs const& inputs) {
    return drive_period(info(parts.mechanism), parts.free_crank, inputs);
}

double first_time_at(double phase, Parts const& parts, Inputs const& inputs) {
    return first_time_at(phase, info(parts.mechanism), parts.free_crank, inputs);
}

std::string why_no_period(Parts const& parts) {
    if (!parts.free_crank && info(parts.mechanism).drive != DriveKind::none) return "mechanism.crank_speed is 0";
    return std::string("nothing drives a ") + (parts.free_crank ? "free crank" : info(parts.mechanism).name);
}

}  // namespace slideway
