// Loads for tests that run members without a scene: a table of straight pieces, and loads whose numbers are given in the order of their places.
#pragma once

#include <cstddef>
#include <vector>

#include "host/config/piece_function.hpp"
#include "kernels/inputs.hpp"

namespace slideway::testing {

/// A table of given pieces, which it owns.
class Pieces {
public:
    Pieces(std::vector<PieceTable::Piece> pieces, double high, bool repeats = false, int cells = 7) : pieces_(std::move(pieces)) {
        table_.pieces = pieces_.data(), table_.count = static_cast<int>(pieces_.size());
        table_.low = pieces_.front().from, table_.high = high, table_.repeats = repeats;
        table_.cells = cells, table_.cells_per_unit = cells / (high - table_.low);
        first_ = first_pieces(pieces_, table_);
        table_.first = first_.data();
    }
    Pieces(Pieces const&) = delete;
    Pieces& operator=(Pieces const&) = delete;

    PieceTable const& table() const { return table_; }

private:
    std::vector<PieceTable::Piece> pieces_;
    std::vector<int> first_;
    PieceTable table_;
};

/// Puts a number at a place, and says which.
inline int put_load_number(Inputs& inputs, int& next, double value) {
    inputs.*load_inputs[next] = value;
    return next++;
}

}  // namespace slideway::testing
