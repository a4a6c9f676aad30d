// How the members of a study are spread over the ranges of what varies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/sampling/distribution.hpp"
#include "kernels/key.hpp"

namespace slideway {

struct Variation {
    Key const* key;
    Distribution distribution;       // of a column of a table: unused
    int line;                        // of the scene file, for messages
    std::size_t column = no_column;  // of the table of members that holds its values
    static constexpr std::size_t no_column = std::numeric_limits<std::size_t>::max();
};

enum class DesignKind { mc, lhs, sobol, saltelli, grid, table };

inline constexpr std::string_view design_names[] = {"mc", "lhs", "sobol", "saltelli", "grid", "table"};
constexpr std::string_view name_of(DesignKind kind) { return design_names[static_cast<int>(kind)]; }

/// Members as a table says: values in SI units [rows][columns].
struct MemberTable {
    std::string path;
    std::uint64_t checksum = 0;  // FNV-1a of the file's bytes
    std::size_t columns = 0;
    std::vector<double> values;
    // Of a file; of rows from elsewhere there is none of them.
    std::string name;                 // for messages: "members.csv"
    std::vector<int> lines;           // [rows], from 1
    std::string labelled;             // headers of the columns of text: "part, lot"
    std::vector<std::string> labels;  // [rows] "A-001, 7"; none where there is no column of text
    std::size_t label_width = 0;      // bytes of the longest

    std::size_t rows() const { return columns == 0 ? 0 : values.size() / columns; }
};

/// Correlated variations: a normal copula.  x_i = Q_i(Φ(z_i)), z normal with this correlation matrix; for normal
/// marginals the matrix is that of the values themselves.  Of a Latin hypercube the strata of each variation stay and
/// change their order.
struct Correlation {
    std::vector<std::size_t> variations;  // indices into those of the scene
    std::vector<double> matrix;           // [n][n], symmetric, positive definite, ones on the diagonal
};

/// With d variations, u of member m for variation i, its value Q_i(u):
///   mc        Philox, keyed by seed, member and key name
///   lhs       (π_i(m) + v)/members: one member in each of `members` equal strata of every variation, in an order π_i
///             and at a place v that are random (McKay, Beckman & Conover, Technometrics 21 (1979) 239)
///   sobol     point m of Sobol's sequence, dimension i, scrambled by seed and key name; even in all variations at once
///             for 2^k members
///   saltelli  rows of d + 2 members from a point of 2d dimensions, A its first d, B its last: A, B, A with B's i-th
///             value for i = 1 … d (Saltelli et al., Comput. Phys. Commun. 181 (2010) 259, the matrices A_B)
///   grid      all combinations of the levels, the last variation fastest: entries of `values`, else
///             u = (l + 1/2)/levels[i]
///   table     row m of the table; variations that are no columns as mc
struct Design {
    DesignKind kind = DesignKind::mc;
    std::uint64_t base = 0;             // saltelli: N rows; the members are N (d + 2)
    std::vector<std::uint64_t> levels;  // grid: of each variation
    Correlation correlation;            // of none: empty
    std::shared_ptr<MemberTable const> table;
};

/// Memory that a sampler needs for so many members, while its first draw orders them: of a correlated Latin hypercube, else 0.
inline std::uint64_t design_bytes(Design const& design, std::uint64_t members) {
    std::size_t const keys = design.kind == DesignKind::lhs ? design.correlation.variations.size() : 0;
    return keys == 0 ? 0 : members * (20 + 4 * keys);
}

/// One limit of [study.limits]: met where low <= value <= high.
struct Limit {
    std::string quantity;  // name of the variable in the result file: "peak_normal_force", "mode_time"
    std::string label;     // along its dimension: "free" of "mode_time[free]"; "" where it has none
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    std::string name() const { return label.empty() ? quantity : quantity + "[" + label + "]"; }
};

/// Draws members of a design.  A member's values depend on the design, the seed and its number only: any member can be
/// drawn alone, on any thread or machine.  (Of a correlated Latin hypercube the first draw orders all.)
class Sampler {
public:
    /// @param members of the whole design (lhs stratifies over them).
    /// @throws SceneError without file and line if the design cannot have these variations or members: dimensions
    /// beyond Sobol's table, levels or rows that do not match, a correlation that is none or has no place in it.
    Sampler(Design const& design, std::span<Variation const> variations, std::uint64_t seed, std::uint64_t members);
    /// The value of each variation, SI, [variations].  From any thread.
    /// @param member below `members`; mc and sobol know no end.  @throws std::out_of_range beyond it,
    /// std::invalid_argument for another number of values.
    void draw(std::uint64_t member, std::span<double> values) const;

private:
    struct Plan;
    std::shared_ptr<Plan const> plan_;
};

/// Why a matrix is no correlation matrix, and what to do; nothing if it is one: |r| <= 1, ones on the diagonal,
/// symmetric, positive definite.  Rows and columns are counted from 1 in the text, "row 1, column 2 is 1.5 (…); …".
/// @param matrix [n][n].
std::optional<std::string> matrix_defect(std::span<double const> matrix, std::size_t n);

/// Lower triangular L with L Lᵀ = matrix, [n][n] with zeros above the diagonal.
/// @throws SceneError with the defect of a matrix that is no correlation matrix.
std::vector<double> cholesky_factor(std::span<double const> matrix, std::size_t n);

}  // namespace slideway
