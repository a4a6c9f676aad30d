// Members of a study again, by tighter methods, as many as a check needs or may cost.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "host/run/progress.hpp"
#include "host/study/member_numbers.hpp"
#include "host/study/tolerance_report.hpp"
#include "host/study/verification.hpp"

namespace slideway {

/// The members of a study, and which of them run again.
class MemberCheck {
public:
    static constexpr double of_the_study = 0.1;  // that a check may cost unasked
    static constexpr double at_hand = 3;  // times what members are foreseen to take must be left before they begin; of the first ones half of that

    MemberCheck(Verification& v, Scene const& scene, Backend const& backend, VerificationRequest const& request);

    /// Of a result that stores its members.
    void look_at(ToleranceMembers const& stored);

    /// Of a study that keeps no members: some run in the study's way, and stand for all.
    void run_some_anew();

    double total() const { return total_; }
    bool compares() const;

    /// Adds members until every number is decided, or there is no more to be had.
    void run();

    bool stopped() const { return request_.stop != nullptr && request_.stop->reason() != StopReason::none; }

private:
    /// Each member runs by one method; those that only count for exponents have a sample of their own.
    void take_samples(std::vector<std::size_t> const& rows);

    /// How many members may run by a method now.
    std::size_t affordable(std::size_t method, std::size_t wanted) const;

    /// Runs members by a method.  @param again those that another one has cut short
    void add(std::size_t method, std::vector<std::size_t> const& rows, bool again);

    /// Steps after which members that took so much in the study are cut short: bounds alike for those that are alike, so that they fill lanes together.
    std::vector<std::uint64_t> most_steps(std::size_t method, std::vector<double> const& own) const;

    /// Members that nobody brings to their end.
    void give_up(std::size_t method, std::vector<std::size_t> const& rows);

    /// A pair for each member that came to its end, and for those that no method has brought there.
    void keep(std::size_t method, std::vector<std::size_t> const& rows, MemberNumbers const& numbers, bool again);

    MemberNumbers run_again(Scene const& scene, std::vector<std::uint64_t> const& members,
                            std::vector<std::uint64_t> const& most, double weight);

    void compare();

    bool is_decided() const;

    Verification& v_;
    Scene const& scene_;
    Backend const& backend_;
    VerificationRequest const& request_;
    std::vector<CheckMethod> methods_;
    std::vector<char> draws_;  // [rows]
    std::vector<char> given_up_;                       // [methods] that cut most of their members short
    std::vector<std::vector<std::size_t>> left_over_;  // [methods] rows that another one has cut short
    ToleranceMembers const* stored_ = nullptr;
    std::uint64_t all_ = 0;
    double total_ = 0, left_ = 0, spent_ = 0;
    double typical_work_ = 0;  // mean of the members that may run again: those that failed took less
    std::vector<std::shared_ptr<CheckSample>> samples_;  // [methods]
    std::vector<double> residuals_;
    StopRequest const nobody_;
    std::optional<Progress> progress_;
};

}  // namespace slideway
