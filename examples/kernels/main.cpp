// The mean final height of 64 slider-cranks whose clearances go from 0.05 to 0.1 mm, after 20 ms.
#include <cstdio>
#include <vector>

#include <slideway/dispatch.hpp>
#include <slideway/kernels/block.hpp>
#include <slideway/kernels/members/complete_inputs.hpp>

SLIDEWAY_KERNEL(void, run, (slideway::Block&))

int main() {
    constexpr int members = 64;
    std::vector<slideway::Inputs> inputs(members);
    for (int i = 0; i < members; ++i) {
        inputs[i].clearance_y = inputs[i].clearance_z = 5e-5 + 5e-5 * i / (members - 1);
        inputs[i] = complete_inputs(inputs[i]);
    }
    std::vector<slideway::MemberRecord> records(members);
    std::vector<double> ends(members * slideway::state_size);
    slideway::Block block;
    block.members = members;
    block.inputs = inputs.data();
    block.settings.end_time = 0.02;
    block.records = records.data();
    block.final_states = ends.data();
    slideway::run_kernel()(block);
    double sum = 0;
    for (int i = 0; i < members; ++i) sum += ends[i * slideway::state_size];
    std::printf("%.17g\n", sum / members);
}
