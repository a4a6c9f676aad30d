// Whether a study's numbers are the equations' or the integration's: some of its members run again with tighter tolerances and by another
// method, and what the study says of them is compared.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/backend/backend.hpp"
#include "host/config/scene.hpp"
#include "host/run/stop.hpp"
#include "host/statistics/paired_comparison.hpp"
#include "host/store/data_file.hpp"
#include "host/store/result_view.hpp"
#include "host/study/member_numbers.hpp"

namespace slideway {

/// A way to run members again.
struct CheckMethod {
    std::string words;  // "dopri5 at rtol 1e-08"
    Scene scene;        // the study's, integrated in that way, without time series
    double cost;        // what a member takes, roughly, in units of what it took in the study
    bool audits_energy = false;  // the study's own orbits once more, under a law that keeps energy
};

/// What a check makes of rtol and atol.
inline constexpr double check_tightening = 0.01;

/// How a study is checked: by its own method with a hundredth of the tolerance (a quarter of a fixed step), and by another method with a
/// hundredth of it; where exponents are asked for, also by its own with neighbours ten times as far.
std::vector<CheckMethod> check_methods(Scene const& scene);

/// What is run again stores no time series.
Scene without_series(Scene scene);

/// "dopri5 at rtol 1e-08"
std::string words_of(IntegratorSettings const& settings);

/// What one check says of one column.
struct CheckedColumn {
    std::size_t column = 0, method = 0;
    double relevant = 0;        // differences below it do not count
    PairedComparison pairs;
    double welch = 0;           // mean of the check less that of all members of the study
    double p = 1;               // the lesser of its two, adjusted for all that were looked at (Holm)
    bool differs = false;       // beyond chance, and relevant
    bool refutes_sign = false;  // of an exponent's mean: certain in the study, and not so, or the other, here; differs too
};

/// Members that run again unasked.
inline constexpr std::uint64_t most_checked = 16;
/// Fewer pairs are not tested.
inline constexpr std::size_t least_members = 6;

/// Looks at every column of every check.  @param numbers the study's, and of each check  @param whole of the study's columns over all of its
/// members, as far as they are known  @param all how many those are
/// @return one per column and check
std::vector<CheckedColumn> compare(std::vector<MemberNumbers> const& numbers, Scene const& scene,
                                   std::vector<WholeColumn> const& whole, std::uint64_t all);

/// What the slider's fall through its clearance gives [J], M g c + M (cΩ)².
double fall_energy(Scene const& scene);

/// Of a law that keeps energy: what the integration makes of it.
struct EnergyCheck {
    double share;     // mean of what members made a period of the drive, of fall_energy
    bool is_too_much; // for exponents of that motion: above a hundredth
};
/// Nothing where no member tells.
std::optional<EnergyCheck> audit_energy(MemberNumbers const& numbers, Scene const& scene);

enum class Resolution { resolved, not_resolved, not_checked };

struct Verification {
    Resolution resolution = Resolution::not_checked;
    std::string settings;                  // the study's own: "auto at rtol 1e-06"
    std::vector<std::uint64_t> members;    // that ran again
    std::vector<std::string> methods;      // [checks]
    std::vector<std::size_t> finished;     // [checks] members that did
    double share = 0;                      // of the study's work
    std::vector<MemberNumbers> numbers;    // the study's, and of each check
    std::vector<CheckedColumn> findings;   // one per column and check
    std::optional<EnergyCheck> energy;     // of a study with exponents
    std::string summary;                   // lines of words, the first one says it all
};

/// What it may take.
struct VerificationRequest {
    std::optional<std::uint64_t> members;  // as many, whatever it costs; none: up to 16, within a tenth of the study's work
    int threads = 1;
    StopRequest const* stop = nullptr;     // ends it: not_checked
    Progress::Style progress = Progress::Style::none;
};

/// What a check is foreseen to take beside its study, in the work of as many of the study's members; 0 where there will be none.
/// @param asked as in VerificationRequest  @param all members that the study has run
double foreseen_check(Scene const& scene, std::optional<std::uint64_t> asked, std::uint64_t all);

/// Checks a study whose members are all in a result.  Deterministic: what is run again follows from the scene and from what members took,
/// which do not depend on threads or machines.  Differences count where they are beyond chance: a paired t-test of the mean, Welch's against
/// all members of the study (of a dozen members or more, and numbers that are not skewed), a two-sample Kolmogorov–Smirnov test of the
/// distribution, adjusted by Holm, one false alarm in fifty studies.  And where they are relevant: larger than half the 95 % interval of the
/// study's mean and a thousandth of it; of times, than a ten-thousandth of the run's; of energies, than that of what the slider's fall
/// through its clearance gives.  The energy residual of a law that keeps energy is the integration's own error, and is not compared.
Verification verify(ResultView const& results, Scene const& scene, Backend const& backend,
                    VerificationRequest const& request);

/// The group `verification`: who ran again, how, what came out, and `summary`; it is no part of the payload hash.
void write_verification(DataFile& file, Verification const& verification);

/// Its words as a result file has them; nothing where it has none.
std::optional<std::string> verification_summary(ResultView const& results);
/// Whether the sign of its exponents is not that of the equations.
bool refutes_sign(ResultView const& results);

}  // namespace slideway
