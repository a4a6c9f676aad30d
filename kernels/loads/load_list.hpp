// What acts on a mechanism beside weight, contact and drive, as a block has it.  The numbers of a member are among its inputs, tables are the block's.
// Plain data outside the ISA namespace: every unit may share it.
#pragma once

namespace slideway {

/// What a table of a load is read over.
enum class LoadArgument { nothing, crank_angle, time, x, vx, crank_speed };

/// A function in pieces: value + u (slope + u (square + u (cube + u fourth))) of u beyond the beginning of a piece.  Memory that the host owns.
struct PieceTable {
    struct Piece { double from, value, slope, square, cube, fourth = 0; };

    Piece const* pieces = nullptr;  // [count], in the order of their beginnings
    int count = 0;
    double low = 0, high = 0;  // it goes from here to there: beyond them it repeats, or stays as it is at the nearer end
    bool repeats = false;
    double advance = 0;  // what it is larger by each time that it repeats
    // [cells + 1], of equal parts of [low, high]: the last piece that begins in an earlier one.  What is in a cell is in a piece from first[cell] to first[cell + 1].
    int const* first = nullptr;
    int cells = 0;
    double cells_per_unit = 0;  // cells/(high − low)
    bool is_even = false;       // pieces are as long as cells, and where these are

    /// The cell of a place within it: a whole number, once cut off.  Kernels count cells in the same way.
    constexpr double cell_of(double place) const {
        double const cell = (place - low) * cells_per_unit;
        return cell < cells - 1.0 ? cell : cells - 1.0;
    }
};

enum class LoadKind {
    push,           // force and torque on the slider, or a torque on the crank; on a body of a linkage, perhaps against another
    spring,         // from a point of the slider to one of the ground, or along X alone; of a linkage between points or angles of two bodies, or along a joint
    stop,           // pushes the slider back from a place along X; of a linkage along a joint, or from an angle between two bodies
    ground_motion,  // acceleration of the ground
    way_profile,    // faces of the way that are not straight
    way_ends,       // where the way begins and ends
    film,           // of lubricant, between the slider and its way
};

/// Places are those of numbers among Inputs::load_a …; 0 where there is none.
struct Load {
    static constexpr int none = -1;

    char const* name = "";  // load.<name> of the scene, spring.<name> …
    LoadKind kind = LoadKind::push;
    int force[3] = {none, none, none};  // [N]; of the ground its acceleration [m/s²]
    int point[3] = {none, none, none};  // where it acts, in the slider's frame [m]
    // of a push
    int torque[3] = {none, none, none};  // [N m], beside that of the force about the slider's centre
    int crank_torque = none;             // [N m], on the crank, or on a linkage's body
    bool turns_with_slider = false;      // force and torque are along the axes of the slider or body, not those of the ground
    // of a push, and of the ground's acceleration
    int scale = none;  // of all that; 1 where there is none
    LoadArgument over = LoadArgument::nothing;
    PieceTable table;  // what they are multiplied by
    // of a spring or a stop
    int anchor[3] = {none, none, none};  // where it is held on the ground [m]; of a stop x alone counts
    int stiffness = none;                // [N/m]
    int damping = none;                  // [N s/m]
    int rest_length = none;              // of a spring [m]
    int preload = none;                  // its tension at this length [N]
    int dissipation = none;              // of a stop [s/m]: its stiffness times 1 + this times the speed of the approach
    bool along = false;                  // a spring that has its force along X alone, and its length
    double side = 1;                     // of a stop: it blocks the way to larger x; −1 to smaller
    int faces = 0;                       // of a way's profile: bit i where face i has it, Y+, Y−, Z+, Z−
    double steepest = 0;                 // and its slope, before its scale
    int from = none, to = none;          // of a way's ends: x of them [m]
    // of what acts on a linkage: bodies of its plan, −1 the ground
    int body[2] = {none, none};  // it acts on the first, in whose axes its point is, and the other way on the second, in whose axes its anchor is
    int coordinate = none;       // of a spring or stop along a prismatic joint: its displacement
    int closure = none;          // of one along a block's walls
    bool turns = false;          // a spring or stop of the angle of the first body against the second
    int angle = none;            // where that has its preload, or where the stop is touched [rad]
    int angular_stiffness = none;    // [N m/rad]
    int angular_damping = none;      // [N m s/rad]
    int angular_preload = none;      // torque at that angle [N m]
    int angular_dissipation = none;  // [s/rad]
    // of a film
    int viscosity = none;            // [Pa s]
    int least_gap = none;            // a narrower one counts as this [m]
    int cavitation_pressure = none;  // how far below the ambient pressure it goes before it breaks [Pa]
};

inline constexpr double most_profile_slope = 0.05;  // beyond it the slip is not along the way any more (model.md 18)
inline constexpr int most_load_numbers = 26;  // of all loads of a scene

struct LoadList {
    Load const* loads = nullptr;  // [count]
    int count = 0;

    /// The first of a kind; nullptr where there is none.
    constexpr Load const* find(LoadKind kind) const {
        for (int i = 0; i < count; ++i) {
            if (loads[i].kind == kind) return &loads[i];
        }
        return nullptr;
    }
    friend bool operator==(LoadList const&, LoadList const&) = default;
};

}  // namespace slideway
