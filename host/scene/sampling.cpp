#include "host/scene/sampling.hpp"

#include <stdexcept>
#include <vector>

#include <Random123/philox.h>

#include "host/scene/fnv1a.hpp"
#include "host/scene/scene.hpp"

namespace slideway {

std::array<std::uint64_t, 4> philox(std::array<std::uint64_t, 4> counter, std::array<std::uint64_t, 2> key) {
    r123::Philox4x64 const generator;  // ten rounds are its default
    r123::Philox4x64::ctr_type const c = {{counter[0], counter[1], counter[2], counter[3]}};
    r123::Philox4x64::key_type const k = {{key[0], key[1]}};
    auto const words = generator(c, k);
    return {words[0], words[1], words[2], words[3]};
}

std::uint64_t name_hash(std::string_view name) { return fnv1a(name); }

std::array<std::uint64_t, 4> StreamKey::words(Stream stream, std::uint64_t index, std::uint64_t sub) const {
    return philox({index, static_cast<std::uint64_t>(stream), sub, 0}, {seed, name});
}

double StreamKey::uniform(Stream stream, std::uint64_t index) const { return unit_fraction(words(stream, index)[0]); }

double unit_fraction(std::uint64_t word) {
    // 52 bits and a half: (2^53 − ½)·2^-53 would round to 1, (2^52 − ½)·2^-52 is a double below it.
    return (static_cast<double>(word >> 12) + 0.5) * 0x1p-52;
}

double uniform_draw(std::uint64_t seed, std::uint64_t member, std::string_view name) {
    return StreamKey{seed, name_hash(name)}.uniform(Stream::value, member);
}

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

std::uint64_t member_count(Scene const& scene) {
    return scene.study == StudyKind::sweep ? scene.members * scene.chaos.values.size() : scene.members;
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
    return complete_inputs(inputs);
}

}  // namespace slideway
