#include "host/commands/text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/base/numbers.hpp"
#include "host/config/descriptors.hpp"
#include "host/store/result_seal.hpp"
#include "host/study/probe.hpp"
#include "host/study/result_summary.hpp"
#include "host/study/verification.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "kernels/members/start.hpp"

namespace slideway::cli {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has neither NaN nor infinity.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json object(char const* command) { return {{"schema_version", json_version}, {"command", command}}; }

std::string text_of(Json const& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json of_state(Mechanism mechanism, StateNumbers const& state) {
    MechanismInfo const& has = info(mechanism);
    Json json;
    for (int i = 0; i < has.states; ++i) json[state_info(has, i).name] = number(state[static_cast<std::size_t>(i)]);
    return json;
}

Json of_start(Scene const& scene) {
    return of_state(scene.parts.mechanism, start_of(scene.parts.mechanism, complete_inputs(scene.inputs, info(scene.parts.mechanism))));
}

Json of_summary(Summary const& summary) {
    return {{"count", summary.count},          {"mean", number(summary.mean)},     {"sd", number(summary.sd)},
            {"min", number(summary.min)},      {"median", number(summary.median)}, {"max", number(summary.max)}};
}

Json of_mean(MeanOfMembers const& mean) { return {{"mean", number(mean.mean)}, {"half_width", number(mean.half_width)}}; }

Json of_quantities(ResultReader const& results) {
    Json list = Json::array();
    for (QuantitySummary const& quantity : summarise_quantities(results)) {
        Json one{{"name", quantity.label}, {"unit", quantity.unit}};
        one.update(of_summary(quantity.values));
        list.push_back(std::move(one));
    }
    return list;
}

Json of_members(ResultReader const& results, MemberRange const& range) {
    Json list = Json::array();
    for (MemberRow const& member : member_rows(results, range)) {
        list.push_back({{"member", member.number},
                        {"status", name_of(member.status)},
                        {"end_time", number(member.time)},
                        {"steps_accepted", member.steps_accepted},
                        {"steps_rejected", member.steps_rejected}});
        if (!member.label.empty()) list.back()["label"] = member.label;
    }
    return list;
}

/// The first of those that did not finish, with what columns of text of the scene's table call them, or where there is no scene the result.
Json of_failed(ResultReader const& results, Scene const* scene) {
    constexpr std::size_t most = 100;
    Json list = Json::array();
    std::vector<FailedMember> const failed = failed_members(results, most);
    bool const has_labels = scene == nullptr && !failed.empty() && results.has("member_label");
    std::vector<double> const members = has_labels ? results.values("member") : std::vector<double>();
    std::vector<std::string> const labels = has_labels ? results.texts("member_label") : std::vector<std::string>();
    for (FailedMember const& member : failed) {
        list.push_back({{"member", member.member}, {"status", name_of(member.status)}, {"end_time", number(member.time)}});
        auto const place = static_cast<std::size_t>(std::ranges::lower_bound(members, static_cast<double>(member.member)) - members.begin());
        std::string const label = scene != nullptr ? label_of(*scene, member.member) : place < labels.size() ? labels[place] : "";
        if (!label.empty()) list.back()["label"] = label;
    }
    return list;
}

Json of_exponents(ResultReader const& results) {
    Json list = Json::array();
    for (ExponentSummary const& one : summarise_exponents(results)) {
        list.push_back({{"mean", of_mean(one.mean)},
                        {"second_half", of_mean(one.late)},
                        {"quantile_05", number(one.low)},
                        {"quantile_95", number(one.high)},
                        {"sign", words_of(one.sign)},
                        {"members_positive", one.above},
                        {"members_negative", one.below},
                        {"members_undecided", one.undecided},
                        {"members_power_of_time", one.power_of_time}});
    }
    // Of the largest alone.
    if (auto const turn = growth_per_turn(results); turn && !list.empty()) list.front()["per_turn"] = of_mean(*turn);
    return list;
}

Json of_columns(ResultReader const& results) {
    Json list = Json::array();
    for (SweepColumn const& column : summarise_columns(results)) {
        Json one{{"value", column.value}, {"members", column.members}, {"finished", column.finished}};
        if (results.has("lyapunov_exponent")) {
            one["exponent"] = of_mean(column.exponent.mean);
            one["sign"] = words_of(column.exponent.sign);
        }
        list.push_back(std::move(one));
    }
    return list;
}

Json of_estimate(Estimate const& one) { return {{"value", number(one.value)}, {"low", number(one.interval.low)}, {"high", number(one.interval.high)}}; }

Json of_yield(std::string const& name, Limit const& limit, std::string const& unit, Proportion const& met) {
    Json json{{"name", name}, {"unit", unit}, {"min", number(limit.low)}, {"max", number(limit.high)}, {"met", met.successes}, {"of", met.trials}};
    json.update(of_estimate(met));
    return json;
}

/// A column's name, why it has no sensitivities (or null), and what there is of each input.
template <class Column, class OfInput> Json of_inputs(ToleranceReport const& report, Column const& column, OfInput of_input) {
    Json one{{"name", column.column.name()}, {"without", column.why_none.empty() ? Json(nullptr) : Json(column.why_none)}, {"inputs", Json::array()}};
    for (std::size_t i = 0; i < report.inputs.size(); ++i) {
        one["inputs"].push_back({{"name", report.inputs[i]}});
        of_input(one["inputs"].back(), i);
    }
    return one;
}

Json of_sensitivity(ToleranceReport const& report) {
    Json list = Json::array();
    for (ColumnIndices const& column : report.indices ? report.indices->columns : std::vector<ColumnIndices>()) {
        list.push_back(of_inputs(report, column, [&](Json& input, std::size_t i) {
            input["first"] = of_estimate(column.indices.first[i]);
            input["total"] = of_estimate(column.indices.total[i]);
        }));
        list.back()["first_sum"] = of_estimate(column.indices.first_sum);
    }
    for (ColumnCorrelations const& column : report.correlations) {
        list.push_back(of_inputs(report, column, [&](Json& input, std::size_t i) {
            input["rank_correlation"] = of_estimate(column.ranks[i]);
            input["regression"] = number(column.regression.coefficients[i]);
        }));
        list.back()["r_squared"] = number(column.regression.r_squared);
    }
    return list;
}

Json of_report(ToleranceReport const& report) {
    Json json{{"design", name_of(report.design)}, {"policy", report.policy}, {"intervals", report.intervals}};
    json["quantile_error"] = report.quantile_error.empty() ? Json(nullptr) : Json(report.quantile_error);
    json["confidence"] = confidence_level;
    json["quantities"] = json["yields"] = Json::array();
    json["sensitivity"] = of_sensitivity(report);
    for (ColumnStatistics const& entry : report.columns) {
        Json one{{"name", entry.column.name()}, {"unit", entry.column.unit}, {"count", entry.summary.count}};
        one["mean"] = of_estimate({entry.summary.mean, entry.mean});
        for (QuantileEstimate const& quantile : entry.quantiles) {
            one["quantiles"].push_back({{"probability", quantile.p}});
            one["quantiles"].back().update(of_estimate(quantile));
        }
        json["quantities"].push_back(std::move(one));
    }
    for (LimitYield const& limit : report.limits) json["yields"].push_back(of_yield(limit.limit.name(), limit.limit, limit.unit, limit.met));
    if (report.all_met) json["yields"].push_back(of_yield("all limits", {}, "", *report.all_met));
    return json;
}

/// What the check of a result's resolution says of each of its numbers.
Json of_verdicts(ResultReader const& results) {
    Json list = Json::array();
    for (StoredVerdict const& one : stored_verdicts(results)) {
        list.push_back({{"name", one.name},
                        {"members_of", one.members_of},
                        {"verdict", verdict_names[static_cast<int>(one.verdict)]},
                        {"value", number(one.value)},
                        {"half_width", number(one.half_width)},
                        {"sd", number(one.sd)},
                        {"difference", number(one.difference)},
                        {"error_bound", number(one.error_bound)},
                        {"margin", number(one.margin)},
                        {"pairs", number(one.pairs)},
                        {"cut", number(one.cut)}});
    }
    return list;
}

Json of_joints(StateTable const& table, std::size_t row, ProbeResult const& result) {
    Json json{{"law", "points"}, {"damping", damping_text(table.parts[row])}, {"joints", Json::array()}};
    for (JointForce const& one : joint_forces(table, row, result)) {
        json["joints"].push_back({{"joint", one.joint}, {"first", one.first}, {"second", one.second}, {"touches", one.touches()}});
        for (auto const& [name, value] : {std::pair("x", one.x), {"y", one.y}, {"tilt", one.tilt}, {"depth", one.depth}, {"normal_force", one.normal_force},
                                          {"force_x", one.force_x}, {"force_y", one.force_y}}) json["joints"].back()[name] = number(value);
    }
    return json;
}

Json of_explanation(Explanation const& found, Parts const& parts) {
    Json json{{"law", contact_info(parts).name}, {"damping", damping_text(parts)}};
    for (ApexPair const& pair : found.pairs) {
        json["pairs"].push_back({{"apex", fmt::format("P{}", pair.apex + 1)}, {"face", face_names[pair.face]}, {"touches", pair.touches()},
                                 {"depth", number(pair.depth)}, {"rate", number(pair.rate)}, {"normal_force", number(pair.normal_force)},
                                 {"sliding_speed", number(pair.sliding)}, {"friction_coefficient", number(pair.coefficient)}, {"friction", number(pair.friction)}});
    }
    json["modes"] = Json::array();
    for (FaceMode const& mode : found.modes) {
        json["modes"].push_back({{"face", face_names[mode.face]}, {"kind", mode.kind}});
        for (int const apex : mode.apices) json["modes"].back()["apices"].push_back(fmt::format("P{}", apex + 1));
    }
    for (auto const& [name, vector] : {std::pair("friction", found.friction), {"force", found.force}, {"torque", found.torque}}) {
        for (double const value : vector) json[name].push_back(number(value));
    }
    json["joint"] = {{"slider_length", found.length}, {"way_width", found.width}, {"way_depth", found.depth}};
    return json;
}

}  // namespace

std::string result_json(char const* command, ResultReader const& results, SealCheck const& seal, std::optional<ToleranceReport> const& report,
                        EnsembleTotals const* totals, std::uint64_t left, std::optional<MemberRange> const& members, Scene const* scene) {
    Json json = object(command);
    json["file"] = results.path();
    for (char const* const name : {"title", "created", "version", "commit", "compiler", "flags", "machine", "backend", "isa", "completeness"})
        json[name] = results.attribute(name);
    for (char const* const name : {"threads", "seed"}) {
        auto const count = parse_number<std::uint64_t>(results.attribute(name));
        json[name] = count ? Json(*count) : Json(nullptr);
    }
    json["format_version"] = seal.version;
    json["payload_hash"] = seal.payload;
    json["payload_matches"] = seal.data_match();
    json["metadata_hash"] = seal.metadata.empty() ? Json(nullptr) : Json(seal.metadata);
    json["metadata_matches"] = seal.metadata.empty() && seal.version == 1 ? Json(nullptr) : Json(seal.metadata_match());
    json["not_covered"] = seal.foreign;
    json["intact"] = seal.intact();
    Json& dimensions = json["dimensions"] = Json::object();
    for (auto const& dimension : results.dimensions()) dimensions[dimension.name] = dimension.length;
    if (!seal.intact()) return text_of(json);
    Json& statuses = json["statuses"] = Json::object();
    for (StatusCount const& count : count_statuses(results)) statuses[name_of(count.status)] = count.members;
    json["members_left"] = left;
    json["failed"] = of_failed(results, scene);
    json["quantities"] = of_quantities(results);
    if (report) json["tolerance"] = of_report(*report);
    if (Json exponents = of_exponents(results); !exponents.empty()) json["exponents"] = std::move(exponents);
    if (Json columns = of_columns(results); !columns.empty()) json["columns"] = std::move(columns);
    if (auto const sections = summarise_sections(results)) {
        json["sections"] = {{"count", sections->sections}, {"members_without", sections->without}, {"beyond_room", sections->beyond}};
    }
    if (auto const summary = verification_summary(results)) {
        json["verification"] = {{"resolution", results.group_attribute(verification_group, "resolution")}, {"summary", *summary}, {"numbers", of_verdicts(results)}};
    }
    if (members) json["members"] = of_members(results, *members);
    if (totals != nullptr) {
        json["run"] = {{"members", totals->done()},
                       {"seconds", totals->seconds},
                       {"steps_accepted", totals->steps_accepted},
                       {"steps_rejected", totals->steps_rejected},
                       {"rhs_evaluations", totals->rhs_evaluations},
                       {"jacobian_evaluations", totals->jacobian_evaluations},
                       {"lanes_in_use", number(totals->lane_utilisation())}};
    }
    return text_of(json);
}

std::string stopped_json(std::string const& folder, std::uint64_t left) {
    Json json = object("run");
    json["shards"] = folder;
    json["members_left"] = left;
    return text_of(json);
}

std::string drawing_json(Scene const& scene, OpenLinkage const* open) {
    Json json{{"resolved", resolved_toml(scene)}, {"start", open == nullptr ? of_start(scene) : of_state(scene.parts.mechanism, open->state)}};
    if (open != nullptr) json["open"] = open->joint;
    return text_of(json);
}

std::string check_json(Scene const& scene, Prediction const& prediction, std::optional<Trial> const& trial, Backend const& backend) {
    Json json = object("check");
    json["scene"] = scene.path;
    json["resolved"] = resolved_toml(scene);
    json["start"] = of_start(scene);
    json["derived"] = Json::array();
    for (DerivedNumber const& one : derived_numbers(scene)) {
        json["derived"].push_back({{"name", one.key->name}, {"value", number(one.value)}, {"unit", one.key->unit}, {"from", one.words}});
    }
    json["warnings"] = scene.warnings;
    json["members"] = member_count(scene);
    json["backend"] = backend.name();
    json["isa"] = backend.isa();
    json["memory_bytes"] = prediction.memory();
    json["card_bytes"] = prediction.card_bytes;
    json["result_bytes"] = prediction.output_bytes;
    json["shard_bytes"] = prediction.shard_bytes;
    json["steps"] = {{"least", prediction.least_steps}, {"most", prediction.most_steps}};
    json["seconds"] = {{"least", prediction.least_seconds}, {"most", prediction.most_seconds}};
    if (trial) {
        json["steps"]["expected"] = trial->steps;
        json["seconds"]["expected"] = trial->seconds;
        json["members_tried"] = trial->members;
    }
    return text_of(json);
}

std::string probe_json(std::string const& path, StateTable const& table, std::vector<ProbeResult> const& results, std::optional<StoredState> const& stored,
                       bool explained) {
    Json json = object("probe");
    json["scene"] = path;
    if (stored) json["member"] = stored->member, json["stored"] = stored->of;
    Json& rows = json["states"] = Json::array();
    for (std::size_t row = 0; row < results.size(); ++row) {
        ProbeResult const& result = results[row];
        Json one{{"time", table.times[row]}, {"status", name_of(result.status)}};
        one["state"] = of_state(table.mechanism, start_of(table.mechanism, table.inputs[row]));
        for (auto const& [name, value] : result_columns(table, result)) one["values"][name] = number(value);
        for (auto const& [name, value] : force_columns(info(table.mechanism), result)) one["forces"][name] = number(value);
        if (explained) one["explanation"] = is_linkage(table.mechanism) ? of_joints(table, row, result) : of_explanation(explain(table, row, result), table.parts[row]);
        rows.push_back(std::move(one));
    }
    return text_of(json);
}

std::string stats_json(StatsArguments const& arguments, std::string const& series, SeriesAnalysis const& a,
                       std::vector<std::pair<std::string, std::string>> const& rows) {
    Json json = object("stats");
    json["file"] = arguments.path;
    json["series"] = series;
    json["points"] = a.points;
    json["spacing"] = a.spacing;
    json["average_period"] = number(a.average_period);
    json["delay"] = a.delay;
    json["dimension"] = a.dimension;
    json["window"] = a.window;
    json["theiler_window"] = a.theiler;
    json["exponent"] = nullptr;
    if (a.growth) {
        json["exponent"] = {{"value", number(a.growth->exponent)},
                            {"half_width", number(a.growth->half_width())},
                            {"of_chance", number(a.growth->chance())},
                            {"systematic", number(a.growth->systematic)},
                            {"is_seen", a.growth_is_seen()},
                            {"is_exponential", a.growth_is_exponential()},
                            {"is_beyond_a_power", a.growth->is_beyond_a_power()},
                            {"first_sample", a.growth->window.first},
                            {"last_sample", a.growth->window.last},
                            {"r_squared", number(a.growth->line.r_squared)}};
    }
    json["zero_one"] = {{"k", number(a.zero_one.k)}, {"points", a.zero_one.points}, {"stride", a.stride}};
    json["verdict"] = verdict(a);
    json["reservations"] = reservations(a);
    json["text"] = Json::array();
    for (auto const& [label, text] : rows) json["text"].push_back({label, text});
    return text_of(json);
}

}  // namespace slideway::cli
