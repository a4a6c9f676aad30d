// A verification in a result file.
#include <algorithm>
#include <map>
#include <string_view>

#include "host/base/numbers.hpp"
#include "host/store/column.hpp"
#include "host/store/result_seal.hpp"
#include "host/study/verification.hpp"

namespace slideway {
namespace {

constexpr char const* sign_refuted = "refuted";

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
    auto const put = [&](std::string const& name, std::string const& unit, std::string const& meaning,
                         auto const& value) {
        std::vector<double> values(v.numbers.size());
        for (CheckedNumber const& n : v.numbers)
            values[n.group * v.study.columns.size() + n.column] = static_cast<double>(value(n));
        slideway::put(group, {name, unit, meaning, {"members_of", "checked"}, "members_of_name checked_name"}, values);
    };
    put("number", "", "what the study says, in the unit of checked_name", [](auto const& n) { return n.value; });
    put("number_half_width", "", "half the 95 % interval of it", [](auto const& n) { return n.half_width; });
    put("number_sd", "", "standard deviation of its members", [](auto const& n) { return n.spread; });
    put("difference", "", "mean over the pairs, check less study; of one method where that is larger",
        [](auto const& n) { return n.error.difference; });
    put("difference_half_width", "", "half the 95 % interval of the difference",
        [](auto const& n) { return n.error.half_width; });
    put("error_bound", "", "bound of the integration error", [](auto const& n) { return n.error.bound; });
    put("margin", "", "errors below it do not count", [](auto const& n) { return n.margin; });
    put("p_value", "1", "chance of such a difference if there were none, adjusted for all that was looked at",
        [](auto const& n) { return n.p; });
    put("pairs", "1", "members that ran again and came to their end", [](auto const& n) { return n.error.pairs; });
    put("cut", "1", "members that ran again and were cut short", [](auto const& n) { return n.cut; });
    put("verdict", "1", "0 resolved, 1 error bounded, 2 undecided, 3 not resolved",
        [](auto const& n) { return static_cast<int>(n.verdict); });
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
        std::vector<std::string> found;
        auto const at = variables.find(name);
        if (at == variables.end() || at->second.shape.size() != 2) return found;
        std::vector<signed char> const bytes = group->read<signed char>(at->second);
        std::size_t const width = at->second.shape[1];
        for (std::size_t i = 0; i < at->second.shape[0]; ++i) {
            std::string const padded(bytes.begin() + static_cast<std::ptrdiff_t>(i * width),
                                     bytes.begin() + static_cast<std::ptrdiff_t>((i + 1) * width));
            found.push_back(padded.substr(0, padded.find_last_not_of(std::string_view(" \0", 2)) + 1));
        }
        return found;
    };
    std::vector<std::string> const names = texts("checked_name"), groups = texts("members_of_name");
    std::vector<StoredVerdict> verdicts(names.size() * groups.size());
    for (std::size_t i = 0; i < verdicts.size(); ++i)
        verdicts[i] = {names[i % names.size()], groups[i / names.size()], nan, nan, nan, nan, nan, nan, nan, nan, {}};
    auto const put = [&](char const* name, auto const& into) {
        auto const at = variables.find(name);
        if (at == variables.end() || at->second.type != DataFile::Type::float64 || at->second.size() != verdicts.size())
            return false;
        std::vector<double> const values = group->read<double>(at->second);
        for (std::size_t i = 0; i < values.size(); ++i) into(verdicts[i], values[i]);
        return true;
    };
    bool const whole = put("number", [](auto& v, double x) { v.value = x; }) &&
                       put("number_half_width", [](auto& v, double x) { v.half_width = x; }) &&
                       put("number_sd", [](auto& v, double x) { v.sd = x; }) &&
                       put("difference", [](auto& v, double x) { v.difference = x; }) &&
                       put("error_bound", [](auto& v, double x) { v.error_bound = x; }) &&
                       put("margin", [](auto& v, double x) { v.margin = x; }) &&
                       put("pairs", [](auto& v, double x) { v.pairs = x; }) &&
                       put("cut", [](auto& v, double x) { v.cut = x; }) && put("verdict", [](auto& v, double x) {
                           v.verdict =
                               static_cast<Verdict>(x >= 0 && x < std::size(verdict_names) ? static_cast<int>(x) : 2);
                       });
    return whole ? verdicts : std::vector<StoredVerdict>{};
}

bool refutes_sign(ResultView const& results) {
    return results.group_attribute(verification_group, "exponent_sign") == sign_refuted;
}

}  // namespace slideway
