#include "host/sampling/distribution_forms.hpp"

#include <iterator>

namespace slideway {
namespace {

using D = Distribution;
using Argument = DistributionArgument;

constexpr Argument value_of_constant[] = {{"value", &D::mean}};
constexpr Argument ends[] = {{"low", &D::low}, {"high", &D::high}};
constexpr Argument corners[] = {{"low", &D::low}, {"mode", &D::mode}, {"high", &D::high}};
constexpr Argument moments[] = {{"mean", &D::mean}, {"sd", &D::sd}};
constexpr Argument moments_and_ends[] = {{"mean", &D::mean}, {"sd", &D::sd}, {"low", &D::low}, {"high", &D::high}};
constexpr Argument moments_and_low[] = {{"mean", &D::mean}, {"sd", &D::sd}, {"low", &D::low, false, true}};
constexpr Argument scale_and_shape[] = {
    {"scale", &D::scale}, {"shape", &D::shape, true}, {"low", &D::low, false, true}};
constexpr Argument list_of_values[] = {{"values", nullptr}};

constexpr DistributionForm forms[] = {
    {"const", D::Kind::constant, value_of_constant, "one value"},
    {"unif", D::Kind::uniform, ends, "evenly from low to high"},
    {"triang", D::Kind::triangular, corners, "a triangle with its peak at mode"},
    {"norm", D::Kind::normal, moments, "normal, mean and standard deviation"},
    {"truncnorm", D::Kind::truncated_normal, moments_and_ends, "a normal one cut off at low and high"},
    {"lognorm", D::Kind::lognormal, moments_and_low, "mean and sd of the value itself, which lies above low (0)"},
    {"weibull", D::Kind::weibull, scale_and_shape, "low (0) + scale (-ln(1 - u))^(1/shape)"},
    {"values", D::Kind::values, list_of_values, "a list, each of its values as likely"},
};

constexpr bool in_order() {
    for (std::size_t i = 0; i < std::size(forms); ++i) {
        if (static_cast<std::size_t>(forms[i].kind) != i) return false;
    }
    return std::size(forms) == static_cast<std::size_t>(D::Kind::values) + 1;
}
static_assert(in_order());

}  // namespace

bool DistributionForm::has_levels() const {
    return kind != Distribution::Kind::constant && kind != Distribution::Kind::values;
}

std::span<DistributionForm const> distribution_forms() { return forms; }
DistributionForm const& form_of(Distribution::Kind kind) { return forms[static_cast<std::size_t>(kind)]; }

std::string listed_arguments(DistributionForm const& form) {
    std::string text;
    for (DistributionArgument const& argument : form.arguments) {
        std::string const next = (text.empty() ? "" : ", ") + std::string(argument.name);
        text += argument.optional ? "[" + next + "]" : next;
    }
    return text;
}

}  // namespace slideway
