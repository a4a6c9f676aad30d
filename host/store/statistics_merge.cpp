#include "host/store/statistics_merge.hpp"

#include <array>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "host/store/label_axes.hpp"
#include "host/store/result_definition.hpp"
#include "host/store/result_merge.hpp"

namespace slideway {
namespace {

using Type = NetcdfFile::Type;

/// A variable along one dimension, or without, and its values.
class ColumnWriter {
public:
    explicit ColumnWriter(NetcdfFile& file) : file_(file) {}

    template <class T>
    int column(std::string const& name, Type type, std::string const& dimension, std::string_view unit,
               std::string_view long_name, std::vector<T> const& values) {
        std::array const dimensions{file_.dimension(dimension)};
        int const variable = file_.add_variable(name, type, dimensions);
        describe(variable, unit, long_name);
        file_.write(variable, std::array{std::size_t{0}}, std::array{values.size()}, values.data());
        return variable;
    }
    void scalar(std::string const& name, std::string_view unit, std::string_view long_name, double value) {
        int const variable = file_.add_variable(name, Type::float64, {});
        describe(variable, unit, long_name);
        std::size_t const none = 0;  // never a null pointer
        file_.write(variable, {&none, 0}, {&none, 0}, &value);
    }

private:
    void describe(int variable, std::string_view unit, std::string_view long_name) {
        if (!unit.empty()) file_.put_text(variable, "units", unit);
        file_.put_text(variable, "long_name", long_name);
    }
    NetcdfFile& file_;
};

void write_statuses(NetcdfFile& file, BlockStatistics const& statistics, std::uint64_t left) {
    std::vector<signed char> values;
    std::vector<double> counts;
    for (int status = 0; status < status_count; ++status) {
        values.push_back(static_cast<signed char>(status));
        counts.push_back(static_cast<double>(statistics.ended(static_cast<Status>(status))));
    }
    values.push_back(static_cast<signed char>(Status::not_run));
    counts.push_back(static_cast<double>(left));
    file.add_dimension("status", values.size());
    ColumnWriter out(file);
    put_status_flags(file, out.column("status_value", Type::int8, "status", "", "how a member ended", values));
    out.column("status_count", Type::float64, "status", "1", "members that ended so", counts);
}

void write_failed(NetcdfFile& file, BlockStatistics const& statistics) {
    if (statistics.failed().empty()) return;
    std::vector<int> members;
    std::vector<signed char> statuses;
    std::vector<double> times;
    for (FailedMember const& failed : statistics.failed()) {
        members.push_back(static_cast<int>(failed.member));
        statuses.push_back(static_cast<signed char>(failed.status));
        times.push_back(failed.time);
    }
    file.add_dimension("failed", members.size());
    ColumnWriter out(file);
    out.column("failed_member", Type::int32, "failed", "1", "number of one of the first members that failed", members);
    put_status_flags(file, out.column("failed_status", Type::int8, "failed", "", "how it ended", statuses));
    out.column("failed_time", Type::float64, "failed", "s", "time at which it ended", times);
}

void write_all(NetcdfFile& file, StatisticsMerge const& merge, BlockStatistics const& statistics) {
    put_provenance(file, merge.provenance);
    file.put_text(NetcdfFile::global, "store", "statistics");
    file.put_text(NetcdfFile::global, "members", merge.members.text());
    LabelAxes axes(file);
    std::string names;
    for (int q = 0; q < quantity_count; ++q) {
        if (!selects(merge.plan.quantities, static_cast<Quantity>(q))) continue;
        names += fmt::format("{}{}", names.empty() ? "" : " ", quantity_table[q].name);
        if (quantity_table[q].dimension != nullptr) axes.axis(quantity_table[q].dimension);
    }
    file.put_text(NetcdfFile::global, "quantities", names);
    axes.write();
    write_statuses(file, statistics, merge.members.without(statistics.members()).count());
    write_failed(file, statistics);
    ColumnWriter out(file);
    for (std::size_t i = 0; i < statistics.work().size(); ++i) {
        WorkCounter const& work = work_table[i];
        out.scalar(work.name, "1", fmt::format("{} of all members", work.meaning),
                   static_cast<double>(statistics.work()[i]));
    }
    std::vector<std::byte> const bytes = statistics.bytes();
    file.add_dimension("byte", bytes.size());
    out.column("accumulators", Type::int8, "byte", "",
               "exact sums and quantile sketches from which the statistics follow, as bytes", bytes);
}

}  // namespace

void merge_statistics(ShardFolder const& folder, std::vector<Shard> const& shards, StatisticsMerge const& merge,
                      std::string const& path) {
    write_result(path, merge.completeness, [&](NetcdfFile& file) {
        BlockStatistics statistics(merge.plan);
        for (Shard const& shard : shards) {
            if (merge.pause) merge.pause();
            statistics.merge(parse_statistics(folder.read(shard), shard.name).statistics);
        }
        if (merge.pause) merge.pause();
        write_all(file, merge, statistics);
        if (merge.conclude) merge.conclude(file, statistics);
        if (merge.pause) merge.pause();
    }, merge.existing);
}

BlockStatistics stored_statistics(ResultView const& results) {
    std::vector<std::byte> bytes;
    for (double const value : results.values("accumulators")) {
        bytes.push_back(static_cast<std::byte>(int8_of(value)));
    }
    return BlockStatistics::parse(bytes, results.path());
}

Selection stored_quantities(ResultView const& results) {
    std::istringstream names(results.attribute("quantities"));
    Selection quantities = 0;
    for (std::string name; names >> name;) {
        for (int q = 0; q < quantity_count; ++q) {
            if (name == quantity_table[q].name) quantities |= selection_of(static_cast<Quantity>(q));
        }
    }
    return quantities;
}

std::uint64_t members_left(ResultView const& results) {
    std::vector<double> const counts = results.values("status_count");
    return counts.empty() ? 0 : count_of(counts.back());
}

}  // namespace slideway
