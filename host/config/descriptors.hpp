// What mechanisms and contact laws say of themselves: those of the tree each in its own header, here in the order of their lists; behind them what
// modules have brought (host/backend/own_modules.hpp).
#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/backend/own_modules.hpp"
#include "kernels/laws/law_info.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/members/start.hpp"
#include "kernels/rigid/rigid_info.hpp"

namespace slideway {

/// How many laws and mechanisms are known; more when a scene names another one of a module.
std::size_t known_count();

/// What is made of all that is known.  It is made again when more is; the earlier ones stay, for who still has them.
template <class Made> class OfAllKnown {
public:
    explicit OfAllKnown(Made (*make)()) : make_(make) {}
    Made const& operator()() {
        std::size_t const known = known_count();
        // Members are looked at by many threads, which wait for nobody.
        if (Entry const* const newest = newest_.load(std::memory_order_acquire); newest != nullptr && newest->known >= known) return newest->made;
        std::lock_guard const lock(access_);
        if (entries_.empty() || entries_.back().known < known) newest_.store(&entries_.emplace_back(Entry{known, make_()}), std::memory_order_release);
        return entries_.back().made;
    }

private:
    struct Entry {
        std::size_t known;
        Made made;
    };
    Made (*make_)();
    std::mutex access_;
    std::deque<Entry> entries_;
    std::atomic<Entry const*> newest_ = nullptr;
};

std::span<MechanismInfo const> mechanisms();
std::span<LawInfo const> laws();

/// In the order of `mechanisms`, and what a scene may call one: without those whose crank turns freely.
std::span<std::string_view const> mechanism_names();
std::span<std::string_view const> mechanism_kinds();
std::span<std::string_view const> law_names();

/// One by its name: of the tree, or of a module in one of `module_folders(search)`, which is opened then.  @throws DeviceError for a module that cannot be used
std::optional<Law> find_law(std::string_view name, std::span<std::string const> search = {});
std::optional<Mechanism> find_mechanism(std::string_view name, std::span<std::string const> search = {});
/// Why a module of one's own cannot be named in scenes: its name is of the tree, or its keys are not its own.  "" of one that can.
std::string objection_to(ModuleKind kind, KernelModule const& module);
/// Opens all that `module_folders(search)` have of a kind.  @param refused hears of those that cannot be used
void open_modules(ModuleKind kind, std::span<std::string const> search, std::function<void(std::string const& why)> const& refused);
/// The module that it is of; nullptr of the tree's.
OwnModule const* module_of(Law law);
OwnModule const* module_of(Mechanism mechanism);
OwnModule const* contact_module(Parts const& parts);
/// "law hunt_crossley: source 1f0a…, g++ 12.2.0; mechanism …" of a scene's modules; "" where all is the tree's.
std::string modules_text(Parts const& parts);

MechanismInfo const& info(Mechanism mechanism);
/// What a scene calls it: mechanism.kind.
std::string_view kind_of(Mechanism mechanism);
/// The same mechanism with angle and speed of its crank in the state, where there is one.
std::optional<Mechanism> turning_form(Mechanism mechanism);
LawInfo const& info(Law law);
/// The law of a scene that names none.
inline constexpr Law default_law = Law::foundation;

/// What says how contacts push: the law, or `rigid_contact` where nothing gives way.
LawInfo const& contact_info(Parts const& parts);
/// What contact.law may say: the laws, and `rigid_contact` behind them.
std::span<LawInfo const> contact_laws();
std::span<std::string_view const> contact_law_names();
/// Whether a mechanism has kernels for rigid contacts.
bool may_be_rigid(Mechanism mechanism);

/// By its name, as `find_law` has it, or "rigid".  @return whether there is one
bool choose_contact(Parts& parts, std::string_view name, std::span<std::string const> search = {});

/// Whether faces give way; else corners do, or nothing.
bool has_faces(Parts const& parts);
/// Whether the contact law makes energy where its modes switch (model.md 8); a mechanism whose corners are points has none.
bool makes_energy(Parts const& parts);
/// Whether forces jump there, so that steps had better end: with a restitution they end at touches anyway.
bool has_switches(Parts const& parts);
/// Whether steps may end just beyond where contacts change, as the lanes have it (Conditions::continuous).
bool ends_at_changes(Parts const& parts);
/// Whether contact.restitution has to say how much contacts take.
bool needs_restitution(Parts const& parts);

/// Whether a drive prescribes a component of the state, so that neighbours cannot differ in it.
bool is_prescribed(Parts const& parts, int component);
/// How many components neighbours may differ in.
int free_states(Parts const& parts);

/// T [s]: 2π/|ω| of a driven crank, 2 (stroke/v + t_r) of the carriage (model.md 7), or that of a profile that repeats; infinite where nothing comes round.
double drive_period(Parts const& parts, Inputs const& inputs);
/// The same, if the drive had the speed of the inputs all along: of a profile its fastest, of a motor that which it starts with.
double steady_period(Parts parts, Inputs const& inputs);
/// First time in (0, T] at which the drive has this phase [s]: the crank an angle, the carriage a share phase/2π of its period.
/// @param phase [rad], any turn of it  @param inputs whose drive has a period
double first_time_at(double phase, Parts const& parts, Inputs const& inputs);
/// Why there is no period: "mechanism.crank_speed is 0", "nothing drives a free_slider", "nothing drives a free crank".
std::string why_no_period(Parts const& parts);

/// Labels along a dimension of the quantity table: "P1" … "P8", the mode classes, "roll" "yaw" "pitch",
/// "x" "y" "z" of a direction, "top" "front" of a channel (a sensor of the experiment).
/// Empty for an unknown dimension.
std::vector<std::string> labels_of(std::string_view dimension);

/// Whether a mechanism has a series of the table.
constexpr bool has_series(MechanismInfo const& mechanism, Series series) { return mechanism.own_series.empty() && selects(mechanism.series, series); }
/// The state in which a member starts (kernels/members/start.hpp).  @param in complete
StateNumbers start_of(Mechanism mechanism, Inputs const& in);

/// By what errors and costs of a member are measured.
struct MemberSize {
    double least_play, most_play;  // clearances of its joints, or preloads [m]
    double length;                 // of the slider; of a linkage how far its bodies reach [m]
    double lever;                  // by which the least play turns what turns most [m]
    double mass;                   // of the slider, or of all bodies [kg]
};
/// @param in complete
MemberSize size_of(Mechanism mechanism, Inputs const& in);

/// Number i of a mechanism's state.
template <class Index> constexpr SeriesInfo const& state_info(MechanismInfo const& mechanism, Index i) {
    auto const entry = static_cast<std::size_t>(mechanism.state[i]);
    return mechanism.own_series.empty() ? series_table[entry] : mechanism.own_series[entry];
}

}  // namespace slideway
