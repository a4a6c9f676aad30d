// Loads on a mechanism, as a block has them: what acts where, and over what.  The numbers of a member are among its inputs, tables are the block's.
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
    int const* first = nullptr;  // [cells]: of equal parts of [low, high) the piece that holds the beginning
    int cells = 0;
    double cells_per_unit = 0;  // cells/(high − low)
};

/// Force and torque on the slider, or a torque on the crank.  Places are those of numbers among Inputs::load_a …; 0 where there is none.
struct Load {
    static constexpr int none = -1;

    char const* name = "";  // load.<name> of the scene
    int force[3] = {none, none, none};   // [N]
    int torque[3] = {none, none, none};  // [N m], beside that of the force about the slider's centre
    int point[3] = {none, none, none};   // where the force acts, in the slider's frame [m]
    int crank_torque = none;             // [N m], on the crank
    int scale = none;                    // of all that; 1 where there is none
    bool turns_with_slider = false;      // force and torque are along the slider's axes, not those of the ground
    LoadArgument over = LoadArgument::nothing;
    PieceTable table;  // what they are multiplied by
};

inline constexpr int most_load_numbers = 16;  // of all loads of a scene

struct LoadList {
    Load const* loads = nullptr;  // [count]
    int count = 0;

    friend bool operator==(LoadList const&, LoadList const&) = default;
};

}  // namespace slideway
