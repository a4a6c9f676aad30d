#include "host/scene/sampling.hpp"

#include <Random123/philox.h>

#include "host/scene/scene.hpp"

namespace slideway {

std::array<std::uint64_t, 4> philox(std::array<std::uint64_t, 4> counter, std::array<std::uint64_t, 2> key) {
    r123::Philox4x64 const generator;  // ten rounds are its default
    r123::Philox4x64::ctr_type const c = {{counter[0], counter[1], counter[2], counter[3]}};
    r123::Philox4x64::key_type const k = {{key[0], key[1]}};
    auto const words = generator(c, k);
    return {words[0], words[1], words[2], words[3]};
}

std::uint64_t name_hash(std::string_view name) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (char const c : name) {
        hash ^= static_cast<unsigned char>(c);
        hash *= 0x100000001b3u;
    }
    return hash;
}

double uniform_draw(std::uint64_t seed, std::uint64_t member, std::string_view name) {
    std::uint64_t const word = philox({member, 0, 0, 0}, {seed, name_hash(name)})[0];
    // 52 bits and a half: (2^53 − ½)·2^-53 would round to 1, (2^52 − ½)·2^-52 is a double below it.
    return (static_cast<double>(word >> 12) + 0.5) * 0x1p-52;
}

double draw(Scene const& scene, Variation const& variation, std::uint64_t member) {
    return variation.distribution.quantile(uniform_draw(scene.seed, member, variation.key->name));
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
    for (Variation const& variation : scene.variations) variation.key->set(inputs, draw(scene, variation, start));
    return complete_inputs(inputs);
}

}  // namespace slideway
