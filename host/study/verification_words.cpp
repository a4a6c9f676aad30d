// What a check comes to, and how the program says it.
#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/numbers.hpp"
#include "host/config/outputs.hpp"
#include "host/store/column.hpp"
#include "host/store/result_seal.hpp"
#include "host/study/verification.hpp"

namespace slideway {
namespace {

constexpr std::size_t most_named = 5;  // members that were cut short

std::size_t pairs_by(Verification const& v, std::size_t method) {
    return static_cast<std::size_t>(std::ranges::count_if(v.pairs, [&](CheckPair const& pair) { return pair.method == method && pair.finished; }));
}

/// "41 members again, 24 by auto at rtol 1e-08 and 17 by verner65 at rtol 1e-08 (8.1 % of the study's work)"
std::string who_ran(Verification const& v) {
    std::vector<std::string> by;
    std::size_t ran = 0;
    for (std::size_t method = 0; method < v.methods.size(); ++method) {
        std::size_t const count = pairs_by(v, method);
        if (method < 2 || v.orbit) ran += count;
        if (count > 0) by.push_back(fmt::format("{} by {}", count, v.methods[method].words));
    }
    std::string const again = ran == 0 ? "no member again to its end" : ran == 1 ? "1 member again" : fmt::format("{} members again", ran);
    by.insert(by.begin(), again);
    return fmt::format("{} ({:.2g} % of the study's work)", fmt::join(by, ", "), 100 * v.share);
}

/// Members that no method brought to their end, by number; and how many one left to the other.
std::string who_was_cut(Verification const& v) {
    std::vector<std::uint64_t> cut;
    for (CheckPair const& pair : v.pairs) {
        if (!pair.finished) cut.push_back(v.members[pair.row]);
    }
    std::string text;
    if (!cut.empty()) {
        std::ranges::sort(cut);
        cut.erase(std::unique(cut.begin(), cut.end()), cut.end());
        std::size_t const named = std::min(cut.size(), most_named);
        text += fmt::format("\n  cut short: member{} {}{}", cut.size() == 1 ? "" : "s", fmt::join(cut.begin(), cut.begin() + static_cast<std::ptrdiff_t>(named), ", "),
                            cut.size() > named ? fmt::format(" and {} more", cut.size() - named) : "");
    }
    for (std::size_t method = 0; method < v.cut.size(); ++method) {
        if (v.cut[method] > 0 && !v.orbit)
            text += fmt::format("\n  {} did not bring {} of them to their end", v.methods[method].words, v.cut[method]);
    }
    return text;
}

/// A number that is not resolved because others are not, or because nobody has seen it (follow_others).
bool follows(CheckedNumber const& n) { return n.verdict != Verdict::resolved && n.agrees_as_all_do(); }

/// How contacts end is said of nobody: it counts where it tells that something differs.
bool counts(Verification const& v, CheckedNumber const& n) {
    return !follows(n) && (v.study.columns[n.column].kind != MemberNumbers::Kind::contacts || n.verdict == Verdict::not_resolved);
}

std::string name_of(Verification const& v, CheckedNumber const& n) {
    auto const& column = v.study.columns[n.column];
    std::string const& group = v.groups[n.group].name;
    return group.empty() ? column.name : fmt::format("{}, {}", column.name, group);
}

/// "peak_normal_force: 740 ± 12 N, error at most 31 N"
std::string line_of(Verification const& v, CheckedNumber const& n) {
    std::string const& unit = v.study.columns[n.column].unit;
    std::string const shown = unit == "1" ? "" : " " + unit;
    std::string text = fmt::format("\n  {}: {:.4g}", name_of(v, n), n.value);
    if (n.half_width > 0) text += fmt::format(" ± {:.2g}", n.half_width);
    text += shown;
    if (n.verdict == Verdict::not_resolved) {
        text += fmt::format(", off by {:.3g}{}", -n.error.difference, shown);
        if (n.error.half_width > 0) text += fmt::format(" ± {:.2g}", n.error.half_width);
        if (n.error.pairs > 1 && !v.orbit) text += fmt::format(" (p = {:.1g})", n.p);
        if (n.refutes_sign) text += ": its sign is refuted";
    } else if (n.cut > 0) {
        text += fmt::format(", undecided: {} of those that ran again did not come to their end", n.cut);
    } else if (std::isnan(n.error.bound)) {
        text += ", undecided: fewer than two of its members ran again";
    } else {
        text += fmt::format(", error at most {:.2g}{}", n.error.bound, shown);
        if (n.verdict == Verdict::bounded && n.error.bound <= n.margin) text += " by one method alone";
        if (n.verdict == Verdict::undecided) text += v.orbit ? ": undecided" : ": undecided, for its members scatter by no more";
    }
    return text;
}

/// Rows of the numbers with a verdict, the largest error in their intervals first.
std::string lines_of(Verification const& v, Verdict verdict) {
    constexpr std::size_t most = 12;
    std::vector<CheckedNumber const*> found;
    for (CheckedNumber const& n : v.numbers) {
        if (n.verdict == verdict && counts(v, n)) found.push_back(&n);
    }
    std::ranges::stable_sort(found, [](auto const* a, auto const* b) {
        double const x = a->error.bound / a->margin, y = b->error.bound / b->margin;
        return (std::isnan(x) ? 0 : x) > (std::isnan(y) ? 0 : y);
    });
    std::string text;
    for (std::size_t i = 0; i < std::min(found.size(), most); ++i) text += line_of(v, *found[i]);
    if (found.size() > most) text += fmt::format("\n  and {} more, which the group verification of the file has", found.size() - most);
    return text;
}

/// "\n  resolved: drive_work; friction_loss", of the numbers that are so; nothing where none is.
template <class IsSo> std::string names_of(Verification const& v, std::string_view what, IsSo is_so) {
    constexpr std::size_t most = 24;
    std::vector<std::string> names;
    for (CheckedNumber const& n : v.numbers) {
        if (is_so(n)) names.push_back(name_of(v, n));
    }
    if (names.empty()) return "";
    std::size_t const shown = std::min(names.size(), most);
    return fmt::format("\n  {}: {}{}", what, fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), "; "),
                       names.size() > shown ? fmt::format(" and {} more", names.size() - shown) : "");
}

