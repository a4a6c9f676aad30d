#include "host/study/study_run.hpp"

#include <filesystem>
#include <map>
#include <system_error>

#include <unistd.h>

#include <fmt/format.h>

#include "host/base/durable_file.hpp"
#include "host/config/document.hpp"
#include "host/store/block_statistics.hpp"
#include "host/store/result_merge.hpp"
#include "host/store/result_view.hpp"
#include "host/store/shard_claim.hpp"
#include "host/study/continued_sweep.hpp"
#include "host/study/prediction.hpp"
#include "host/study/verification.hpp"

namespace slideway {
namespace {

/// Whether a result file holds all that a run would compute.  @throws SceneError if it is of another run.
bool is_result_of(std::string const& path, RunIdentity const& identity) {
    if (SealCheck const seal = check_result(path); !seal.intact()) {
        // What somebody has added is his: nobody is told to replace it.
        throw FileError(seal.is_only_added_to() ? fmt::format("{}: {}; take it out again, or give another name with -o", path, seal.damage())
                                                : fmt::format("{}: is damaged: {}; give --force instead of --resume to run again", path, seal.damage()));
    }
    ResultReader const result(path);
    if (std::string const changed = difference(result, identity); !changed.empty()) {
        throw SceneError(
            fmt::format("{}: cannot resume: it is the result of another run ({}); give another name with -o, or --force instead of --resume to replace it",
                        path, changed));
    }
    return result.attribute("completeness") == "complete";
}

/// Who was killed between a result and its shards' end left both: to replace the one is to replace the other.
void remove_shards_of_finished(std::string const& result, std::string const& folder) {
    if (ShardFolder::exists(folder) && why_not_finished(result, ShardFolder(folder).identity()).empty()) ShardClaim::remove_merged(folder);
}

/// The tables as they were read, so that the folder of shards is all that a merge needs.
std::map<std::string, std::shared_ptr<std::string const>> copies_of_tables(Scene const& scene) {
    std::map<std::string, std::shared_ptr<std::string const>> copies;
    for (TableFile const& table : scene.tables) copies[copy_of_table(table.key)] = table.text;
    return copies;
}

OutputTarget target_of(Scene const& scene, StudyOptions const& options) {
    std::vector<std::string> const inputs = inputs_of(scene);
    return {options.output,
            {inputs, options.force || options.resume, is_result_file,
             "add --force to replace it, --resume to go on with it, or give another name with -o"}};
}

/// As a result file says it.
Maker stored_maker(DataFile const& file) {
    auto const text = [&](char const* name) { return file.text(DataFile::global, name); };
    return {text("backend"), text("isa"), text("flags"), static_cast<int>(file.number(DataFile::global, "threads").value_or(1))};
}

/// What a merge needs beside the shards.  What it refers to must outlive it.  @param left members without one
ResultMerge study_merge(Scene const& scene, MemberSet const& members, std::uint64_t left, Provenance const& provenance, OutputTarget const& output,
                               std::optional<ToleranceReport>& report, ReportSettings const& settings, std::function<void(DataFile&)> const& verify) {
    std::string const completeness = left == 0 ? "complete" : fmt::format("{} of {} members not run", left, members.count());
    auto const conclude = [&scene, &report, &settings, &verify, left](DataFile& file) {
        conclude_study(scene, file, report, settings);
        if (verify && left == 0) verify(file);
    };
    return {result_layout(scene, members), provenance, completeness, conclude, settings.pause, output.existing()};
}

}  // namespace

std::string RunPart::name() const { return of_array ? fmt::format("{}-of-{}", number, parts) : std::string(); }

MemberSet RunPart::of(MemberSet const& members) const {
    // In steps that cannot overflow: the first `rest` parts have one member more.
    std::uint64_t const count = members.count(), share = count / parts, rest = count % parts;
    std::uint64_t const before = (number - 1) * share + std::min(number - 1, rest);
    MemberSet part;
    std::uint64_t skip = before, wanted = share + (number <= rest ? 1 : 0);
    for (MemberRange const& range : members.ranges()) {
        std::uint64_t const from = std::min(skip, range.count), taken = std::min(range.count - from, wanted);
        part.add({range.first + from, taken});
        skip -= from;
        wanted -= taken;
    }
    return part;
}

MemberSet members_of_part(Scene const& scene, RunPart const& part, MemberSet const& members) {
    if (!is_continued(scene)) return part.of(members);
    return members.common(members_of_starts(scene, part.of(swept_starts(scene, members))));
}

std::string shard_folder_of(std::string const& output) { return followed(output) + ".shards"; }

Scene scene_of(ShardFolder const& folder) {
    std::string const& text = folder.identity().scene;
    Scene scene = parse_scene(text, in_folder(folder.path(), shard_names::identity));
    OfTables const found = contents_of_tables(resolved_toml(scene));
    for (auto const& [key, content] : contents_of_tables(text)) {
        auto const here = found.find(key);
        if (here != found.end() && here->second != content)
            throw FileError(fmt::format("{}: is not the table of this run (its checksum differs); put that one there", in_folder(folder.path(), copy_of_table(key))));
    }
    return scene;
}

std::vector<std::string> inputs_of(Scene const& scene) {
    std::vector<std::string> inputs{scene.path};
    for (TableFile const& table : scene.tables) inputs.push_back(table.path);
    return inputs;
}

StudyRun::StudyRun(Scene const& scene, StudyOptions const& options)
    : scene_(scene), options_(options), target_(target_of(scene, options)), members_(options.range),
      mine_(members_of_part(scene, options.part, members_)) {
    require_room_beside(target_.path());
    std::string const folder = shard_folder_of(options.output);
    RunIdentity const identity = run_identity(scene, members_, *options.backend);
    if (options.resume && target_.replaces() && !(options.force && ShardFolder::exists(folder))) {
        bool const whole = is_result_of(options.output, identity);
        is_complete_ = whole && !ShardFolder::exists(folder);
        if (is_complete_) {
            ShardClaim::remove_remains(folder);
            remove_merge_lock(target_.path());
            return;
        }
    }
    if (options.force && !options.resume && !options.part.of_array && target_.replaces()) remove_shards_of_finished(target_.path(), folder);
    ShardClaim::Wanted const wanted{identity, mine_, options.part.name(), options.resume, copies_of_tables(scene)};
    brief_.claim = [this, wanted] { claim(wanted); };
    if (may_be_short())
        work_ = {mine_, 0, &brief_};
    else
        claim(wanted);
    require_room();
}

/// Who resumes, shares or meets a folder wants its shards; what cannot be made there is to be told now.
bool StudyRun::may_be_short() const {
    bool const alone = !options_.part.of_array && !options_.resume && !options_.shared;
    std::string const folder = folder_of(options_.output);
    return alone && scene_.stores_members() && !is_there(shard_folder_of(options_.output)) && ::access(folder.c_str(), W_OK | X_OK) == 0;
}

void StudyRun::claim(ShardClaim::Wanted const& wanted) {
    claim_ = std::make_unique<ShardClaim>(shard_folder_of(options_.output), wanted);
    work_ = {mine_.without(claim_->done()), claim_->done().count()};
}

void StudyRun::require_room() const {
    // The shards and the file that is made of them stand side by side for a while.
    std::uint64_t const shards =
        shard_bytes(scene_, work_.todo, *options_.backend, options_.threads, options_.block_members);
    double const needed = static_cast<double>(shards) +
                          static_cast<double>(result_bytes(scene_, members_, *options_.backend, options_.threads));
    std::error_code error;
    auto const space = std::filesystem::space(folder_of(options_.output), error);
    if (error || needed <= static_cast<double>(space.available)) return;
    throw FileError(fmt::format("{}: needs {:.3g} MB with its shards, and {:.3g} MB are free (disk full?)",
                                options_.output, needed / 1e6, static_cast<double>(space.available) / 1e6));
}

std::uint64_t StudyRun::left() const {
    if (is_complete_ || brief_.block) return 0;
    ShardFolder const folder(shard_folder_of(options_.output));
    return mine_.without(members_of(folder.listed())).count();
}

std::function<void()> pause_of(StopRequest const& stop) {
    return [&stop] {
        if (stop.reason() == StopReason::signal) throw MergeStopped();
    };
}

bool StudyRun::merge(StopRequest const& stop, std::optional<ToleranceReport>& report) {
    try {
        merge_all(stop, report);
        return true;
    } catch (MergeStopped const&) {
        put_into_shards(scene_, options_, brief_);
        return false;
    } catch (...) {
        // The first failure is the one to be told; without shards nobody says that they are kept.
        try {
            put_into_shards(scene_, options_, brief_);
        } catch (std::exception const&) {
        }
        throw;
    }
}

void StudyRun::merge_all(StopRequest const& stop, std::optional<ToleranceReport>& report) {
    ReportSettings settings;
    settings.threads = options_.threads;
    settings.pause = pause_of(stop);
    auto const check = resolution_check(scene_, *options_.backend, options_.threads, stop, options_.progress);
    auto const origin = provenance(scene_, *options_.backend, options_.threads);
    if (!brief_.block) {
        ShardFolder const folder(shard_folder_of(options_.output));
        merge_study(scene_, folder, folder.listed(), origin, target_, report, settings, check);
        return;
    }
    merge_shards({memory_shard(options_.output, result_layout(scene_, members_), brief_.block())},
                 study_merge(scene_, members_, 0, origin, target_, report, settings, check), target_.path());
}

std::function<void(DataFile&)> resolution_check(Scene const& scene, Backend const& backend, int threads, StopRequest const& stop, Progress::Style progress) {
    return [&scene, &backend, threads, &stop, progress](DataFile& file) {
        write_verification(file, verify(ResultView(file), scene, backend, {scene.verify, threads, stop, progress}));
    };
}

bool asks_for_report(Scene const& scene) {
    return !scene.stores_members() || scene.study == StudyKind::tolerance ||
           (scene.study == StudyKind::ensemble && !scene.limits.empty());
}

void conclude_study(Scene const& scene, DataFile& file, std::optional<ToleranceReport>& report, ReportSettings const& settings) {
    if (!asks_for_report(scene)) return;
    report = tolerance_report(ResultView(file), scene, settings);
    write_statistics(file, *report);
}

std::uint64_t merge_study(Scene const& scene, ShardFolder const& folder, std::vector<Shard> const& shards,
                          Provenance const& provenance, OutputTarget const& output,
                          std::optional<ToleranceReport>& report, ReportSettings const& settings,
                          std::function<void(DataFile&)> const& verify) {
    MemberSet const& members = folder.identity().members;
    std::uint64_t const left = members.without(members_of(shards)).count();
    ResultMerge merge = study_merge(scene, members, left, provenance, output, report, settings, verify);
    if (scene.stores_members())
        merge_shards(folder, shards, std::move(merge), output.path());
    else
        merge_statistics(folder, shards, statistics_plan(scene), merge, output.path());
    return left;
}

std::optional<std::uint64_t> asked_check(ShardFolder const& folder, std::vector<Shard> const& shards, Scene const& scene) {
    if (shards.empty() || !scene.stores_members()) return {};
    std::string const text = NetcdfFile::open_in_memory(shards.front().name, folder.read(shards.front())).text(NetcdfFile::global, "scene");
    Node const document = read_document(text, shards.front().name, {});
    Node const* const verify = document.find_path("study.verify");
    if (verify == nullptr) return {};
    return static_cast<std::uint64_t>(verify->integer);
}

Provenance shard_origin(ShardFolder const& folder, std::vector<Shard> const& shards, Scene const& scene) {
    if (shards.empty()) throw FileError(folder.path() + ": holds no finished members");
    std::vector<std::byte> bytes = folder.read(shards.front());
    Provenance origin = provenance_of(scene);
    if (scene.stores_members())
        origin.maker = stored_maker(NetcdfFile::open_in_memory(shards.front().name, std::move(bytes)));
    else
        parse_statistics(bytes, shards.front().name, &origin.maker);
    RunIdentity const& identity = folder.identity();
    origin.scene = with_tables(identity.scene, identity.tables);  // the copies go with the folder
    return origin;
}

}  // namespace slideway
