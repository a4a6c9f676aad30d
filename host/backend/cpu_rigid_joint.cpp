// The contacts of rigid joints, whatever guides their sliders, of numbers and of numbers with slopes: compiled once per instruction set, and part of
// each module of a mechanism that has them (cpu_rigid.cpp).
#include "kernels/isa_real.hpp"
#include "kernels/rigid/joint_offset.hpp"
#include "kernels/rigid/rigid_joint.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template class JointPairs<IsaReal>;
template class JointPairs<Tangent<IsaReal>>;
template class RigidJoint<IsaReal>;
template class RigidJoint<Tangent<IsaReal>>;
template class JointOffset<IsaReal>;

}  // namespace slideway::inline SLIDEWAY_ISA
