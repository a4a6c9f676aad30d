// Runs a study: members into shards, shards into one result file.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/backend/backend.hpp"
#include "host/config/scene.hpp"
#include "host/run/progress.hpp"
#include "host/run/ranks.hpp"
#include "host/run/stop.hpp"
#include "host/store/memory_file.hpp"
#include "host/store/output_target.hpp"
#include "host/store/shard_claim.hpp"
#include "host/store/shard_writer.hpp"
#include "host/study/ensemble_plan.hpp"
#include "host/study/tolerance_report.hpp"

namespace slideway {

/// One of the parts into which a job array divides a run.
struct RunPart {
    std::uint64_t number = 1, parts = 1;  // from 1
    bool of_array = false;                // also one of one: its shards wait for a merge
    std::string name() const;             // "3-of-8"; "" of a run that is no part
    /// Its members: consecutive ones, as evenly as they go.
    MemberSet of(MemberSet const& members) const;
};

/// The members that a part computes, of those asked for.  Of a continued sweep parts divide the starts, and each takes
/// all columns of its own: a member needs those before it, which another part would have to run again.
MemberSet members_of_part(Scene const& scene, RunPart const& part, MemberSet const& members);

struct StudyOptions {
    std::string output;
    bool force = false;  // a former result of another run is replaced
    MemberRange range;
    RunPart part;
    std::shared_ptr<Backend const> backend;
    int threads = 1;
    std::size_t block_members = 0;  // 0: as many as suit the run
    bool resume = false;
    bool shared = false;  // with other ranks
    Progress::Style progress = Progress::Style::none;
};

/// The folder of the shards of a result.
std::string shard_folder_of(std::string const& output);

/// What a study reads beside what the program brings: its scene and its tables.
std::vector<std::string> inputs_of(Scene const& scene);

/// What the ranks compute together.
struct StudyWork {
    MemberSet todo;
    std::uint64_t before = 0;    // members that earlier runs have finished
    ShortRun* brief = nullptr;  // of a run that has no folder yet
};

/// Integrates the members of `work.todo` with the threads of all ranks; at every rank.  Finished shards stay, whatever happens.
/// @return what all ranks came to, at rank 0; elsewhere nothing of worth.  @throws at rank 0 what any rank has thrown; never elsewhere
EnsembleTotals run_work(Scene const& scene, StudyOptions const& options, StudyWork const& work, Ranks& ranks,
                        StopRequest const& stop);

/// A run as rank 0 leads it.
class StudyRun {
public:
    /// Finds out what is left to do and tries the places where results go.  @throws FileError, SceneError
    StudyRun(Scene const& scene, StudyOptions const& options);

    /// The result was there before, complete.
    bool is_complete() const { return is_complete_; }
    OutputTarget const& target() const { return target_; }
    StudyWork const& work() const { return work_; }
    /// Shards that were not what had been written: their members run again.
    std::vector<DamagedShard> damaged() const { return claim_ ? claim_->damaged() : std::vector<DamagedShard>(); }
    /// See ShardClaim.
    std::string mended() const { return claim_ ? claim_->mended() : std::string(); }

    /// Members that have not run, of the part that is this run's.
    std::uint64_t left() const;
    /// Whether there is a folder that holds what has run.
    bool has_folder() const { return claim_ != nullptr && !brief_.block; }
    /// Makes the result file of all shards, or of the block of a run too short for any.  @param report where that of a scene that `asks_for_report` goes
    /// @return false if a signal came.  Without a file all that has run is in shards.
    bool merge(StopRequest const& stop, std::optional<ToleranceReport>& report);
    /// Removes the shards of a result that is there.  @return names of what is not of the run, and stays with the folder  @throws FileError
    std::vector<std::string> remove_shards() { return claim_ ? claim_->remove_folder() : std::vector<std::string>(); }

private:
    void require_room() const;
    bool may_be_short() const;
    void claim(ShardClaim::Wanted const& wanted);
    void merge_all(StopRequest const& stop, std::optional<ToleranceReport>& report);

    Scene const& scene_;
    StudyOptions const& options_;
    OutputTarget const target_;
    MemberSet const members_, mine_;
    bool is_complete_ = false;
    std::unique_ptr<ShardClaim> claim_;  // made by the writer's thread where `brief_` may do without
    ShortRun brief_;
    StudyWork work_;
};

/// Writes the block of a short run into shards after all.  @throws FileError
void put_into_shards(Scene const& scene, StudyOptions const& options, ShortRun& brief);

/// Whether a result of the scene has a report in its groups: a tolerance study, an ensemble with limits, and any that
/// keeps statistics in place of members.
bool asks_for_report(Scene const& scene);

/// What a study concludes from its members, into the file that has these: the report of a scene that `asks_for_report`.
void conclude_study(Scene const& scene, DataFile& file, std::optional<ToleranceReport>& report, ReportSettings const& settings);

/// What ends a merge once a signal came: it leaves no file, and the shards as they were.
struct MergeStopped {};
/// The `pause` of a merge that throws it.  What it refers to must outlive it.
std::function<void()> pause_of(StopRequest const& stop);

/// A result file of the shards in a folder; members without one have status not_run.  The shards stay.
/// @param report where that of a scene that `asks_for_report` goes  @param verify checks a complete result before it is closed
/// @return how many members have none.  @throws FileError
std::uint64_t merge_study(Scene const& scene, ShardFolder const& folder, std::vector<Shard> const& shards,
                          Provenance const& provenance, OutputTarget const& output,
                          std::optional<ToleranceReport>& report, ReportSettings const& settings = {},
                          std::function<void(DataFile&)> const& verify = {});

/// The `verify` of merge_study: the check of a result's resolution, as `study.verify` of the scene asks for it.  What it refers to must outlive it.
std::function<void(DataFile&)> resolution_check(Scene const& scene, Backend const& backend, int threads, StopRequest const& stop, Progress::Style progress);

/// The scene of the run that left a folder, its tables from the copies there.  @throws SceneError, also if one is gone;
/// FileError if it holds something else than what was run
Scene scene_of(ShardFolder const& folder);

/// `study.verify` of the run that made the shards, which no identity has: it changes no member.  Nothing also where members are not stored.
/// @throws FileError
std::optional<std::uint64_t> asked_check(ShardFolder const& folder, std::vector<Shard> const& shards, Scene const& scene);

/// Who made the shards in a folder, as the first of them says.  @throws FileError, also if there is none.
Provenance shard_origin(ShardFolder const& folder, std::vector<Shard> const& shards, Scene const& scene);

struct MemoryRun {
    std::shared_ptr<Backend const> backend;
    int threads = 1;
    bool verify = false;  // as study.verify says; the group `verification`
    Progress::Style progress = Progress::Style::none;  // on stderr
    StopRequest stop;
};

/// Integrates the members, or those that end before a stop: the others have status not_run.
/// @return what the result file of the same run holds, without its hashes
MemoryFile run_in_memory(Scene const& scene, MemoryRun const& run);
/// Bytes of such a result.
std::uint64_t memory_bytes(Scene const& scene);

}  // namespace slideway
