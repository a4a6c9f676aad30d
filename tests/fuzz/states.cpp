// States to probe, of each mechanism: rows of a table, or of plain numbers as the library gives them.  The kernels are replaced.
#include <array>
#include <cmath>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "host/config/descriptors.hpp"
#include "host/study/probe.hpp"
#include "kernels/members/start.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace slideway::fuzz {
namespace {

Scene const& scene_of(unsigned choice) {
    static std::vector<Scene> const scenes = [] {
        std::vector<Scene> all;
        for (char const* const text :
             {"schema = 1\n", "schema = 1\n[friction]\n", "schema = 1\n[contact]\nlaw = \"conservative\"\n", "schema = 1\n[mechanism]\nkind = \"carriage\"\n",
              "schema = 1\n[mechanism]\nkind = \"scotch_yoke\"\n", "schema = 1\n[mechanism]\nkind = \"free_slider\"\n",
              "schema = 1\n[mechanism]\nkind = \"planar_slider_crank\"\n"})
            require(accepted([&] { all.push_back(parse_scene(text, "s.toml")); }), "the scenes can be read", text);
        return all;
    }();
    return scenes[choice % scenes.size()];
}

/// What is written of states reads as the same states.
void write_and_read(Scene const& scene, StateTable const& table) {
    require(table.rows() == table.times.size() && table.rows() == table.parts.size(), "each row has all of it");
    std::ostringstream out;
    write_probe_csv(out, table, probe(table, best_isa()));
    std::istringstream in(out.str());
    StateTable again;
    bool const read = accepted([&] { again = read_state_table(in, "t.csv", scene); });
    require(read && again.rows() == table.rows(), "what is written can be read", out.str());
    MechanismInfo const& mechanism = info(table.mechanism);
    if (!mechanism.spatial) return;  // whose rod angle follows from the height of the slider, to a rounding
    for (std::size_t row = 0; row < table.rows(); ++row) {
        require(again.times[row] == table.times[row], "the same times", out.str());
        StateNumbers const one = start_of(mechanism, table.inputs[row]), other = start_of(mechanism, again.inputs[row]);
        for (std::size_t k = 0; k < static_cast<std::size_t>(mechanism.states); ++k) require(one[k] == other[k], "the same states", out.str());
    }
}

void read_table(Scene const& scene, std::string const& text) {
    std::istringstream in(text);
    StateTable table;
    if (!accepted([&] { table = read_state_table(in, "t.csv", scene); })) return;
    for (auto const& row : table.parameter_texts) require(row.size() == table.parameter_names.size(), "each row has all parameters", text);
    write_and_read(scene, table);
}

void take_numbers(Scene const& scene, std::string_view text) {
    std::size_t const times = take_choice(text, 8);
    std::vector<double> numbers(text.size() / sizeof(double));
    if (!numbers.empty()) std::memcpy(numbers.data(), text.data(), numbers.size() * sizeof(double));
    std::size_t const first = std::min(times, numbers.size());
    StateTable table;
    std::span const all(numbers);
    if (accepted([&] { table = state_table(scene, all.subspan(first), all.first(first)); }) && table.rows() > 0) write_and_read(scene, table);
}

}  // namespace
}  // namespace slideway::fuzz

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    using namespace slideway;
    std::string_view text = fuzz::text_of(data, size);
    unsigned const choice = fuzz::take_choice(text, 16);
    Scene const& scene = fuzz::scene_of(choice / 2);
    if (choice % 2 == 0)
        fuzz::read_table(scene, std::string(text));
    else
        fuzz::take_numbers(scene, text);
    return 0;
}
