#pragma once

namespace slideway {

/// One of the pairs whose gap may be asked for.
struct Apex {
    bool z_faces;  // against the Z face on its side, else the Y face; of the planar slider without meaning
    int index;     // P1…P8 from 0; a…d from 0 of the planar slider's corners
};

}  // namespace slideway
