#include "host/sampling/design.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/sampling/distribution.hpp"
#include "host/sampling/random.hpp"
#include "host/sampling/sobol_points.hpp"

namespace slideway {

namespace {

[[noreturn]] void refuse_design(DesignKind kind, std::string const& why, std::string const& advice) {
    throw SceneError(fmt::format("study.design is \"{}\" ({}); {}", name_of(kind), why, advice));
}

[[noreturn]] void refuse_members(std::uint64_t members, std::string const& why, std::string const& advice) {
    throw SceneError(fmt::format("study.members is {} ({}); {}", members, why, advice));
}

/// Directions for `axes` dimensions of each variation.
std::vector<SobolAxis::Directions> directions_for(DesignKind kind, std::size_t variations, std::size_t axes) {
    if (variations * axes > sobol_dimensions()) {
        refuse_design(kind,
                      fmt::format("{} variations are more than the {} that there are direction numbers for", variations,
                                  sobol_dimensions() / axes),
                      "use \"lhs\" or \"mc\"");
    }
    return sobol_directions(variations * axes);
}

/// Members between two levels of each variation, the last one's next to each other.
std::vector<std::uint64_t> grid_strides(std::span<Variation const> variations, std::span<std::uint64_t const> levels,
                                        std::uint64_t members) {
    if (levels.size() != variations.size()) {
        refuse_design(DesignKind::grid, fmt::format("{} levels for {} variations", levels.size(), variations.size()),
                      "give each variation its levels");
    }
    std::vector<std::uint64_t> strides(levels.size());
    std::uint64_t product = 1;
    for (std::size_t i = levels.size(); i-- > 0;) {
        Distribution const& distribution = variations[i].distribution;
        std::string const name(variations[i].key->name);
        if (levels[i] == 0 || product > std::numeric_limits<std::uint64_t>::max() / levels[i]) {
            refuse_design(DesignKind::grid, fmt::format("{} has {} levels", name, levels[i]),
                          "use at least 1, and fewer than 2^64 combinations");
        }
        if (distribution.kind == Distribution::Kind::values && levels[i] != distribution.list.size()) {
            refuse_design(DesignKind::grid,
                          fmt::format("{} has {} levels and {} values", name, levels[i], distribution.list.size()),
                          "use as many levels as values");
        }
        strides[i] = product;
        product *= levels[i];
    }
    if (members != product) {
        refuse_members(members, fmt::format("the grid has {} combinations of levels", product), "use that number");
    }
    return strides;
}

void check_table(Design const& design, std::span<Variation const> variations, std::uint64_t members) {
    if (design.table == nullptr) refuse_design(design.kind, "there is no table", "give study.table");
    if (members > design.table->rows()) {
        refuse_members(members, fmt::format("{} has {} rows", design.table->path, design.table->rows()),
                       "use at most that number");
    }
    for (Variation const& variation : variations) {
        if (variation.column != Variation::no_column && variation.column >= design.table->columns) {
            refuse_design(design.kind, fmt::format("{} has no column for {}", design.table->path, variation.key->name),
                          "add the column");
        }
    }
}

void check_correlation(Design const& design, std::span<Variation const> variations, std::uint64_t members) {
    if (design.kind == DesignKind::lhs && members > std::numeric_limits<std::uint32_t>::max()) {
        refuse_members(members, "of a correlated Latin hypercube all are ordered at once",
                       "use fewer than 2^32, or \"mc\"");
    }
    if (design.kind == DesignKind::saltelli || design.kind == DesignKind::grid) {
        refuse_design(design.kind, "its members do not follow study.correlation",
                      "remove the correlation, or use \"mc\", \"lhs\" or \"sobol\"");
    }
    std::vector<char> seen(variations.size());
    for (std::size_t const index : design.correlation.variations) {
        if (index >= variations.size() || seen[index] != 0) {
            throw SceneError("study.correlation names a key that does not vary, or names it twice; remove it");
        }
        seen[index] = 1;
        if (design.kind == DesignKind::table && variations[index].column != Variation::no_column) {
            throw SceneError(
                fmt::format("study.correlation names {} (a column of the table says its values); remove it",
                            variations[index].key->name));
        }
    }
}

// ---- correlation matrices, and orders that follow one ----

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Nothing if the matrix is not positive definite.
std::optional<Matrix> factor(std::span<double const> matrix, std::size_t n) {
    auto const size = static_cast<Eigen::Index>(n);
    Matrix const given = Eigen::Map<Matrix const>(matrix.data(), size, size);
    Eigen::LLT<Matrix> const cholesky(given);
    if (cholesky.info() != Eigen::Success) return {};
    Matrix lower = cholesky.matrixL();
    // A pivot of the size of its own rounding error: singular.
    double const least = std::numeric_limits<double>::epsilon() * static_cast<double>(n);
    for (Eigen::Index i = 0; i < size; ++i) {
        if (!(lower(i, i) * lower(i, i) > least)) return {};
    }
    return lower;
}

/// What makes of columns of scores others with the matrix L Lᵀ: L Q⁻¹, Q Qᵀ the matrix that they have by chance.
/// @param factor L.  @return L itself where so few members leave Q singular.
Matrix mixing(std::span<std::vector<std::uint32_t> const> orders, std::span<double const> score,
              std::span<double const> factor) {
    auto const size = static_cast<Eigen::Index>(orders.size());
    Matrix const own = Matrix::NullaryExpr(size, size, [&](Eigen::Index i, Eigen::Index j) {
        auto const &a = orders[static_cast<std::size_t>(i)], &b = orders[static_cast<std::size_t>(j)];
        return std::transform_reduce(a.begin(), a.end(), b.begin(), 0.0, std::plus<>(),
                                     [&](std::uint32_t p, std::uint32_t q) { return score[p] * score[q]; });
    });
    Matrix wanted = Eigen::Map<Matrix const>(factor.data(), size, size);
    Eigen::LLT<Matrix> const cholesky(own);
    Matrix const lower = cholesky.matrixL();
    // Columns that follow from others leave a pivot of the size of rounding.
    constexpr double least_pivot = 1e-6;
    bool const singular =
        cholesky.info() != Eigen::Success || !(lower.diagonal().minCoeff() > least_pivot * lower(0, 0));
    if (singular) return wanted;
    return lower.transpose().triangularView<Eigen::Upper>().solve(wanted.transpose()).transpose();
}

std::string at(std::size_t row, std::size_t column) { return fmt::format("row {}, column {}", row + 1, column + 1); }

/// Reorders columns so that they correlate, and no value of any column changes: those of the scores Φ⁻¹((rank + 1)/(members + 1)) then have
/// this matrix to within 1/members or so, for their own chance correlations are taken out first (Iman & Conover, Commun. Stat. Simul.
/// Comput. 11 (1982) 311).  So few members that these are singular keep them.  Of the first column the order stays.
/// Memory: 20 bytes a member beside the orders.
/// @param orders [n][members], each a permutation of 0 … members − 1: the ranks of its members.
/// @param factor [n][n], lower triangular: of the matrix, by cholesky_factor.
void correlate_orders(std::span<std::vector<std::uint32_t>> orders, std::span<double const> factor) {
    if (orders.empty()) return;
    std::size_t const members = orders[0].size();
    std::vector<double> score(members), mixed(members);
    for (std::size_t i = 0; i < members; ++i)
        score[i] = standard_normal_quantile(static_cast<double>(i + 1) / static_cast<double>(members + 1));
    Matrix const mix = mixing(orders, score, factor);
    std::vector<std::uint32_t> sorted(members);
    for (std::size_t row = orders.size(); row-- > 0;) {  // in place: row i needs the orders 0 … i only
        std::fill(mixed.begin(), mixed.end(), 0.0);
        for (std::size_t column = 0; column <= row; ++column) {
            double const weight = mix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
            for (std::size_t m = 0; m < members; ++m) mixed[m] += weight * score[orders[column][m]];
        }
        std::iota(sorted.begin(), sorted.end(), 0u);
        std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
            return mixed[a] < mixed[b] || (mixed[a] == mixed[b] && a < b);
        });
        for (std::size_t rank = 0; rank < members; ++rank) orders[row][sorted[rank]] = static_cast<std::uint32_t>(rank);
    }
}

}  // namespace

