// Whether a study's numbers are the equations' or the integration's: some of its members run again with tighter tolerances, by the study's method
// and by another one, and what they differ by bounds the error of what the study says.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/backend/backend.hpp"
#include "host/config/scene.hpp"
#include "host/run/stop.hpp"
#include "host/statistics/error_bound.hpp"
#include "host/store/data_file.hpp"
#include "host/store/result_view.hpp"
#include "host/study/member_numbers.hpp"

namespace slideway {

/// A way to run members again.
struct CheckMethod {
    std::string words;  // "dopri5 at rtol 1e-08"
    Scene scene;        // the study's, integrated in that way, without time series
    double cost;        // what a member takes, roughly, in units of what it took in the study
    double work_of_a_step = 14;  // right-hand sides at most, on average: nine stages, and what ends of steps at events take
    bool of_exponents = false;   // the study's own orbits once more, with neighbours farther off: of exponents alone
    double error_per_difference = 1;  // of the study, as far as it errs in the same way with other steps
    bool audits_energy = false;  // under a law that keeps energy
};

/// What a check makes of rtol and atol.
inline constexpr double check_tightening = 0.01;
/// Tolerances above may not be the equations' yet, whatever they are a hundredth of.
inline constexpr double coarsest_check = 1e-6;

/// How a study is checked.  First by its own method with a hundredth of the tolerance, at most 1e-6 (a quarter of a fixed step); an explicit one by `auto` where that
/// has a stiff method.  Second by an explicit method that neither the study nor `auto` takes; where exponents are asked for also by the study's own
/// with neighbours ten times as far.
std::vector<CheckMethod> check_methods(Scene const& scene);

/// What is run again stores no time series.
Scene without_series(Scene scene);

/// "dopri5 at rtol 1e-08"
std::string words_of(IntegratorSettings const& settings);

/// A member that ran again, and by which method; it ran to its end there, or was cut short.
struct CheckPair {
    std::size_t row, method;
    bool finished;
};

/// What a number is worth, the best first.
enum class Verdict { resolved, bounded, undecided, not_resolved };
inline constexpr char const* verdict_names[] = {"resolved", "error_bounded", "undecided", "not_resolved"};

/// What a check says of one number of one group.
struct CheckedNumber {
    std::size_t column, group;
    double value, half_width;  // what the study says, and half its 95 % interval
    double spread;             // standard deviation of its members
    double unseen;             // what a member may be off by that no pair stands for
    double margin;             // errors below it do not count
    double least_felt;         // differences below it are bounded, and no alarm: margin or more
    ErrorBound error;
    bool two_methods = false;  // each has a quarter of the pairs or more: one alone may err as the study does
    double p = 1;              // of a difference by chance, adjusted for all that were looked at (Holm)
    std::size_t cut = 0;       // members that ran again and did not come to their end
    bool refutes_sign = false;  // of an exponent: certain in the study, and not so, or the other, here
    Verdict verdict = Verdict::undecided;

