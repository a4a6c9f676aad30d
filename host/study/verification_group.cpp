// A verification in a result file.
#include <algorithm>

#include "host/base/numbers.hpp"
#include "host/store/group_writer.hpp"
#include "host/store/result_seal.hpp"
#include "host/study/verification.hpp"

namespace slideway {
namespace {

constexpr char const* sign_refuted = "refuted";
constexpr char const* resolution_names[] = {"resolved", "not_resolved", "not_checked"};

/// Of each column and check, in the order of their dimensions.
template <class Value> std::vector<double> of_findings(Verification const& v, std::size_t width, Value const& value) {
    std::size_t const columns = v.numbers.front().columns.size();
    std::vector<double> values(columns * v.methods.size() * width, nan);
    for (CheckedColumn const& found : v.findings) {
        for (std::size_t i = 0; i < width; ++i)
            values[(found.column * v.methods.size() + found.method) * width + i] = value(found, i);
    }
    return values;
}

void write_numbers(GroupWriter& group, Verification const& v) {
    std::vector<std::string> columns, sources{"study"};
    for (auto const& column : v.numbers.front().columns) columns.push_back(column.name + " [" + column.unit + "]");
    sources.insert(sources.end(), v.methods.begin(), v.methods.end());
    group.labels("checked", "number that is compared, with its unit", columns);
    group.labels("source", "by which members ran", sources);
    group.labels("check", "by which members ran again", v.methods);
    group.labels("bound", "end of an interval", {"low", "high"});
    group.dimension("verified", v.members.size());
    std::vector<double> const members(v.members.begin(), v.members.end());
    group.put({"verified_member", "1", "member that ran again", {"verified"}}, members);

    std::vector<double> values, work;
    for (std::size_t column = 0; column < columns.size(); ++column) {
        for (MemberNumbers const& source : v.numbers) {
            auto const& of_source = source.columns[column].values;
            values.insert(values.end(), of_source.begin(), of_source.end());
        }
    }
    for (MemberNumbers const& source : v.numbers) work.insert(work.end(), source.work.begin(), source.work.end());
    group.put({"value", "", "what a member came to, in the unit of checked_name", {"checked", "source", "verified"}, "checked_name source_name"}, values);
    group.put({"work", "1", "right-hand sides of a member, a Jacobian counting one and a half", {"source", "verified"}, "source_name"}, work);
    std::string const labels("checked_name check_name");
    group.put({"difference", "", "mean over the members, check less study, in the unit of checked_name", {"checked", "check"}, labels},
              of_findings(v, 1, [](CheckedColumn const& f, std::size_t) { return f.pairs.difference; }));
    group.put({"difference_interval", "", "95 % confidence interval of the difference", {"checked", "check", "bound"}, labels},
              of_findings(v, 2, [](CheckedColumn const& f, std::size_t i) { return i == 0 ? f.pairs.interval.low : f.pairs.interval.high; }));
    group.put({"p_value", "1", "chance of what was found if nothing differed, adjusted for all that was compared", {"checked", "check"}, labels},
              of_findings(v, 1, [](CheckedColumn const& f, std::size_t) { return f.p; }));
    group.put({"differs", "1", "1 where study and check differ beyond chance", {"checked", "check"}, labels},
              of_findings(v, 1, [](CheckedColumn const& f, std::size_t) { return f.differs ? 1.0 : 0.0; }));
}

}  // namespace

void write_verification(DataFile& file, Verification const& v) {
    GroupWriter group(file, verification_group);
    group.attribute("resolution", std::string(resolution_names[static_cast<int>(v.resolution)]));
    group.attribute("summary", v.summary);
    group.attribute("settings", v.settings);
    group.attribute("share_of_work", v.share);
    bool const refuted = std::any_of(v.findings.begin(), v.findings.end(), [](CheckedColumn const& f) { return f.refutes_sign; });
    group.attribute("exponent_sign", std::string(refuted ? sign_refuted : "kept"));
    if (!v.findings.empty()) write_numbers(group, v);
}

std::optional<std::string> verification_summary(ResultView const& results) {
    std::string summary = results.group_attribute(verification_group, "summary");
    if (summary.empty()) return std::nullopt;
    return summary;
}

bool refutes_sign(ResultView const& results) {
    return results.group_attribute(verification_group, "exponent_sign") == sign_refuted;
}

}  // namespace slideway