struct Sampler::Plan {
    DesignKind kind;
    std::uint64_t members;
    std::vector<Variation> variations;
    std::vector<StreamKey> keys;         // [variations]
    std::vector<Permutation> orders;     // lhs, [variations]
    std::vector<SobolAxis> axes;         // sobol [variations], saltelli [2][variations]: A, B
    std::vector<std::uint64_t> levels;   // grid, [variations]
    std::vector<std::uint64_t> strides;  // grid, [variations]: members between two levels
    std::shared_ptr<MemberTable const> table;
    std::vector<std::size_t> correlated;  // indices of variations
    std::vector<char> is_correlated;      // [variations]
    std::vector<double> factor;           // [correlated][correlated], lower triangular
    // lhs, of correlated variations: the strata of all members, made by the first draw.
    mutable std::once_flag ordered;
    mutable std::vector<std::vector<std::uint32_t>> strata;  // [variations][members]

    void check_member(std::uint64_t member) const {
        bool const endless = kind == DesignKind::mc || kind == DesignKind::sobol;
        if (!endless && member >= members) throw std::out_of_range("Sampler: the design has no such member");
    }
    void order_strata() const {
        std::vector<std::vector<std::uint32_t>> made;
        for (std::size_t const index : correlated) {
            auto& column = made.emplace_back(members);
            for (std::uint64_t m = 0; m < members; ++m) column[m] = static_cast<std::uint32_t>(orders[index](m));
        }
        correlate_orders(made, factor);
        strata.resize(variations.size());
        for (std::size_t i = 0; i < made.size(); ++i) strata[correlated[i]] = std::move(made[i]);
    }
    /// Of a Latin hypercube.
    std::uint64_t stratum(std::size_t variation, std::uint64_t member) const {
        return is_correlated[variation] != 0 ? strata[variation][member] : orders[variation](member);
    }
    /// u of a variation, in (0, 1).
    double fraction(std::size_t variation, std::uint64_t member) const {
        switch (kind) {
            case DesignKind::lhs: {
                // Rounding must not take the last stratum to 1, where quantiles may be infinite.
                double const place =
                    static_cast<double>(stratum(variation, member)) + keys[variation].uniform(Stream::jitter, member);
                return std::clamp(place / static_cast<double>(members), 0x1p-53, 1 - 0x1p-53);
            }
            case DesignKind::sobol:
                return axes[variation](member);
            case DesignKind::saltelli: {
                std::size_t const n = variations.size();
                std::uint64_t const part = member % (n + 2);
                bool const second = part == 1 || part == 2 + variation;
                return axes[second ? n + variation : variation](member / (n + 2));
            }
            case DesignKind::grid: {
                std::uint64_t const level = member / strides[variation] % levels[variation];
                return (static_cast<double>(level) + 0.5) / static_cast<double>(levels[variation]);
            }
            case DesignKind::mc:
            case DesignKind::table:
                break;
        }
        return keys[variation].uniform(Stream::value, member);
    }
    double value(std::size_t variation, std::uint64_t member) const {
        Variation const& varied = variations[variation];
        if (kind == DesignKind::table && varied.column != Variation::no_column) {
            return table->values[member * table->columns + varied.column];
        }
        return varied.distribution.quantile(fraction(variation, member));
    }
    /// z = L Φ⁻¹(u), each row in place from the last to the first: row i needs the Φ⁻¹ of rows 0 … i only.
    void correlate(std::uint64_t member, std::span<double> values) const {
        std::size_t const n = correlated.size();
        for (std::size_t const index : correlated) values[index] = standard_normal_quantile(fraction(index, member));
        for (std::size_t row = n; row-- > 0;) {
            double z = 0;
            for (std::size_t column = 0; column <= row; ++column)
                z += factor[row * n + column] * values[correlated[column]];
            values[correlated[row]] = variations[correlated[row]].distribution.from_standard_normal(z);
        }
    }
};

