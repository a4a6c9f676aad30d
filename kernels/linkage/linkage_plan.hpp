// How a linkage hangs together, as a block has it: the same for all members.  The numbers of a member are among its inputs.
// Plain data outside the ISA namespace: every unit may share it.
#pragma once

#include <type_traits>

#include "kernels/inputs.hpp"

namespace slideway {

/// How a body hangs on the one below it in the tree that carries the linkage; where joints close loops, all but those of the tree are closures.
enum class TreeJoint {
    revolute,   // one coordinate, the body's absolute angle
    prismatic,  // one, the displacement along a line of the body below, with whose angle it turns
    floating,   // three, the place of its mass centre and its absolute angle
};

/// How far a scene lets a point of a body be from its body's origin: not at all, along its X axis, anywhere.
enum class Arm { none, along_x, any };

/// Places are those of numbers among Inputs::linkage_0 …; `none` where a number is not given, which then is 0.  A plan is made of ints alone, and compared
/// and written down as such.
struct LinkageBody {
    static constexpr int none = -1, ground = -1;

    int parent = ground;  // below it in the tree
    TreeJoint joint = TreeJoint::floating;
    int coordinate = 0;  // the first of its own
    int mass = none, inertia = none;  // [kg], about its mass centre [kg m²]
    int center[2] = {none, none};     // mass centre, in the body's own axes [m]
    int on_parent[2] = {none, none}, own[2] = {none, none};  // the joint's point, in the axes of either [m]
    int direction = none;  // of the line that a prismatic joint leads along, from the X axis of the body below [rad]
    int turn = none;       // angle of its body against that one [rad]
    Arm arm = Arm::any;     // of the joint's point on the body below
    Arm moment = Arm::any;  // of the mass centre, and of what hangs on it by revolutes
    int is_point = 0;  // 1: all that it carries is at its joint: nothing asks where its axes point
    int angle = none, speed = none;  // where Newton's method looks for its start [rad], [rad/s]; of a prismatic joint [m], [m/s]
};

/// What a joint is that is none of the tree's.
enum class ClosureKind {
    pin,      // without clearance: it closes a loop
    journal,  // of one body, in the bearing of another
    block,    // of one body, between two walls of another
};

struct LinkageClosure {
    static constexpr int none = LinkageBody::none;

    ClosureKind kind = ClosureKind::pin;
    int body[2] = {LinkageBody::ground, LinkageBody::ground};  // that of the journal or block, and that of the bearing or walls
    int point[2][2] = {{none, none}, {none, none}};            // centres, in the axes of either; of walls a point in their middle [m]
    Arm arm[2] = {Arm::any, Arm::any};     // of these
    int is_level = 0;                      // 1: walls along the ground's X axis
    int pair = 0;                          // its first among the pairs that touch: a journal is one, a block's corners are four
    int clearance = none;                  // difference of the radii, or a block's on each side [m]
    int radius = none;                     // of the bearing [m]
    int length = none, height = none;      // of a block [m]
    int direction = none;                  // of the walls, against the X axis of their body [rad]
    int stiffness = none;                  // K [N/m^n]; none: of a journal that of spheres of these radii, of a corner that of the apex radius
    int offset[2] = {none, none};          // at the start: of a journal in its bearing, along X and Y [m]; of a block across its walls [m], and its tilt [rad]

    constexpr bool has_clearance() const { return kind != ClosureKind::pin; }
    constexpr int pairs() const { return kind == ClosureKind::block ? 4 : kind == ClosureKind::journal ? 1 : 0; }
};

/// Why a linkage does not go together at the start: a joint stays open, or holds what others hold.
enum class AssemblyFault { none, open, redundant };

struct LinkagePlan {
    static constexpr int most_bodies = 8, most_coordinates = most_linkage_coordinates, most_closures = 8, most_loops = 3, most_pairs = 8, most_loads = 8;
    static constexpr int most_states = 2 * most_coordinates;

    int bodies = 0, coordinates = 0, closures = 0;
    LinkageBody body[most_bodies];  // in an order in which each stands behind the one that it hangs on
    LinkageClosure closure[most_closures];
    int above[most_coordinates] = {};  // of a coordinate the next one towards the ground; −1 where there is none
    int owner[most_coordinates] = {};  // the body that a coordinate is of
    int is_driven = 0;                 // 1: coordinate 0 is the angle of the crank
    // Of a plan that the compiler is to know, 1: the crank turns by a torque or none, and something acts beside weight, drive and joints.
    int turns_freely = 0, is_loaded = 0;

    constexpr int states() const { return 2 * coordinates; }
    /// How many of the closures are loops without clearance.
    constexpr int loops() const {
        int count = 0;
        for (int i = 0; i < closures; ++i) count += closure[i].has_clearance() ? 0 : 1;
        return count;
    }
    constexpr bool has_clearance() const { return loops() < closures; }
    /// Whether a coordinate is an angle; else a length.
    constexpr bool is_angle(int coordinate) const {
        LinkageBody const& of = body[owner[coordinate]];
        return of.joint == TreeJoint::revolute || (of.joint == TreeJoint::floating && coordinate == of.coordinate + 2);
    }
};
static_assert(std::has_unique_object_representations_v<LinkagePlan>);

}  // namespace slideway
