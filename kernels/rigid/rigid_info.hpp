// What contact.law = "rigid" is, for those who choose, check and describe it.  Plain data outside the ISA namespace: every unit may share it.
#pragma once

#include "kernels/laws/law_info.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"

namespace slideway {

/// In the place of a law: bodies that do not give way have no forces that a law could tell.
inline constexpr LawInfo rigid_contact{.name = "rigid",
                                       .words = "bodies that do not give way: impacts of no duration, constraints and Coulomb friction",
                                       .switches = false,
                                       .groups = groups_of(KeyGroup::restitution)};

/// Quantities of single impacts, which time stepping does not know.
inline constexpr Selection of_single_impacts = selections::of({Quantity::face_onsets, Quantity::impact_speeds});

/// Quantities that rigid contacts have not: the largest of forces that are impulses, and what follows from it; and the loss of an oil film, which they know not.
inline constexpr Selection without_rigid_contact =
    selections::of({Quantity::peak_normal_force, Quantity::peak_apex_force, Quantity::mean_apex_force, Quantity::peak_crank_torque,
                    Quantity::rms_crank_torque, Quantity::switching_energy, Quantity::peak_acceleration, Quantity::rms_acceleration,
                    Quantity::peak_channel_acceleration, Quantity::acceleration_area, Quantity::film_loss}) |
    (selections::force_quantities & ~of_single_impacts);

/// Quantities that they alone have.
inline constexpr Selection of_rigid_contact = selections::of({Quantity::capped_impacts});

/// Series that time stepping has not: it knows impulses of whole steps, and no forces of an instant.
inline constexpr Selection series_without_time_stepping =
    selections::of({Series::normal_force, Series::crank_torque, Series::surfaces, Series::lines, Series::points, Series::ax, Series::ay, Series::az,
                    Series::acceleration_top, Series::acceleration_front});

}  // namespace slideway
