// Weights of follow maps from hair in motion.
#include "core/follows/follow_learner.hpp"

#include "api/hair_frame.hpp"
#include "api/objects.hpp"
#include "api/structs.hpp"
#include "api/view.hpp"

#include <plait/plait_offline.h>

namespace plait::api {
namespace {

constexpr size_t element = 3 * sizeof(float);

Status check_rows(const plait_view& positions, size_t strands, uint32_t longest, const char* name) {
    PLAIT_TRY(check_view(positions, element, name));
    if (positions.count % strands != 0 || positions.count / strands < longest)
        return invalid(format("%s.count is %zu, range is %zu strands times one number of "
                              "vertices, at least the longest's %u",
                              name, positions.count, strands, longest));
    return {};
}

} // namespace

Status read_hair(const plait_roots* roots, const plait_view& positions, size_t strands,
                 uint32_t longest, RootsCopy& copy, HairFrame& frame, const char* name) {
    PLAIT_TRY(read_roots(roots, copy));
    PLAIT_TRY(check_rows(positions, strands, longest, name));
    frame = {static_cast<const unsigned char*>(positions.data),
             positions.stride ? positions.stride : element, positions.count / strands,
             double(copy.scale)};
    if (!copy.bones.empty() || !copy.mesh.empty())
        return Error{PLAIT_UNSUPPORTED,
                     format("roots->%s are given: give root_poses in their place",
                            copy.mesh.empty() ? "bones" : "mesh_positions")};
    return {};
}

} // namespace plait::api

using namespace plait;

extern "C" {

void plait_follow_fit_info_init(plait_follow_fit_info* info, size_t size) {
    api::init_struct(info, size, plait_follow_fit_info{});
}

plait_result plait_follow_learner_create(const plait_groom* groom, const plait_follow_map* map,
                                         plait_follow_learner** out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(groom, "groom"));
        PLAIT_TRY(api::need(map, "map"));
        PLAIT_TRY(api::need(out, "out"));
        const plait_allocator allocator = groom->own.allocator();
        Memory memory(allocator);
        auto handle = make_in<plait_follow_learner>(&memory, allocator);
        PLAIT_TRY(handle->learner.create(groom->groom, map->map));
        *out = handle.release();
        return {};
    });
}

plait_result plait_follow_learner_add_frame(plait_follow_learner* learner, const plait_roots* roots,
                                            plait_view positions) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(learner, "learner"));
        api::RootsCopy copy(&learner->own);
        HairFrame frame;
        PLAIT_TRY(api::read_hair(roots, positions, learner->learner.strands(),
                                 learner->learner.longest(), copy, frame));
        return learner->learner.add(copy.input(), frame);
    });
}

plait_result plait_follow_learner_learn(const plait_follow_learner* learner, plait_follow_map** out,
                                        plait_follow_fit_info* info) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(learner, "learner"));
        PLAIT_TRY(api::need(out, "out"));
        if (info)
            PLAIT_TRY(api::check_output(info, "info"));
        const plait_allocator allocator = learner->own.allocator();
        Memory memory(allocator);
        auto handle = make_in<plait_follow_map>(&memory, allocator);
        FollowLearner::Fit fit;
        PLAIT_TRY(learner->learner.learn(handle->map, fit));
        if (info) {
            plait_follow_fit_info value{};
            value.frames = learner->learner.frames();
            value.rms_before = fit.before;
            value.rms_after = fit.after;
            api::write_struct(info, value);
        }
        *out = handle.release();
        return {};
    });
}

void plait_follow_learner_destroy(plait_follow_learner* learner) {
    api::destroy(learner);
}
}
