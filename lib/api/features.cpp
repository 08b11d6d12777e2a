// Features: each is on from a call with its desc, off from one with NULL.
#include "api/structs.hpp"
#include "api/view.hpp"
#include "api/with_sim.hpp"
#include "core/follows/detail.hpp"
#include "core/params/params.hpp"
#include "core/wind/wind.hpp"

#include <plait/plait_cluster.h>

namespace plait::api {
namespace {

// A feature that `desc` describes, or NULL that it is off; `feature` is where params have it.
template <typename Desc>
plait_result set_feature(const char* function, plait_sim* sim, const Desc* desc,
                         const Desc& defaults, Feature<Desc> Params::*feature) noexcept {
    return with_sim(function, sim, [&](Sim& s) -> Status {
        if (!desc && !(s.params().*feature).on)
            return {};
        Params next = s.params();
        next.*feature = {defaults, desc != nullptr};
        if (desc)
            PLAIT_TRY(read_struct(desc, static_cast<Desc&>(next.*feature), "desc"));
        PLAIT_TRY(check_params(next));
        return s.set_params(next);
    });
}

} // namespace
} // namespace plait::api

using namespace plait;

extern "C" {

plait_result plait_sim_set_pins(plait_sim* sim, const plait_pin* pins, size_t count) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        if (count > 0)
            PLAIT_TRY(api::need(pins, "pins"));
        return s.set_pins({pins, count});
    });
}

void plait_wind_desc_init(plait_wind_desc* desc, size_t size) {
    api::init_struct(desc, size, default_wind_desc());
}

plait_result plait_sim_set_wind(plait_sim* sim, const plait_wind_desc* desc) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        if (!desc)
            return s.set_wind(nullptr);
        plait_wind_desc given = default_wind_desc();
        PLAIT_TRY(api::read_struct(desc, given, "desc"));
        PLAIT_TRY(check_wind(given));
        return s.set_wind(&given);
    });
}

void plait_frame_desc_init(plait_frame_desc* desc, size_t size) {
    api::init_struct(desc, size, default_frame_desc());
}

plait_result plait_sim_set_frame(plait_sim* sim, const plait_frame_desc* desc) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        if (!desc)
            return s.set_frame(nullptr);
        plait_frame_desc given = default_frame_desc();
        PLAIT_TRY(api::read_struct(desc, given, "desc"));
        const auto checked = checked_frame(given);
        if (!checked)
            return checked.error();
        return s.set_frame(&*checked);
    });
}

void plait_detail_desc_init(plait_detail_desc* desc, size_t size) {
    api::init_struct(desc, size, default_detail_desc());
}

plait_result plait_sim_set_detail(plait_sim* sim, const plait_detail_desc* desc) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        if (!desc)
            return s.set_detail(nullptr, {});
        plait_detail_desc given = default_detail_desc();
        PLAIT_TRY(api::read_struct(desc, given, "desc"));
        PLAIT_TRY(check_detail(given));
        std::pmr::vector<uint32_t> centres(&s.context().memory);
        PLAIT_TRY(api::copy_view(given.clump_centres, 1, "desc->clump_centres", centres));
        return s.set_detail(&given, centres);
    });
}

void plait_tressfx_desc_init(plait_tressfx_desc* desc, size_t size) {
    api::init_struct(desc, size, default_tressfx_desc());
}

plait_result plait_sim_set_tressfx(plait_sim* sim, const plait_tressfx_desc* desc) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        Params next = s.params();
        next.tressfx = default_tressfx_desc();
        if (desc)
            PLAIT_TRY(api::read_struct(desc, next.tressfx, "desc"));
        PLAIT_TRY(check_params(next));
        PLAIT_TRY(check_reads_tressfx(s.model()));
        return s.set_params(next);
    });
}

void plait_grid_desc_init(plait_grid_desc* desc, size_t size) {
    api::init_struct(desc, size, default_grid_desc());
}

plait_result plait_sim_set_grid(plait_sim* sim, const plait_grid_desc* desc) {
    return api::set_feature(__func__, sim, desc, default_grid_desc(), &Params::grid);
}

plait_result plait_sim_set_reduce(plait_sim* sim, plait_reduce_fn reduce, void* user) {
    return api::with_sim(__func__, sim, [&](Sim& s) { return s.set_reduce(reduce, user); });
}

void plait_volume_desc_init(plait_volume_desc* desc, size_t size) {
    api::init_struct(desc, size, default_volume_desc());
}

plait_result plait_sim_set_volume(plait_sim* sim, const plait_volume_desc* desc) {
    return api::set_feature(__func__, sim, desc, default_volume_desc(), &Params::volume);
}

void plait_strand_contact_desc_init(plait_strand_contact_desc* desc, size_t size) {
    api::init_struct(desc, size, default_strand_contact_desc());
}

plait_result plait_sim_set_strand_contact(plait_sim* sim, const plait_strand_contact_desc* desc) {
    return api::set_feature(__func__, sim, desc, default_strand_contact_desc(),
                            &Params::strand_contact);
}

void plait_wetness_desc_init(plait_wetness_desc* desc, size_t size) {
    api::init_struct(desc, size, default_wetness_desc());
}

plait_result plait_sim_set_wetness(plait_sim* sim, const plait_wetness_desc* desc) {
    return api::set_feature(__func__, sim, desc, default_wetness_desc(), &Params::wetness);
}

void plait_acceleration_desc_init(plait_acceleration_desc* desc, size_t size) {
    api::init_struct(desc, size, default_acceleration_desc());
}

plait_result plait_sim_set_acceleration(plait_sim* sim, const plait_acceleration_desc* desc) {
    return api::set_feature(__func__, sim, desc, default_acceleration_desc(),
                            &Params::acceleration);
}
}