Sampler::Sampler(Design const& design, std::span<Variation const> variations, std::uint64_t seed,
                 std::uint64_t members) {
    auto const plan = std::make_shared<Plan>();
    std::size_t const n = variations.size();
    plan->kind = design.kind;
    plan->members = members;
    plan->variations.assign(variations.begin(), variations.end());
    for (Variation const& variation : variations) plan->keys.push_back({seed, name_hash(variation.key->name)});
    switch (design.kind) {
        case DesignKind::mc:
            break;
        case DesignKind::lhs:
            for (StreamKey const& key : plan->keys) plan->orders.emplace_back(members, key);
            break;
        case DesignKind::saltelli:
            if (members != design.base * (n + 2)) {
                refuse_members(
                    members,
                    fmt::format("{} rows of {} variations are {} members", design.base, n, design.base * (n + 2)),
                    "use that number");
            }
            [[fallthrough]];
        case DesignKind::sobol: {
            bool const both = design.kind == DesignKind::saltelli;
            auto const directions = directions_for(design.kind, n, both ? 2 : 1);
            for (std::size_t axis = 0; axis < directions.size(); ++axis) {
                Stream const stream = axis < n ? Stream::scramble : Stream::second_scramble;
                plan->axes.emplace_back(directions[axis], plan->keys[axis % n], stream);
            }
            break;
        }
        case DesignKind::grid:
            plan->strides = grid_strides(variations, design.levels, members);
            plan->levels = design.levels;
            break;
        case DesignKind::table:
            check_table(design, variations, members);
            plan->table = design.table;
            break;
    }
    plan->is_correlated.resize(n);
    if (!design.correlation.variations.empty()) {
        check_correlation(design, variations, members);
        plan->correlated = design.correlation.variations;
        for (std::size_t const index : plan->correlated) plan->is_correlated[index] = 1;
        plan->factor = cholesky_factor(design.correlation.matrix, plan->correlated.size());
    }
    plan_ = plan;
}
void Sampler::draw(std::uint64_t member, std::span<double> values) const {
    if (values.size() != plan_->variations.size()) throw std::invalid_argument("Sampler: one value per variation");
    plan_->check_member(member);
    bool const stratified = plan_->kind == DesignKind::lhs;
    if (!stratified) {
        plan_->correlate(member, values);
    } else if (!plan_->correlated.empty()) {
        std::call_once(plan_->ordered, [this] { plan_->order_strata(); });
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (stratified || plan_->is_correlated[i] == 0) values[i] = plan_->value(i, member);
    }
}

