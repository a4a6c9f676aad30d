// A scene: what to integrate, how, and what to keep.  Read from TOML, validated, in SI units.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/config/keys.hpp"
#include "host/config/study_settings.hpp"
#include "host/sampling/design.hpp"
#include "kernels/block.hpp"

namespace slideway {

struct Scene {
    std::string path;  // as the user gave it
    std::string title;
    Inputs inputs;  // as given; entries that follow others are NaN
    Parts parts;
    IntegratorSettings integrator;  // end_time and max_step resolved
    StudyKind study = StudyKind::ensemble;
    ChaosSettings chaos;  // of the studies that ask for it
    std::uint64_t members = 1;
    std::uint64_t seed = 1;
    Store store = Store::members;      // what the result file keeps
    std::vector<double> sample_times;  // empty: no time series
    Selection quantities = 0;
    Selection series = 0;                    // state series included when sample_times is not empty
    std::vector<Variation> variations;       // in the order of the file
    Design design;                           // how members are spread over them
    std::shared_ptr<Sampler const> sampler;  // of the design, by prepare_sampler; none: made for each draw
    std::vector<Limit> limits;               // [study.limits]
    /// Members that run again to check the others, whatever it costs; none: what a tenth of the study's work allows.
    std::optional<std::uint64_t> verify;
    std::vector<std::string> warnings;       // one line each: what was given and has no effect

    bool stores_members() const { return store == Store::members; }
};

using Overrides = std::vector<std::pair<std::string, std::string>>;  // --set key=value, in order

/// Reads and validates a scene.  @throws SceneError with file, line and key, also for a file that cannot be read (a
/// scene that is not there is bad usage); FileError when the units database of UDUNITS-2 is missing.
Scene read_scene(std::string const& path, Overrides const& overrides = {});

/// The same from the text of a scene; `name` stands for the path in messages.
Scene parse_scene(std::string const& text, std::string const& name, Overrides const& overrides = {});

/// Makes the members those of given inputs: design "table" without a file.  What the keys varied by before counts no more.
/// @param names dotted keys  @param values in SI, one member a row  @throws SceneError if one of them is no such key, or the study's design is
/// given otherwise
void take_members(Scene& scene, std::vector<std::string> const& names, std::span<double const> values);

/// Members of all columns of a sweep, else `members`.
std::uint64_t member_count(Scene const& scene);

/// Makes the sampler of the design as it is now; to be called again when variations, design, seed or members change.
/// @throws SceneError if the design cannot have them.
void prepare_sampler(Scene& scene);

/// Inputs of one member, complete; `defect` tells whether the draw can be used.  Depends on the scene and the member's
/// number only (its design, seed and key names), so any member can be drawn alone, on any thread or machine.
/// In a sweep members [0, members) are the starts of the first column, and so on: each column has the same starts.
Inputs member_inputs(Scene const& scene, std::uint64_t member);

/// The value that member draws for a variation, in SI units.
double draw(Scene const& scene, Variation const& variation, std::uint64_t member);

/// The scene with every key written out in SI units, as TOML that reads back to the same scene.
std::string resolved_toml(Scene const& scene);

}  // namespace slideway