/// Of numbers that no line of their own tells of.
std::string rest_of(Verification const& v) {
    std::string const resolved = names_of(v, "resolved", [&](CheckedNumber const& n) { return n.verdict == Verdict::resolved && counts(v, n); });
    return (v.resolution == Resolution::resolved ? "" : resolved) +
           names_of(v, "0 in all members that were looked at, and in those that ran again", [&](CheckedNumber const& n) {
               return follows(n) && n.is_unseen() && v.study.columns[n.column].kind != MemberNumbers::Kind::contacts;
           });
}

std::string remedy(Verification const& v, Scene const& scene) {
    if (has_fixed_step(scene.integrator.method)) return "use a smaller integrator.step, or method = \"auto\"";
    double const rtol = std::min(check_tightening * scene.integrator.rtol, coarsest_check);
    std::string const tighter = fmt::format("integrator.rtol = {:.0e} and atol likewise", rtol);
    bool const own = scene.integrator.method == Method::automatic || v.methods.front().words.starts_with(name_of(scene.integrator.method));
    return own ? "use " + tighter : fmt::format("use {}, or method = \"auto\"", tighter);
}

std::string energy_of(Verification const& v) {
    if (!v.energy) return "";
    return fmt::format("\n  energy audit: the integration makes {:.2g} % of the energy of the slider's fall through its clearance in a period of the drive{}",
        100 * v.energy->share, v.energy->is_too_much ? ": too much for exponents" : "");
}

/// Until when one orbit is the equations'.
std::string orbit_words(Verification const& v) {
    if (!v.orbit) return "";
    OrbitCheck const& orbit = *v.orbit;
    bool const parts = orbit.parting <= orbit.end;
    std::string text =
        parts ? fmt::format(
                    "\n  its orbit is off by more than a hundredth of the clearance from t = {:.4g} s of {:.4g} s on: "
                    "later numbers are one orbit's of many, "
                    "so run many members",
                    orbit.parting, orbit.end)
              : fmt::format("\n  its orbit is the same within a hundredth of the clearance over all of {:.4g} s", orbit.end);
    if (orbit.sections > 0) text += fmt::format("; {} of {} sections are the same", orbit.sections_before, orbit.sections);
    return text;
}

/// What a bound is to the members' scatter, and what more repeats would bring.
std::string reach_of(Verification const& v, VerificationRequest const& request) {
    double of_spread = 0, of_interval = 0;
    for (CheckedNumber const& n : v.numbers) {
        if (n.verdict == Verdict::resolved || !(n.spread > 0) || !(n.half_width > 0) || std::isnan(n.error.bound)) continue;
        of_spread = std::max(of_spread, n.error.bound / n.spread);
        of_interval = std::max(of_interval, n.error.bound / n.half_width);
    }
    if (!(of_spread > 0)) return "";
    std::string text = fmt::format("\n  the largest bound is {:.2g} of its members' standard deviation, {:.2g} of its interval", of_spread, of_interval);
    // Where orbits part, pairs are as good as independent, and a repeat of all comes to 2.58 √2/1.96 of a mean's interval.
    if (!request.members) text += "; run --verify repeats all members if need be: where orbits part, some 1.9 intervals";
    return text;
}

