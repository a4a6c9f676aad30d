// Text of a scene -> Scene -> resolved scene -> the same Scene.  Comments "#--set key=value" are also overrides.
#include <cstring>

#include "host/config/scene.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace slideway::fuzz {
namespace {

Overrides overrides_in(std::string_view text) {
    constexpr std::string_view mark = "#--set ";
    Overrides overrides;
    for (std::size_t at = text.find(mark); at != text.npos; at = text.find(mark, at)) {
        at += mark.size();
        std::string_view const line = text.substr(at, text.find('\n', at) - at);
        auto const equals = line.find('=');
        if (equals != line.npos) overrides.emplace_back(line.substr(0, equals), line.substr(equals + 1));
    }
    return overrides;
}

void require_same(Scene const& scene, Scene const& again, std::string const& text) {
    require(resolved_toml(again) == text, "the resolved scene resolves to itself", text + "\n== then ==\n" + resolved_toml(again));
    require(member_count(scene) == member_count(again), "as many members", text);
    require(scene.sample_times == again.sample_times, "the same times", text);
    require(scene.quantities == again.quantities && scene.series == again.series, "the same quantities", text);
    if (member_count(scene) == 0) return;
    for (std::uint64_t const member : {std::uint64_t{0}, member_count(scene) - 1}) {
        Inputs const one = member_inputs(scene, member), other = member_inputs(again, member);
        for (Key const& key : keys()) {
            if (!counts_for(key, scene.parts)) continue;
            double const a = key.get(one), b = key.get(other);
            require(std::memcmp(&a, &b, sizeof a) == 0, "the same members", std::string(key.name) + " differs in\n" + text);
        }
    }
}

}  // namespace
}  // namespace slideway::fuzz

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    using namespace slideway;
    std::string const text(fuzz::text_of(data, size));
    // Files that a scene names are those of the target `table`, and devices may have no end.
    if (text.find("/") != text.npos) return 0;
    Scene scene;
    // In a folder that is not there.
    if (!fuzz::accepted([&] { scene = parse_scene(text, "absent/scene.toml", fuzz::overrides_in(text)); })) return 0;
    // A table of members has one that is drawn beyond what the rules allow: an error of the study, not of the scene.
    std::string const resolved = resolved_toml(scene);
    Scene again;
    std::string problem;
    try {
        again = parse_scene(resolved, "absent/scene.toml");
    } catch (SceneError const& error) {
        problem = error.what();
    }
    fuzz::require(problem.empty(), "the resolved scene can be read", problem + "\n" + resolved);
    prepare_sampler(scene);
    prepare_sampler(again);
    fuzz::require_same(scene, again, resolved);
    return 0;
}