std::optional<std::string> matrix_defect(std::span<double const> matrix, std::size_t n) {
    if (matrix.size() != n * n) {
        return fmt::format("it has {} entries (a matrix of {} variables has {}); write {} rows of {}", matrix.size(), n,
                           n * n, n, n);
    }
    for (std::size_t i = 0; i < n; ++i) {
        if (matrix[i * n + i] != 1) {
            return fmt::format("{} is {} (each value follows itself); write 1 on the diagonal", at(i, i),
                               matrix[i * n + i]);
        }
        for (std::size_t j = 0; j < n; ++j) {
            double const r = matrix[i * n + j];
            if (!(std::abs(r) <= 1)) {
                return fmt::format("{} is {} (a correlation lies in [-1, 1]); use a value between", at(i, j), r);
            }
            if (r != matrix[j * n + i]) {
                return fmt::format("{} is {}, {} is {} (the matrix is symmetric); give both the same value", at(i, j),
                                   r, at(j, i), matrix[j * n + i]);
            }
        }
    }
    if (n > 0 && !factor(matrix, n)) {
        return std::string(
            "it is not positive definite (no variables have such correlations, or one follows from the others); "
            "use weaker correlations");
    }
    return {};
}

std::vector<double> cholesky_factor(std::span<double const> matrix, std::size_t n) {
    if (auto const defect = matrix_defect(matrix, n)) throw SceneError(fmt::format("correlation: {}", *defect));
    std::vector<double> lower(n * n);
    if (n == 0) return lower;
    Matrix const found = *factor(matrix, n);
    std::copy(found.data(), found.data() + n * n, lower.begin());
    return lower;
}

}  // namespace slideway
