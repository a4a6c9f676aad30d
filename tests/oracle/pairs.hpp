// The sixteen apex-face pairs of the joint, in way coordinates, and how apices, faces and lines belong together.
#pragma once

#include <array>

#include "mechanism.hpp"

namespace oracle::detail {

// Table 2: apices, faces, boundary lines.
struct Apex {
    int s1, s2, s3;  // along Y, Z, X
};
inline constexpr Apex apices[8] = {{+1, +1, +1}, {-1, +1, +1}, {-1, -1, +1}, {+1, -1, +1},
                                   {+1, +1, -1}, {-1, +1, -1}, {-1, -1, -1}, {+1, -1, -1}};

enum class Run { along_x, across };
struct Edge {
    int p, q;  // numbers of the apices at its ends, 1..8
    Run run;
};
struct FaceOfWay {
    int axis;  // 1: Y, 2: Z
    int side;
    int corners[4];
    Edge edges[4];
};
inline constexpr FaceOfWay faces_of_way[face_count] = {
    {1, +1, {1, 4, 8, 5}, {{1, 4, Run::across}, {4, 8, Run::along_x}, {8, 5, Run::across}, {5, 1, Run::along_x}}},
    {1, -1, {2, 3, 7, 6}, {{2, 3, Run::across}, {3, 7, Run::along_x}, {7, 6, Run::across}, {6, 2, Run::along_x}}},
    {2, +1, {1, 2, 6, 5}, {{1, 2, Run::across}, {2, 6, Run::along_x}, {6, 5, Run::across}, {5, 1, Run::along_x}}},
    {2, -1, {4, 3, 7, 8}, {{4, 3, Run::across}, {3, 7, Run::along_x}, {7, 8, Run::across}, {8, 4, Run::along_x}}}};

struct Pair {
    int side = 0;
    Vector3 normal;  // of the slider's face, outward for side +1
    Vector3 arm;     // ρ, from the slider's centre
    Real depth = 0;  // δ
    Real rate = 0;   // δ'
    Real opens = 0;  // h' of the way's face there
    bool stays = false;  // the apex is at the way's end, and does not run along with the slider
    Vector3 slip;    // v_t
    Real impact_speed = 0;
    Real elastic = 0, force = 0;
};
using PairTable = std::array<std::array<Pair, 8>, 3>;  // [axis 1 or 2][apex]

/// Depths, rates and slips; no forces yet.  @param impact_speeds v0 [m/s], the start value 1e-4 where null; never
/// taken below it.
PairTable pairs_of(Inputs const& in, Parts const& parts, SliderMotion const& motion, Matrix4 const& way, Pairs const* impact_speeds);

}  // namespace oracle::detail
