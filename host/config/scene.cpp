#include "host/config/scene.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "host/config/loads.hpp"
#include "kernels/members/complete_inputs.hpp"

namespace slideway {
namespace {

/// Values of all variations.
std::vector<double> draw_values(Scene const& scene, std::uint64_t member) {
    std::vector<double> values(scene.variations.size());
    if (scene.sampler != nullptr) {
        scene.sampler->draw(member, values);
    } else {
        Sampler(scene.design, scene.variations, scene.seed, scene.members).draw(member, values);
    }
    return values;
}

}  // namespace

void prepare_sampler(Scene& scene) {
    try {
        scene.sampler = std::make_shared<Sampler const>(scene.design, scene.variations, scene.seed, scene.members);
    } catch (SceneError const& error) {
        throw SceneError(scene.path + ": " + error.what());
    }
}

double draw(Scene const& scene, Variation const& variation, std::uint64_t member) {
    auto const values = draw_values(scene, member);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (scene.variations[i].key == variation.key) return values[i];
    }
    throw std::invalid_argument("draw: the scene does not vary this key");
}

Key const* find_key(std::string_view dotted_name, Scene const& scene) {
    Key const* const own = scene.loads != nullptr ? scene.loads->find_key(dotted_name) : nullptr;
    return own != nullptr ? own : find_key(dotted_name);
}

std::vector<std::string_view> numeric_key_names(Scene const& scene) {
    std::vector<std::string_view> names = numeric_key_names();
    for (std::size_t i = 0; scene.loads != nullptr && i < scene.loads->keys().size(); ++i) names.push_back(scene.loads->keys()[i].name);
    return names;
}

TableFile const* find_table(Scene const& scene, std::string_view key) {
    auto const found = std::ranges::find(scene.tables, key, &TableFile::key);
    return found == scene.tables.end() ? nullptr : &*found;
}

std::uint64_t member_count(Scene const& scene) {
    return scene.study == StudyKind::sweep ? scene.members * scene.chaos.values.size() : scene.members;
}

std::string label_of(Scene const& scene, std::uint64_t member) {
    MemberTable const* const table = scene.design.table.get();
    return table != nullptr && member < table->labels.size() ? table->labels[static_cast<std::size_t>(member)] : std::string();
}

Inputs given_or_varied(Scene const& scene) {
    Inputs inputs = scene.inputs;
    for (Variation const& variation : scene.variations) variation.key->set(inputs, 1);
    if (scene.chaos.parameter != nullptr) scene.chaos.parameter->set(inputs, 1);
    return inputs;
}

std::vector<DerivedNumber> derived_numbers(Scene const& scene) {
    Inputs const complete = complete_inputs(scene.inputs, info(scene.parts.mechanism)), given = given_or_varied(scene);
    Inputs other = scene.inputs;
    for (Variation const& variation : scene.variations) variation.key->set(other, 1.5 * variation.key->get(other));
    Inputs const others = complete_inputs(other, info(scene.parts.mechanism));
    std::vector<DerivedNumber> numbers;
    for (Key const& key : keys()) {
        if (!counts_for(key, scene.parts) || !std::isnan(key.get(given)) || lays_way(key)) continue;  // faces are as their axis says
        std::string words = derivation_of(key, scene.parts, scene.inputs);
        // What follows from what members vary in is not what any of them has.
        if (auto const note = words.find(" ("); key.get(others) != key.get(complete) && !std::isnan(key.get(complete)))
            words = words.substr(0, note) + "; members have their own";
        numbers.push_back({&key, key.get(complete), std::move(words)});
    }
    return numbers;
}

Inputs member_inputs(Scene const& scene, std::uint64_t member) {
    Inputs inputs = scene.inputs;
    std::uint64_t start = member;
    if (scene.study == StudyKind::sweep) {
        start = member % scene.members;
        scene.chaos.parameter->set(inputs, scene.chaos.values.at(static_cast<std::size_t>(member / scene.members)));
    }
    auto const values = draw_values(scene, start);
    for (std::size_t i = 0; i < values.size(); ++i) scene.variations[i].key->set(inputs, values[i]);
    return complete_inputs(inputs, info(scene.parts.mechanism));
}

}  // namespace slideway
