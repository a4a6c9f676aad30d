#include "host/backend/shared_joint.hpp"

namespace slideway::inline SLIDEWAY_ISA {

SLIDEWAY_JOINT_TEMPLATES()

}  // namespace slideway::inline SLIDEWAY_ISA