    /// Nothing but rounding, in all members and in all that ran again.
    bool is_unseen() const { return agrees_as_all_do() && std::abs(value) <= margin; }
    /// All members are alike, and those that ran again, by each method, are so too.
    bool agrees_as_all_do() const { return spread == 0 && two_methods && cut == 0 && error.bound <= margin; }
};

/// What the slider's fall through its clearance gives [J], M g c + M (cΩ)².
double fall_energy(Scene const& scene);

/// Of a law that keeps energy: what the integration makes of it.
struct EnergyCheck {
    double share;     // mean of what members made a period of the drive, of fall_energy
    bool is_too_much; // for exponents of that motion: above a hundredth
};
/// Nothing where no member tells.  @param residuals [J]
std::optional<EnergyCheck> audit_energy(std::vector<double> const& residuals, Scene const& scene);

/// One member beside itself: until when its orbit is the same.
struct OrbitCheck {
    double end;                 // [s]
    double parting;             // [s] from which it is off by more than a hundredth of the joint's scales; infinite if never
    std::size_t sections = 0, sections_before = 0;  // of the study; those before it parts
};

enum class Resolution { resolved, bounded, undecided, not_resolved, not_checked };
inline constexpr char const* resolution_names[] = {"resolved", "error_bounded", "undecided", "not_resolved", "not_checked"};

struct Verification {
    Resolution resolution = Resolution::not_checked;
    std::string settings;                 // the study's own: "auto at rtol 1e-06"
    std::vector<CheckMethod> methods;     // [checks]
    std::vector<std::size_t> cut;         // [checks] members that did not come to their end by it
    double share = 0;                     // of the study's work
    MemberNumbers study;                  // [rows]
    std::uint64_t all = 0;                // members of the study, where `study` has some of them alone; else as many as it has
    std::vector<std::uint64_t> members;   // [rows] their numbers
    std::vector<char> draws;              // [rows] those that the study's means and intervals are of
    std::vector<MemberGroup> groups;
    std::vector<CheckPair> pairs;
    std::vector<std::vector<double>> again;  // [columns][pairs]
    std::vector<CheckedNumber> numbers;   // [groups][columns]
    std::optional<EnergyCheck> energy;    // of a study with exponents
    std::optional<OrbitCheck> orbit;      // of a study of one member
    std::string summary;                  // lines of words, the first one says it all
};

/// Bounds every number of every group by the pairs that there are.  @return [groups][columns]
std::vector<CheckedNumber> check_numbers(Verification const& v, Scene const& scene);

/// What it may take.
struct VerificationRequest {
    /// Members that may run again, whatever it costs; none: as many as a tenth of the study's work allows.
    std::optional<std::uint64_t> members;
    int threads = 1;
    StopRequest const& stop = never_stops;  // ends it: not_checked
    Progress::Style progress = Progress::Style::none;
};
/// Fewer pairs are not begun with.
inline constexpr std::size_t least_members = 6;

/// What a check is foreseen to take at most beside its study, in the work of as many of the study's members; 0 where there will be none.
/// @param asked as in VerificationRequest  @param all members that the study has run
double foreseen_check(Scene const& scene, std::optional<std::uint64_t> asked, std::uint64_t all);

/// Checks a study whose members are all in a result.  Deterministic: what is run again follows from the scene and from what members took,
/// which do not depend on threads or machines.  Members are drawn (CheckSample) and added until every number is decided, or the budget is spent.
/// Of a number x is the bound of its integration error (`error_bound`), m the larger of half the study's own 95 % interval and a thousandth of the
/// number, and at least 1e-9 of what a fall through the clearance comes to (J, m, rad, N, m/s; of times of the run's): rounding.
///   resolved      x <= m
///   not_resolved  the mean difference is beyond chance (2 % of studies, Holm), larger than m and than 1e-4 of that scale
///   bounded       else: the error is at most x
///   undecided     members were cut short, fewer than two ran again, x is above their standard deviation and says nothing, or the number is 0 in
///                 all members and all that ran again, which is told and speaks against no study
/// The energy residual of a law that keeps energy is the integration's own error, and is not compared.
Verification verify(ResultView const& results, Scene const& scene, Backend const& backend,
                    VerificationRequest const& request);

inline constexpr char const* check_was_stopped = "not checked against tighter tolerances: the run was stopped";

/// A study of one member, or of copies of one: its orbit beside those of the checks.
Verification verify_orbit(Scene const& scene, Backend const& backend, VerificationRequest const& request);

/// The verdict over all numbers, and its words.
void conclude(Verification& v, Scene const& scene, VerificationRequest const& request);

/// The group `verification`: who ran again, how, what came out, and `summary`; it is no part of the payload hash.
void write_verification(DataFile& file, Verification const& verification);

/// Its words as a result file has them; nothing where it has none.
std::optional<std::string> verification_summary(ResultView const& results);
/// One of its numbers there.
struct StoredVerdict {
    std::string name, members_of;  // "friction_loss [J]"; "all members"
    double value, half_width, sd, difference, error_bound, margin, pairs, cut;
    Verdict verdict;
};
/// Empty where the file has none, or was written by another version.
std::vector<StoredVerdict> stored_verdicts(ResultView const& results);
/// Whether the sign of its exponents is not that of the equations.
bool refutes_sign(ResultView const& results);

}  // namespace slideway
