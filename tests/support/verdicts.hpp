// The verdicts of a result, and what is true: the same members by two methods at a thousandth of the tolerance.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "host/study/verification.hpp"
#include "tests/system/results.hpp"

namespace slideway::testing {

class VerdictRun : public ProgramWithResults {
protected:
    /// Runs a scene and checks it, whatever it costs, or within a tenth of its work.
    std::vector<StoredVerdict> verdicts_of(std::string const& scene, std::vector<std::string> const& sets = {}, bool asked = true) const {
        write("s.toml", scene);
        // Some of random starts lie deep inside the way; what is said of their numbers has to hold as well.
        std::vector<std::string> command{"run", "s.toml", "-o", "o.nc", "--force", "--quiet", "--any-start"};
        if (asked) command.emplace_back("--verify");
        for (std::string const& set : sets) command.insert(command.end(), {"--set", set});
        Outcome const outcome = run(command);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return stored_verdicts(results("o.nc"));
    }
    std::string resolution() const { return results("o.nc").group_attribute("verification", "resolution"); }
    std::string summary() const { return results("o.nc").group_attribute("verification", "summary"); }

    static StoredVerdict find(std::vector<StoredVerdict> const& verdicts, std::string const& name, std::string const& members_of = "all members") {
        for (StoredVerdict const& one : verdicts) {
            if (one.name.starts_with(name) && one.members_of == members_of) return one;
        }
        ADD_FAILURE() << "no verdict on " << name << " of " << members_of;
        return {};
    }
    /// Whether what is said of a number holds, the right value known with an uncertainty: nothing above the margin is resolved, and bounds hold.
    static void expect_honest(StoredVerdict const& said, double right, double uncertainty) {
        double const error = std::abs(said.value - right);
        if (error > said.margin + uncertainty) {
            EXPECT_NE(said.verdict, Verdict::resolved) << said.name << " of " << said.members_of << ": " << said.value << ", right " << right;
        }
        if (said.verdict == Verdict::bounded) {
            EXPECT_LE(error, said.error_bound + uncertainty) << said.name << " of " << said.members_of;
        }
    }
    /// Of each quantity over all members: the last run's, against two tight ones of the same scene.
    void expect_honest_means(std::vector<StoredVerdict> const& verdicts, std::vector<std::string> const& sets, double rtol) const {
        std::vector<std::vector<double>> right;
        std::vector<std::string> const quantities{"contact_onsets", "damping_loss"};
        for (std::string const method : {"auto", "verner65"}) {
            std::vector<std::string> command{"run", "s.toml", "-o", "t.nc", "--force", "--quiet", "--any-start", "--set", "study.verify=0",
                                             "integrator.method=" + method, fmt::format("integrator.rtol={:.3e}", 1e-3 * rtol)};
            command.insert(command.end(), sets.begin(), sets.end());
            Outcome const outcome = run(command);
            EXPECT_EQ(outcome.code, 0) << outcome.err;
            std::vector<double> means;
            for (std::string const& quantity : quantities) {
                std::vector<double> const values = results("t.nc").values(quantity);
                double sum = 0;
                for (double const x : values) sum += x / static_cast<double>(values.size());
                means.push_back(sum);
            }
            right.push_back(means);
        }
        for (std::size_t i = 0; i < quantities.size(); ++i) {
            double const middle = 0.5 * (right[0][i] + right[1][i]), apart = 0.5 * std::abs(right[0][i] - right[1][i]);
            expect_honest(find(verdicts, quantities[i]), middle, apart);
        }
    }
};

}  // namespace slideway::testing
