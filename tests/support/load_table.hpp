// Loads for tests that run members without a scene: a table of straight pieces, and loads whose numbers are given in the order of their places.
#pragma once

#include <cstddef>
#include <vector>

#include "kernels/inputs.hpp"

namespace slideway::testing {

/// A table of given pieces, which it owns.
class Pieces {
public:
    Pieces(std::vector<PieceTable::Piece> pieces, double high, bool repeats = false, int cells = 7) : pieces_(std::move(pieces)), first_(static_cast<std::size_t>(cells)) {
        table_.pieces = pieces_.data(), table_.count = static_cast<int>(pieces_.size());
        table_.low = pieces_.front().from, table_.high = high, table_.repeats = repeats;
        table_.cells = cells, table_.cells_per_unit = cells / (high - table_.low);
        for (int i = 0; i < cells; ++i) {
            double const begin = table_.low + i / table_.cells_per_unit;
            int& piece = first_[static_cast<std::size_t>(i)];
            for (piece = 0; piece + 1 < table_.count && pieces_[static_cast<std::size_t>(piece + 1)].from <= begin;) ++piece;
        }
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
