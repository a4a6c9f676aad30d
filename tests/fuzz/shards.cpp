// What a folder of shards holds beside them: manifests, the identity of a run, sets of members, names of files.  The first byte says which.
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "host/base/bytes.hpp"
#include "host/store/shard_folder.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace slideway::fuzz {
namespace {

RunIdentity some_identity() { return {"slideway 0.1.0", arithmetic_of("scalar"), MemberSet(MemberRange{0, 100}), "schema = 1\n"}; }

/// Lines get the checksum that a run would have put behind them: nothing would be read otherwise.
void read_manifest(std::string const& text) {
    std::istringstream lines(text);
    std::ostringstream manifest;
    for (std::string line; std::getline(lines, line);) {
        char digits[17];
        std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(fnv1a(line)));
        manifest << line << ' ' << digits << '\n';
    }
    static bool const written = [] {
        write_file(folder() / shard_names::identity, identity_text(some_identity()));
        write_file(folder() / "members-0000000000.nc", "content");
        return true;
    }();
    require(written, "there is an identity");
    write_file(folder() / manifest_name(0), manifest.str());
    ShardFolder const shards(folder().string());
    accepted([&] {
        std::vector<DamagedShard> damaged;
        auto all = shards.intact(damaged);
        for (DamagedShard const& one : damaged) {
            if (!one.is_manifest) all.push_back(one.shard);
        }
        for (Shard const& shard : all) require(!shard.members.empty(), "a shard holds members", manifest_line(shard));
        MemberSet done;
        for (Shard const& shard : shards.listed()) {
            require(!done.overlaps(shard.members), "no member is in two shards", manifest.str());
            done.add(shard.members);
        }
    });
}

void read_identity(std::string const& text) {
    RunIdentity identity;
    if (!accepted([&] { identity = parse_identity(text, "run.toml"); })) return;
    std::string const written = identity_text(identity);
    RunIdentity const again = parse_identity(written, "run.toml");
    require(again.difference(identity).empty() && again.tables == identity.tables, "an identity reads the same", written);
    std::string const portable = portable_scene(identity.scene);
    require(portable_scene(portable) == portable, "a portable scene is portable", portable);
    require(with_tables(identity.scene, paths_of_tables(identity.scene)) == identity.scene, "its own table changes nothing", identity.scene);
    identity.difference(some_identity());
    some_identity().difference(identity);
}

void read_members(std::string_view text) {
    auto const bar = text.find('|');
    auto const a = MemberSet::parse(text.substr(0, bar));
    auto const b = MemberSet::parse(bar == text.npos ? text : text.substr(bar + 1));
    if (!a || !b) return;
    require(MemberSet::parse(a->text()) == a, "members read the same", a->text());
    MemberSet const rest = a->without(*b), common = a->common(*b);
    require(rest.count() + common.count() == a->count(), "a member is in one of them", text);
    require(common.empty() == !a->overlaps(*b), "sets overlap where they have common members", text);
    MemberSet both = *b;
    both.add(rest);
    MemberSet other = *a;
    other.add(*b);
    require(both == other, "what is left and what was taken are all", text);
}

}  // namespace
}  // namespace slideway::fuzz

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    using namespace slideway;
    std::string_view text = fuzz::text_of(data, size);
    unsigned const choice = fuzz::take_choice(text, 4);
    if (choice == 0) fuzz::read_manifest(std::string(text));
    if (choice == 1) fuzz::read_identity(std::string(text));
    if (choice == 2) fuzz::read_members(text);
    if (choice == 3) kind_of(text);
    return 0;
}
