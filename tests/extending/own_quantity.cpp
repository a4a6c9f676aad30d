// A quantity of one's own: the distance that a slider has slid, here of a scotch yoke in one revolution.  Built with the headers that
// own_quantity.patch has given a row and a line.
#include <cmath>
#include <cstdio>

#include "kernels/integrate.hpp"
#include "kernels/laws/kelvin_voigt.hpp"
#include "kernels/laws/one_law.hpp"
#include "kernels/mechanisms/scotch_yoke.hpp"
#include "kernels/models/mechanism_model.hpp"

int main() {
    using namespace slideway;
    using Laws = OneLaw<KelvinVoigt, PointDamping>;
    using Model = MechanismModel<ScotchYoke, SliderBase, Laws>;
    Inputs in;
    in.slider_mass = 0.1872;
    in.slider_inertia_x = 2.028e-5;
    in.slider_inertia_y = 3.9e-5;
    in.slider_inertia_z = 3.12e-5;
    in.thickness_y = in.way_width;
    in.thickness_z = in.way_depth;
    in.law_a = 1e6;  // contact.apex_stiffness
    in.crank_speed = 20;
    in.start_angle = 0.7;
    MemberRecord record;
    double state[Model::size], quantities[quantity_columns];
    Block block;
    block.members = 1;
    block.inputs = &in;
    block.settings.end_time = 2 * 3.14159265358979323846 / in.crank_speed;
    block.quantities = selection_of(Quantity::sliding_distance);
    block.records = &record;
    block.final_states = state;
    block.quantity_values = quantities;
    integrate<Model, double>(block, Model{Conditions<Laws>{{}, KelvinVoigt::info.switches, Parts{}}});
    double const distance = quantities[quantity_column(Quantity::sliding_distance)];
    std::printf("slid %.6f %s in a revolution, four cranks are %.6f\n", distance,
                quantity_table[static_cast<int>(Quantity::sliding_distance)].unit, 4 * in.crank_length);
    return record.status == Status::finished && std::fabs(distance - 4 * in.crank_length) < 1e-6 ? 0 : 1;
}