std::string summarise(Verification const& v, Scene const& scene, VerificationRequest const& request) {
    std::string const again = who_ran(v), cut = who_was_cut(v), tail = orbit_words(v) + energy_of(v);
    std::string const rest = rest_of(v);
    switch (v.resolution) {
        case Resolution::resolved:
            return fmt::format("resolved: {}: the integration error of each number is below {}", again,
                               v.orbit ? "a thousandth of it" : "half its 95 % interval, or a thousandth of it") +
                   rest + tail;
        case Resolution::not_resolved:
            return fmt::format("NOT RESOLVED by {}: {}", v.settings, again) + lines_of(v, Verdict::not_resolved) + rest + cut + tail + "\n  " + remedy(v, scene);
        case Resolution::undecided:
            return "undecided: " + again + lines_of(v, Verdict::undecided) + lines_of(v, Verdict::bounded) + rest + cut + reach_of(v, request) + tail;
        case Resolution::bounded: case Resolution::not_checked: break;
    }
    return "error bounded, not resolved: " + again + lines_of(v, Verdict::bounded) + rest + cut + reach_of(v, request) + tail;
}

}  // namespace

void conclude(Verification& v, Scene const& scene, VerificationRequest const& request) {
    auto const any = [&](Verdict verdict) {
        return std::ranges::any_of(v.numbers, [&](CheckedNumber const& n) { return n.verdict == verdict && counts(v, n); });
    };
    bool const parts = v.orbit && (v.orbit->parting <= v.orbit->end || v.orbit->sections_before < v.orbit->sections);
    if (any(Verdict::not_resolved) || (v.energy && v.energy->is_too_much))
        v.resolution = Resolution::not_resolved;
    else if (any(Verdict::undecided) || parts)
        v.resolution = Resolution::undecided;
    else if (any(Verdict::bounded))
        v.resolution = Resolution::bounded;
    else  // of numbers that are all 0 nothing was compared, but of one orbit its course
        v.resolution = v.orbit || any(Verdict::resolved) ? Resolution::resolved : Resolution::undecided;
    v.summary = summarise(v, scene, request);
}

// A verification in a result file.

namespace {

constexpr char const *sign_refuted = "refuted", *verdict_name = "verdict";

/// A number of each that was checked, along `members_of` and `checked`.
struct StoredNumber {
    char const *name, *unit, *meaning;
    double (*of)(CheckedNumber const& n);
    double StoredVerdict::*into;  // what is read back; nullptr: nothing, or the verdict
};
constexpr StoredNumber number_table[] = {
    {"number", "", "what the study says, in the unit of checked_name", [](CheckedNumber const& n) { return n.value; }, &StoredVerdict::value},
    {"number_half_width", "", "half the 95 % interval of it", [](CheckedNumber const& n) { return n.half_width; }, &StoredVerdict::half_width},
    {"number_sd", "", "standard deviation of its members", [](CheckedNumber const& n) { return n.spread; }, &StoredVerdict::sd},
    {"difference", "", "mean over the pairs, check less study; of one method where that is larger",
     [](CheckedNumber const& n) { return n.error.difference; }, &StoredVerdict::difference},
    {"difference_half_width", "", "half the 95 % interval of the difference", [](CheckedNumber const& n) { return n.error.half_width; }, nullptr},
    {"error_bound", "", "bound of the integration error", [](CheckedNumber const& n) { return n.error.bound; }, &StoredVerdict::error_bound},
    {"margin", "", "errors below it do not count", [](CheckedNumber const& n) { return n.margin; }, &StoredVerdict::margin},
    {"p_value", "1", "chance of such a difference if there were none, adjusted for all that was looked at",
     [](CheckedNumber const& n) { return n.p; }, nullptr},
    {"pairs", "1", "members that ran again and came to their end", [](CheckedNumber const& n) { return static_cast<double>(n.error.pairs); },
     &StoredVerdict::pairs},
    {"cut", "1", "members that ran again and were cut short", [](CheckedNumber const& n) { return static_cast<double>(n.cut); }, &StoredVerdict::cut},
    {verdict_name, "1", "0 resolved, 1 error bounded, 2 undecided, 3 not resolved",
     [](CheckedNumber const& n) { return static_cast<double>(n.verdict); }, nullptr},
};

/// Members that ran again: what they had come to, and what they came to then.
void write_pairs(DataFile& group, Verification const& v) {
    std::vector<std::string> checks;
    for (CheckMethod const& method : v.methods) checks.push_back(method.words);
    put_labels(group, "check", "by which members ran again", checks);
    put_labels(group, "source", "by which a member ran", {"study", "check"});
    group.add_dimension("pair", v.pairs.size());
    std::vector<double> members, methods, finished, values;
    for (CheckPair const& pair : v.pairs) {
        members.push_back(static_cast<double>(v.members[pair.row]));
        methods.push_back(static_cast<double>(pair.method));
        finished.push_back(pair.finished);
    }
    for (std::size_t column = 0; column < v.study.columns.size(); ++column) {
        for (CheckPair const& pair : v.pairs) values.push_back(v.study.columns[column].values[pair.row]);
        values.insert(values.end(), v.again[column].begin(), v.again[column].end());
    }
    slideway::put(group, {"pair_member", "1", "member that ran again", {"pair"}}, members);
    slideway::put(group, {"pair_check", "1", "by which check, from 0", {"pair"}}, methods);
    slideway::put(group, {"pair_finished", "1", "1 where it came to its end", {"pair"}}, finished);
    slideway::put(group, {"value",
               "",
               "what a member came to, in the unit of checked_name",
               {"checked", "source", "pair"},
               "checked_name source_name"},
              values);
}

void write_numbers(DataFile& group, Verification const& v) {
    std::vector<std::string> columns, groups;
    for (auto const& column : v.study.columns) columns.push_back(column.name + " [" + column.unit + "]");
    for (MemberGroup const& one : v.groups) groups.push_back(one.name.empty() ? "all members" : one.name);
    put_labels(group, "checked", "number that is checked, with its unit", columns);
    put_labels(group, "members_of", "members that a number is of", groups);
    for (StoredNumber const& one : number_table) {
        std::vector<double> values(v.numbers.size());
        for (CheckedNumber const& n : v.numbers) values[n.group * v.study.columns.size() + n.column] = one.of(n);
        put(group, {one.name, one.unit, one.meaning, {"members_of", "checked"}, "members_of_name checked_name"}, values);
    }
}

}  // namespace

