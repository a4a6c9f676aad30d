#include "host/store/label_axes.hpp"

#include <array>

#include <fmt/format.h>

#include "host/config/descriptors.hpp"

namespace slideway {
namespace {

constexpr std::size_t label_length = 8;  // "surface" and room for one more letter

}  // namespace

LabelAxes::Axis const& LabelAxes::axis(std::string const& name) {
    auto const [found, is_new] = axes_.try_emplace(name);
    if (!is_new) return found->second;
    if (label_dimension_ < 0) label_dimension_ = file_.add_dimension("label_length", label_length);
    std::vector<std::string> labels = labels_of(name);
    found->second = {file_.add_dimension(name, labels.size()), name + "_name"};
    int const variable = file_.add_variable(found->second.label_name, NetcdfFile::Type::text,
                                            std::array{found->second.dimension, label_dimension_});
    file_.put_text(variable, "long_name", fmt::format("label along {}", name));
    file_.put_text(variable, "_Encoding", "utf-8");  // readers then give strings, not bytes
    labels_.push_back({variable, std::move(labels)});
    return found->second;
}

void LabelAxes::write() const {
    for (LabelVariable const& variable : labels_) {
        std::vector<char> text(variable.labels.size() * label_length, '\0');
        for (std::size_t i = 0; i < variable.labels.size(); ++i) {
            variable.labels[i].copy(text.data() + i * label_length, label_length);
        }
        std::size_t const origin[2] = {0, 0}, all_labels[2] = {variable.labels.size(), label_length};
        file_.write(variable.id, origin, all_labels, text.data());
    }
}

}  // namespace slideway
