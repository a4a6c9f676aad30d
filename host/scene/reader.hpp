// The parts of `read_scene`, in the order they run.
#pragma once

#include "host/scene/document.hpp"
#include "host/scene/scene.hpp"

namespace slideway {

/// A node that holds a numeric key of the physics.
struct GivenKey {
    Key const* key;
    Node const* node;
};
/// In the order in which they take effect: those of the file, then the options.
std::vector<GivenKey> given_keys(Node const& root);

/// Numeric keys, law, damping, friction and way pose; everything of Scene::inputs and Scene::parts but [study.vary].
void read_physics(Node const& root, Scene& scene);
/// [study.vary]; adds the kernel parts that the varied keys need.
void read_variations(Node const& root, Scene& scene);
/// [integrator]; needs the crank speed.
void read_integrator(Node const& root, Scene& scene);
/// [study] without [study.vary]; needs the crank speed.
void read_study(Node const& root, Scene& scene);

/// Largest integrator.max_steps.
inline constexpr std::uint64_t most_steps = 1'000'000'000'000'000;

/// `count` times from 0 to end_time, both included; count is 0 or at least 2.
std::vector<double> uniform_times(double end_time, std::size_t count);

/// Refuses a node that no part of the scene reads.
[[noreturn]] void refuse_unknown(Node const& node, std::string_view what, std::span<std::string_view const> known);

/// The choice of a node among names some of which belong to later versions; `available` of them come first.
std::size_t read_available(Node const& node, std::string_view meaning, std::span<std::string_view const> names,
                           std::size_t available);

}  // namespace slideway
