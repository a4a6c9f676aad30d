// Calls of the library's interface with any arguments, one after the other, of an ensemble and of what the calls make of it.  The kernels are
// replaced: members end at once.
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "host/library/slideway.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace slideway::fuzz {
namespace {

constexpr std::array scenes = {
    "schema = 1\n", "schema = 1\n[study]\nkind = \"ensemble\"\nmembers = 3\nduration = \"1 ms\"\nsamples = 4\nquantities = [\"y\", \"mode_time\"]\n",
    "schema = 1\n[study]\nkind = \"tolerance\"\nmembers = 5\nduration = \"1 ms\"\nquantities = [\"peak_tilt\"]\n[study.vary]\n"
    "\"joint.clearance\" = { dist = \"unif\", low = 1e-4, high = 2e-4 }\n",
    "schema = 1\n[mechanism]\nkind = \"free_slider\"\n[study]\nmembers = 2\nduration = \"1 ms\"\n"};
constexpr std::array keys = {"joint.clearance", "study.members", "initial.y", "contact.law", "friction.kinetic", "study.quantities", "mechanism.kind",
                             "study.samples", "study.duration", "", "a.b"};
constexpr std::array values = {"0.2 mm", "3", "-1", "nan", "\"conservative\"", "\"rigid\"", "[\"y\"]", "[]", "\"0.5 ms\"", "true", "{", ""};
constexpr std::uint64_t most_members = 64;  // else an execution takes a second
int results_read = 0;
// A run takes as long as thousands of the other calls, a scene that is read anew or written as tens, and inputs with one are kept for the code that they
// reach: one in 64 of them runs, one in 8 reads or writes scenes, told by its bytes.
constexpr std::size_t inputs_a_run = 64, inputs_a_scene = 8;
bool may_run = true, may_read = true;

/// Whether the call was made; what it cannot do is said in one line, by the one exception that the interface has.
template <class Call> bool made(Call const& call) {
    std::string line;
    try {
        call();
        return true;
    } catch (Error const& error) {
        require(error.code() == 1 || error.code() == 2 || error.code() == 4, "an error has the code of the program");
        line = error.what();
    }
    return accepted([&] { throw SceneError(line); });
}

std::vector<double> take_numbers(std::string_view& text) {
    constexpr std::array special = {0.0, 1e-4, -1.0, 1e300, HUGE_VAL, -HUGE_VAL, std::numeric_limits<double>::quiet_NaN()};
    std::vector<double> numbers(take_choice(text, 25));
    for (double& number : numbers) number = special[take_choice(text, special.size())];
    return numbers;
}

Table take_table(std::string_view& text) {
    Table table;
    for (unsigned columns = take_choice(text, 3); columns > 0; --columns) table.names.emplace_back(keys[take_choice(text, keys.size())]);
    table.values = take_numbers(text);
    return table;
}

Settings take_settings(std::string_view& text) {
    Settings settings;
    for (unsigned count = take_choice(text, 3); count > 0; --count) {
        std::string const key = keys[take_choice(text, keys.size())];
        settings.emplace_back(key, values[take_choice(text, values.size())]);
    }
    return settings;
}

/// @param first of the columns that are read: each is looked for among all
void read_result(Result const& result, std::uint64_t members, std::size_t first) {
    ++results_read;
    require(!result.payload_hash().empty(), "a result has a hash");
    std::vector<std::string> const names = result.names();
    constexpr std::size_t apart = 16;
    for (std::size_t at = first % apart; at < names.size(); at += apart) {
        Column const column = result.column(names[at]);
        if (column.type == Column::Type::text)
            made([&] { column.texts(); });
        else
            require(column.values().size() == column.size(), "a column has its values", names[at]);
    }
    require(result.column("status").size() == members, "a member a status");
    require(!made([&] { static_cast<void>(result.column("no such column")); }), "what is not there is refused");
}

void run(Ensemble const& ensemble, std::string_view& text) {
    if (ensemble.members() > most_members) return;
    RunOptions options;
    options.threads = static_cast<int>(take_choice(text, 3)) - 1;
    constexpr std::array isas = {"auto", "scalar", "avx512", "no"};
    options.isa = isas[take_choice(text, isas.size())];
    options.verify = take_choice(text, 8) == 0;
    std::atomic<bool> const stop = take_choice(text, 8) == 0;
    options.stop = &stop;
    options.any_start = take_choice(text, 2) == 0;
    std::optional<Result> result;
    if (made([&] { result = ensemble.run(options); })) read_result(*result, ensemble.members(), take_choice(text, 16));
}

/// Replaces the ensemble where the call makes another.
void call(std::optional<Ensemble>& ensemble, std::string_view& text) {
    unsigned const choice = take_choice(text, 256);
    switch (choice == 255 ? 5 : choice >= 240 ? 0 : 1 + choice % 4) {
        case 0: {
            Settings const settings = take_settings(text);
            if (may_read) made([&] { ensemble = ensemble->with(settings); });
            break;
        }
        case 1: {
            Table const table = take_table(text);
            if (made([&] { ensemble = ensemble->with_members(table); })) require(ensemble->members() == table.rows(), "a member a row");
            break;
        }
        case 2: {
            std::vector<double> const states = take_numbers(text), times = take_numbers(text);
            Table probed;
            if (made([&] { probed = ensemble->probe(states, times); }))
                require(probed.rows() * ensemble->state_names().size() == states.size(), "a row a state");
            break;
        }
        case 3: {
            Table drawn;
            if (ensemble->members() <= most_members && made([&] { drawn = ensemble->draws(); }) && !drawn.names.empty())
                require(drawn.rows() == ensemble->members(), "a row a member");
            break;
        }
        case 4:
            made([&] { static_cast<void>(ensemble->warnings()); });
            made([&] { static_cast<void>(ensemble->result_bytes()); });
            if (may_read) require(!ensemble->resolved().empty(), "a scene is text");
            break;
        default:
            if (may_run) run(*ensemble, text);
            text = {};  // one of an input is enough
    }
}

}  // namespace
}  // namespace slideway::fuzz

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    using namespace slideway;
    std::string_view text = fuzz::text_of(data, size);
    // Read once: most of what a call costs is the text.
    static std::vector<Ensemble> const ensembles = [] {
        std::vector<Ensemble> all;
        for (char const* const scene : fuzz::scenes) all.push_back(Ensemble::parse(scene, "absent/scene.toml"));
        return all;
    }();
    std::size_t const drawn = std::hash<std::string_view>()(text);
    fuzz::may_run = fuzz::results_read == 0 || drawn % fuzz::inputs_a_run == 0;
    fuzz::may_read = drawn % fuzz::inputs_a_scene == 0;
    std::optional<Ensemble> ensemble = ensembles[fuzz::take_choice(text, static_cast<unsigned>(ensembles.size()))];
    for (int calls = 0; calls < 6 && !text.empty(); ++calls) fuzz::call(ensemble, text);
    return 0;
}

/// A target whose runs are all refused would look at no result, and find nothing.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
    using namespace slideway;
    std::ifstream file(SLIDEWAY_CORPUS "/library/run", std::ios::binary);
    std::string const input(std::istreambuf_iterator<char>(file), {});
    LLVMFuzzerTestOneInput(reinterpret_cast<std::uint8_t const*>(input.data()), input.size());
    fuzz::require(fuzz::results_read == 1, "the corpus' input `run` has a result");
    return 0;
}