void write_verification(DataFile& file, Verification const& v) {
    auto const held = file.add_group(verification_group);
    DataFile& group = *held;
    group.put(DataFile::global, "resolution", std::string(resolution_names[static_cast<int>(v.resolution)]));
    group.put(DataFile::global, "summary", v.summary);
    group.put(DataFile::global, "settings", v.settings);
    group.put(DataFile::global, "share_of_work", v.share);
    bool const refuted = std::ranges::any_of(v.numbers, &CheckedNumber::refutes_sign);
    group.put(DataFile::global, "exponent_sign", std::string(refuted ? sign_refuted : "kept"));
    if (v.orbit) {
        group.put(DataFile::global, "orbit_end", v.orbit->end);
        group.put(DataFile::global, "orbit_parting", v.orbit->parting);
    }
    if (v.numbers.empty()) return;
    write_numbers(group, v);
    write_pairs(group, v);
}

std::optional<std::string> verification_summary(ResultView const& results) {
    std::string summary = results.group_attribute(verification_group, "summary");
    if (summary.empty()) return std::nullopt;
    return summary;
}

std::vector<StoredVerdict> stored_verdicts(ResultView const& results) {
    auto const group = results.group(verification_group);
    if (!group) return {};
    std::map<std::string, DataFile::Variable> variables;
    for (DataFile::Variable& variable : group->variables()) variables.emplace(variable.name, variable);
    auto const texts = [&](char const* name) {
        auto const at = variables.find(name);
        return at == variables.end() ? std::vector<std::string>() : read_texts(*group, at->second);
    };
    std::vector<std::string> const names = texts("checked_name"), groups = texts("members_of_name");
    std::vector<StoredVerdict> verdicts(names.size() * groups.size());
    for (std::size_t i = 0; i < verdicts.size(); ++i)
        verdicts[i] = {words_of_now(names[i % names.size()]), groups[i / names.size()], nan, nan, nan, nan, nan, nan, nan, nan, {}};
    for (StoredNumber const& one : number_table) {
        bool const is_verdict = one.name == verdict_name;
        if (one.into == nullptr && !is_verdict) continue;
        auto const at = variables.find(one.name);
        if (at == variables.end() || at->second.type != DataFile::Type::float64 || at->second.size() != verdicts.size()) return {};
        std::vector<double> const values = group->read<double>(at->second);
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (is_verdict)
                verdicts[i].verdict = static_cast<Verdict>(values[i] >= 0 && values[i] < std::size(verdict_names) ? static_cast<int>(values[i]) : 2);
            else
                verdicts[i].*one.into = values[i];
        }
    }
    return verdicts;
}

bool refutes_sign(ResultView const& results) {
    return results.group_attribute(verification_group, "exponent_sign") == sign_refuted;
}

}  // namespace slideway
