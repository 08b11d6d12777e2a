// One groom over several sims, whose grids' sums the caller adds up.
#include "base/format.hpp"
#include "core/sim/sim.hpp"
#include "core/sim/trial.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <utility>

namespace plait {
namespace {

Error not_in_parts(const char* what) {
    return {
        PLAIT_INVALID_STATE,
        format("%s and plait_sim_set_reduce: the parts of a groom meet in the grid alone", what)};
}

Status check_grid_of_parts(const plait_grid_desc& grid) {
    const auto refuse = [](const char* what) {
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("with plait_sim_set_reduce the grid's %s", what)};
    };
    if (grid.form != PLAIT_GRID_FORM_EXACT)
        return refuse("form is 0 (slots), it must be 1 (exact): samples cannot be added up");
    if (grid.edge == 0)
        return refuse("edge is 0, range is (0, 1e6]: a cube around the hair of one part is not "
                      "that of the others");
    return grid.in_world == 0 ? Status{} : refuse("in_world is 1, it must be 0");
}

Error cancelled(int code, const std::string& where) {
    return {PLAIT_CANCELLED,
            format("the function of plait_sim_set_reduce returned %d in %s", code, where.c_str())};
}

} // namespace

// A part knows nothing of where the others are, but by the cube that they share.
GridCube Sim::cube() const {
    const plait_grid_desc& grid = params_.grid;
    if (!reduce_ || !params_.grid.on)
        return cube_;
    return {{grid.origin[0], grid.origin[1], grid.origin[2]}, grid.edge};
}

Status Sim::check_reduces(const Params& params, bool sheltered) const {
    if (params.volume.on)
        return not_in_parts("volume");
    if (params.strand_contact.on)
        return not_in_parts("strand contact");
    if (sheltered)
        return not_in_parts("a wind with shelter");
    return params.grid.on ? check_grid_of_parts(params.grid) : Status{};
}

// Of all parts, m: how far held hair may creep goes by it.
Result<float> Sim::mean_length_with(plait_reduce_fn add, void* user) const {
    int64_t sums[] = {lengths_.sum, int64_t{layout_.guides}};
    if (const int code = add(sums, std::size(sums), user))
        return cancelled(code, "adding up lengths");
    const auto strands = static_cast<double>(std::max<int64_t>(sums[1], 1));
    return static_cast<float>(std::ldexp(static_cast<double>(sums[0]), -20) / strands);
}

Status Sim::set_reduce(plait_reduce_fn add, void* user) {
    stir();
    Result<float> length = lengths_.mean;
    if (add) {
        if (levels_)
            return not_in_parts("levels");
        PLAIT_TRY(check_reduces(params_, wind_.is_sheltered()));
        length = mean_length_with(add, user);
        if (!length)
            return length.error();
    }
    Trial trial([&] {
        std::swap(reduce_.add, add);
        std::swap(reduce_.user, user);
    });
    PLAIT_TRY(trial.keep_if(check_stages()));
    model_->take_mean_length(*length);
    return {};
}

// A sum is two words on the device, the lower one first: on the host that is one integer.
Status Sim::reduce_sums(uint32_t step, uint32_t steps) {
    static_assert(std::endian::native == std::endian::little);
    std::pmr::vector<int64_t>& sums = reduce_.sums;
    sums.resize(grid_.sums().bytes() / sizeof(int64_t));
    PLAIT_TRY(device().read(grid_.sums(), sums.data()));
    if (const int code = reduce_.add(sums.data(), sums.size(), reduce_.user)) {
        model_->publish(schedule_, present());
        PLAIT_TRY(submit());
        return cancelled(code, format("fixed step %llu, whose grid is left out",
                                      static_cast<unsigned long long>(clock_.steps)));
    }
    PLAIT_TRY(device().upload(grid_.sums(), sums.data()));
    append_phases({Moment::sums_reduced, present(), step, steps});
    return submit();
}

} // namespace plait
