// A verification in a result file.
#include <algorithm>
#include <map>

#include "host/base/numbers.hpp"
#include "host/config/outputs.hpp"
#include "host/store/column.hpp"
#include "host/store/result_seal.hpp"
#include "host/study/verification.hpp"

namespace slideway {
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
    put_labels(group, "check", "by which members ran again", v.methods);
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
