#include "host/study/noise_floor.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/config/descriptors.hpp"
#include "host/statistics/summary.hpp"
#include "host/study/verification.hpp"

namespace slideway {
namespace {

constexpr double relative_error = 1e-6;  // the default rtol

}  // namespace

double least_energy(Scene const& scene) { return relative_error * fall_energy(scene); }

double error_of_column(QuantityColumn const& column, std::span<double const> values, Scene const& scene) {
    double scale = column.unit == "J" ? fall_energy(scene) : 0;
    for (double const x : values) scale = std::fmax(scale, std::abs(x));
    return relative_error * scale;
}

std::string why_no_sensitivity(QuantityColumn const& column, std::span<double const> values, Scene const& scene) {
    Summary const summary = summarise(values);
    if (summary.count < 2) return "";
    if (summary.min == summary.max) return "does not vary";
    if (column.quantity == "energy_residual" && !makes_energy(scene.parts)) return "is the integration's error";
    double const error = error_of_column(column, values, scene);
    if (!(summary.sd <= error)) return "";
    std::string const unit = column.unit == "1" ? "" : " " + column.unit;
    return fmt::format("varies by {:.2g}{}, no more than its error of {:.2g}{}", summary.sd, unit, error, unit);
}

}  // namespace slideway
