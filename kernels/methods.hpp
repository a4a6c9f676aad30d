// How a member is integrated: the choices of `integrator.method`.
#pragma once

namespace slideway {

enum class Method { automatic, dopri5, dop853, bs32, ros34pw2, rk4, verner65, moreau_jean };

struct MethodInfo {
    char const* name;
    char const* description;
};

inline constexpr MethodInfo method_table[] = {
    {"auto", "explicit pair in flight and impacts, ros34pw2 where lasting contact makes a member stiff"},
    {"dopri5", "Dormand-Prince 5(4); the explicit pair of auto wherever bs32 is not"},
    {"dop853", "Dormand-Prince 8(5,3): for smooth motion at tight tolerances; contacts gain nothing"},
    {"bs32", "Bogacki-Shampine 3(2); the explicit pair of auto from rtol 1e-5 on with restitution, or where steps leap over jumps of the force"},
    {"ros34pw2", "Rosenbrock W-method 3(2) alone: for lasting contact, it loses energy in impacts"},
    {"rk4", "classical Runge-Kutta with the fixed step integrator.step"},
    {"verner65", "Verner 6(5) with steps that end where contacts begin and end, and a clock within them: for impacts"},
    {"moreau_jean", "Moreau and Jean's time stepping with the fixed step integrator.step: for contact.law \"rigid\", where contacts are many"},
};
inline constexpr int method_count = sizeof(method_table) / sizeof(method_table[0]);

/// Methods of the fixed step `integrator.step`, without error control.
constexpr bool has_fixed_step(Method method) { return method == Method::rk4 || method == Method::moreau_jean; }

/// Methods that do not notice when they fail: those of a fixed step have no error control, and that of ros34pw2 does not see what an impact loses.
/// Their members carry the energy audit along whether or not it is asked for, so that their status can tell.
constexpr bool is_always_audited(Method method) { return method == Method::ros34pw2 || has_fixed_step(method); }

/// Explicit Runge-Kutta methods with error control.
constexpr bool is_explicit_pair(Method method) {
    return method == Method::dopri5 || method == Method::dop853 || method == Method::bs32 || method == Method::verner65;
}

/// Whether the explicit pair of `auto` is bs32: at loose tolerances it beats dopri5 (integrators.md), but for steps within which forces are smooth.
constexpr bool auto_takes_bs32(double rtol, bool smooth_within) { return rtol >= 1e-5 && !smooth_within; }

constexpr char const* name_of(Method method) { return method_table[static_cast<int>(method)].name; }

}  // namespace slideway
