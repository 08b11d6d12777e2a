// Memory that runs out and devices that go: every allocation fails once, and nothing leaks or
// changes.
#include "faulty.hpp"
#include "mesh_shapes.hpp"
#include "support.hpp"

#include <plait/plait_levels.h>

#include <memory_resource>
#include <new>

namespace {

// Counts what it holds; refuses allocation number `fail_at`.
struct Pool {
    int fail_at = -1;
    int made = 0;
    int live = 0;

    static void* allocate(size_t size, size_t alignment, void* user) {
        auto* pool = static_cast<Pool*>(user);
        if (pool->made++ == pool->fail_at)
            return nullptr;
        ++pool->live;
        return ::operator new(size, std::align_val_t(alignment), std::nothrow);
    }
    static void release(void* memory, size_t, size_t alignment, void* user) {
        --static_cast<Pool*>(user)->live;
        ::operator delete(memory, std::align_val_t(alignment));
    }
    plait_allocator allocator() { return {allocate, release, this}; }
};

// Runs `attempt` with allocation 0, 1, 2, ... failing until none is left to fail.
template <typename Attempt> int fail_each_allocation(Pool& pool, const Attempt& attempt) {
    for (int n = 0; n < 1000; ++n) {
        const int live = pool.live;
        pool.made = 0;
        pool.fail_at = n;
        const plait_result result = attempt();
        pool.fail_at = -1;
        EXPECT_EQ(pool.live, live) << "after failure of allocation " << n;
        if (result == PLAIT_OK)
            return n;
        EXPECT_EQ(result, PLAIT_OUT_OF_MEMORY) << n << ": " << plait_last_error();
    }
    ADD_FAILURE() << "still failing after 1000 allocations";
    return 0;
}

TEST(Faults, EveryHostAllocationOfAContextMayFail) {
    Pool pool;
    auto desc = plait_context_desc_defaults();
    desc.backend = "reference";
    desc.allocator = pool.allocator();
    const int allocations = fail_each_allocation(pool, [&] {
        plait_context* context = nullptr;
        const plait_result result = plait_context_create(&desc, &context);
        EXPECT_EQ(context == nullptr, result != PLAIT_OK);
        plait_context_destroy(context);
        return result;
    });
    EXPECT_GT(allocations, 0);
    EXPECT_EQ(pool.live, 0);
}

TEST(Faults, EveryHostAllocationOfAGroomMayFail) {
    Pool pool;
    const GroomArrays arrays(tuft(3, 5));
    const auto desc = arrays.desc();
    auto options = plait_import_options_defaults();
    options.allocator = pool.allocator();
    options.resample = 7;
    const int allocations = fail_each_allocation(pool, [&] {
        plait_groom* groom = nullptr;
        const plait_result result = plait_groom_create(&desc, &options, &groom);
        plait_groom_destroy(groom);
        return result;
    });
    EXPECT_GT(allocations, 5);
    EXPECT_EQ(pool.live, 0);
}

TEST(Faults, EveryHostAllocationOfGuidesMayFail) {
    Pool pool;
    const GroomArrays arrays(tuft(5, 4));
    const auto desc = arrays.desc();
    auto options = plait_import_options_defaults();
    options.allocator = pool.allocator();
    {
        const plait::Groom groom(desc, options);
        const int allocations = fail_each_allocation(pool, [&] {
            plait_groom* guides = nullptr;
            plait_follow_map* map = nullptr;
            const plait_result result = plait_groom_guides(groom, 2, 0, &guides, &map);
            EXPECT_EQ(!guides || !map, result != PLAIT_OK);
            plait_groom_destroy(guides);
            plait_follow_map_destroy(map);
            return result;
        });
        EXPECT_GT(allocations, 5);
    }
    EXPECT_EQ(pool.live, 0);
}

TEST(Faults, EveryHostAllocationOfABoundMapMayFail) {
    Pool pool;
    const GroomArrays arrays(tuft(5, 4));
    auto options = plait_import_options_defaults();
    options.allocator = pool.allocator();
    {
        const plait::Groom groom(arrays.desc(), options);
        const auto [guides, map] = groom.guides(2);
        const auto roots = plait_roots_defaults();
        const int allocations = fail_each_allocation(pool, [&] {
            plait_follow_map* bound = nullptr;
            const plait_result result =
                plait_follow_map_bind(map, groom, &roots, plait::view(arrays.positions, 3), &bound);
            EXPECT_EQ(!bound, result != PLAIT_OK);
            plait_follow_map_destroy(bound);
            return result;
        });
        EXPECT_GT(allocations, 5);
    }
    EXPECT_EQ(pool.live, 0);
}

TEST(Faults, EveryHostAllocationOfLevelsMayFail) {
    Pool pool;
    const GroomArrays arrays(tuft(5, 4));
    auto options = plait_import_options_defaults();
    options.allocator = pool.allocator();
    {
        const plait::Groom groom(arrays.desc(), options);
        auto desc = plait_levels_desc_defaults();
        desc.groom = groom;
        desc.hung = plait::view(arrays.positions, 3);
        desc.level_count = 2;
        desc.guides[0] = 5;
        desc.guides[1] = 2;
        const int allocations = fail_each_allocation(pool, [&] {
            plait_levels* levels = nullptr;
            plait_groom* guides = nullptr;
            plait_follow_map* map = nullptr;
            plait_result result = plait_levels_create(&desc, &levels);
            EXPECT_EQ(!levels, result != PLAIT_OK);
            if (result == PLAIT_OK)
                result = plait_levels_take(levels, 1, &guides, &map);
            EXPECT_EQ(!guides || !map, result != PLAIT_OK);
            plait_levels_destroy(levels);
            plait_groom_destroy(guides);
            plait_follow_map_destroy(map);
            return result;
        });
        EXPECT_GT(allocations, 10);
    }
    EXPECT_EQ(pool.live, 0);
}

TEST(Faults, EveryHostAllocationOfALearnerMayFail) {
    Pool pool;
    const GroomArrays arrays(tuft(5, 4));
    auto options = plait_import_options_defaults();
    options.allocator = pool.allocator();
    {
        const plait::Groom groom(arrays.desc(), options);
        const auto [guides, map] = groom.guides(2);
        const auto roots = plait_roots_defaults();
        const int allocations = fail_each_allocation(pool, [&] {
            plait_follow_learner* learner = nullptr;
            plait_follow_map* learnt = nullptr;
            plait_result result = plait_follow_learner_create(groom, map, &learner);
            EXPECT_EQ(!learner, result != PLAIT_OK);
            if (result == PLAIT_OK)
                result = plait_follow_learner_add_frame(learner, &roots,
                                                        plait::view(arrays.positions, 3));
            if (result == PLAIT_OK)
                result = plait_follow_learner_learn(learner, &learnt, nullptr);
            EXPECT_EQ(!learnt, result != PLAIT_OK);
            plait_follow_learner_destroy(learner);
            plait_follow_map_destroy(learnt);
            return result;
        });
        EXPECT_GT(allocations, 10);
    }
    EXPECT_EQ(pool.live, 0);
}

TEST(Faults, EveryHostAllocationOfASimMayFail) {
    Pool pool;
    auto desc = plait_context_desc_defaults();
    desc.backend = "reference";
    desc.allocator = pool.allocator();
    {
        const plait::Context context(desc);
        const auto groom = make_groom(tuft(3, 5));
        plait::SimDesc sim_desc;
        sim_desc.follows_per_guide = 2;
        const int allocations = fail_each_allocation(pool, [&] {
            plait_sim* sim = nullptr;
            const plait_result result = plait::create_sim(context, groom, sim_desc, &sim);
            plait_sim_destroy(sim);
            return result;
        });
        EXPECT_GT(allocations, 5);
    }
    EXPECT_EQ(pool.live, 0);
}

plait::Mesh cube() {
    const ShapeMesh shape = box_mesh(0.1, 0.1, 0.1);
    auto desc = plait_mesh_desc_defaults();
    desc.positions = {shape.positions.data(), shape.positions.size(), 0};
    desc.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    return plait::Mesh(desc);
}

// Containers that were not told of the caller's allocator take the default resource, which here has
// nothing to give.
TEST(Faults, ContainersOfASimAreInTheCallersMemory) {
    const auto context = make_context("reference");
    const auto groom = make_groom(tuft(3, 5));
    const auto [guides, map] = groom.guides(2);
    std::pmr::memory_resource* const usual =
        std::pmr::set_default_resource(std::pmr::null_memory_resource());
    for (const plait_model model : {PLAIT_MODEL_TRESSFX, PLAIT_MODEL_ARTICULATED}) {
        SCOPED_TRACE(model);
        plait::SimDesc desc;
        desc.model = model;
        desc.follows_per_guide = 2;
        desc.interpolate_output = 1;
        desc.wetness.on = model != PLAIT_MODEL_TRESSFX;
        plait::SimDesc turned;
        turned.model = model;
        turned.follow_map = map;
        EXPECT_NO_THROW(plait::Sim(context, guides, turned));
        EXPECT_NO_THROW({
            plait::Sim sim(context, groom, desc);
            sim.create_collider(smooth_collider());
            run(sim, 2);
            if (model != PLAIT_MODEL_TRESSFX) {
                sim.create_collider(cube());
                sim.write(PLAIT_FIELD_WETNESS, {1, 0.5f, 0});
                take_substeps(sim, {1, 2, 3});
            }
            run(sim, 2);
            sim.restore(sim.save());
        });
    }
    std::pmr::set_default_resource(usual);
}

TEST(Faults, EveryDeviceBufferOfASimMayFail) {
    Faults& faults = faulty();
    {
        const auto context = make_context("faulty");
        const auto groom = make_groom(tuft(3, 5));
        plait::SimDesc desc;
        desc.grid.on = true;
        desc.interpolate_output = 1;
        desc.follows_per_guide = 1;
        int refused = 0;
        for (plait_result result = PLAIT_OUT_OF_MEMORY; result != PLAIT_OK; ++refused) {
            ASSERT_LT(refused, 100);
            faults.fail_create_after = refused;
            plait_sim* sim = nullptr;
            result = plait::create_sim(context, groom, desc, &sim);
            if (result != PLAIT_OK) {
                EXPECT_EQ(result, PLAIT_OUT_OF_MEMORY);
                EXPECT_NE(std::string(plait_last_error()).find("injected"), std::string::npos);
            }
            plait_sim_destroy(sim);
            EXPECT_EQ(faults.live_buffers, 0);
        }
        EXPECT_GT(refused, 12);
    }
    EXPECT_EQ(faults.live_devices, 0);
}

TEST(Faults, AFeatureStaysOffWhenItsBuffersDoNotFit) {
    Faults& faults = faulty();
    const auto context = make_context("faulty");
    plait::Sim sim(context, make_groom(tuft(3, 5)));
    run(sim, 3);
    const uint64_t hash = sim.hash();
    const int buffers = faults.live_buffers;
    auto grid = plait_grid_desc_defaults();
    grid.form = PLAIT_GRID_FORM_SLOTS;
    for (int refused = 0; refused < 4; ++refused) {
        faults.fail_create_after = refused;
        EXPECT_EQ(plait_sim_set_grid(sim, &grid), PLAIT_OUT_OF_MEMORY) << refused;
        EXPECT_EQ(faults.live_buffers, buffers);
        size_t size = 0;
        EXPECT_EQ(plait_sim_read(sim, PLAIT_FIELD_GRID_DENSITY, nullptr, &size),
                  PLAIT_INVALID_STATE);
    }
    faults.fail_create_after = -1;
    EXPECT_EQ(sim.hash(), hash);
    sim.set_grid(&grid);
    EXPECT_EQ(sim.param("grid_form"), std::vector<double>{PLAIT_GRID_FORM_SLOTS});
}

// What is on the device, too: the sim goes on as one that was never asked.
TEST(Faults, AllStaysWhereAFeatureFails) {
    Faults& faults = faulty();
    const auto context = make_context("faulty");
    const auto groom = make_groom(tuft(3, 5));
    plait::SimDesc desc;
    desc.params.bdf2 = 0;
    plait::Sim sim(context, groom, desc), untouched(context, groom, desc);
    auto params = sim.params();
    params.bdf2 = 1;
    params.groom = 0.5f;
    const int buffers = faults.live_buffers;
    int refused = 0;
    for (plait_result result = PLAIT_OUT_OF_MEMORY; result != PLAIT_OK; ++refused) {
        ASSERT_LT(refused, 100);
        faults.fail_create_after = refused;
        result = plait_sim_set_params(sim, &params);
        faults.fail_create_after = -1;
        if (result == PLAIT_OK)
            break;
        EXPECT_EQ(faults.live_buffers, buffers);
        run(sim, 1);
        run(untouched, 1);
        ASSERT_EQ(sim.hash(), untouched.hash()) << "after failure of buffer " << refused;
    }
    EXPECT_GE(refused, 6);
    run(sim, 1);
    run(untouched, 1);
    EXPECT_NE(sim.read(PLAIT_FIELD_POSITION), untouched.read(PLAIT_FIELD_POSITION));
}

TEST(Faults, HairStaysDryWhenWetnessFails) {
    Faults& faults = faulty();
    const auto groom = make_groom(tuft(3, 5));
    plait::SimDesc desc;
    desc.follows_per_guide = 1;
    desc.grid.on = desc.volume.on = desc.wetness.on = true;
    const std::vector<float> wetness{1, 0.5f, 0};
    const auto write = [&](plait::Sim& sim) {
        return plait_sim_write(sim, PLAIT_FIELD_WETNESS, wetness.data(), 12);
    };
    {
        const auto context = make_context("faulty");
        plait::Sim sim(context, groom, desc), untouched(context, groom, desc);
        const int buffers = faults.live_buffers;
        int refused = 0;
        for (plait_result result = PLAIT_OUT_OF_MEMORY; result != PLAIT_OK; ++refused) {
            ASSERT_LT(refused, 100);
            faults.fail_create_after = refused;
            result = write(sim);
            faults.fail_create_after = -1;
            if (result == PLAIT_OK)
                break;
            EXPECT_EQ(result, PLAIT_OUT_OF_MEMORY);
            EXPECT_EQ(faults.live_buffers, buffers);
            EXPECT_EQ(sim.read(PLAIT_FIELD_WETNESS), std::vector<float>(3, 0));
            run(sim, 1);
            run(untouched, 1);
            ASSERT_EQ(sim.hash(), untouched.hash()) << "after failure of buffer " << refused;
        }
        EXPECT_GE(refused, 6);
        EXPECT_EQ(sim.read(PLAIT_FIELD_WETNESS), wetness);
    }
    faults.missing = PLAIT_STAGE_lane_wetness;
    const auto context = make_context("faulty");
    plait::Sim sim(context, groom, desc);
    run(sim, 1);
    EXPECT_EQ(write(sim), PLAIT_UNSUPPORTED);
    EXPECT_NE(std::string(plait_last_error()).find("lane_wetness"), std::string::npos);
    run(sim, 1);
    faults.missing = PLAIT_STAGE_COUNT;
}

TEST(Faults, RootsStayWhenTheirBonesDoNotArrive) {
    Faults& faults = faulty();
    const auto context = make_context("faulty");
    const GroomArrays arrays(tuft(2, 4));
    const std::vector<uint32_t> indices = {0, 0, 0, 0, 0, 0, 0, 0};
    const std::vector<float> weights = {1, 0, 0, 0, 1, 0, 0, 0};
    auto desc = arrays.desc();
    desc.bone_indices = plait::view(indices, 4);
    desc.bone_weights = plait::view(weights, 4);
    const plait::Groom groom(desc);
    plait::Sim sim(context, groom), untouched(context, groom);
    const std::vector<float> bones = {0, -1, 0, 1, 1, 0, 0, 0, 0, 0, 1, 0};
    auto roots = plait_roots_defaults();
    roots.head.t[1] = 0.1f;
    roots.bones = plait::view(bones, 12);
    int refused = 0;
    for (plait_result result = PLAIT_OUT_OF_MEMORY; result != PLAIT_OK; ++refused) {
        ASSERT_LT(refused, 100);
        faults.fail_upload_after = refused;
        result = plait_sim_set_roots(sim, &roots);
        faults.fail_upload_after = -1;
        if (result == PLAIT_OK)
            break;
        EXPECT_EQ(result, PLAIT_OUT_OF_MEMORY);
        run(sim, 2);
        run(untouched, 2);
        ASSERT_EQ(sim.hash(), untouched.hash()) << "after failure of upload " << refused;
    }
    EXPECT_GE(refused, 2);
    run(sim, 1);
    EXPECT_NEAR(sim.read(PLAIT_FIELD_POSITION)[0], 1, 1e-6);
}

// Hair moves all the same, and the call that wants the stage says so.
TEST(Faults, ABackendMayLackAStageThatNoStepTakes) {
    Faults& faults = faulty();
    for (const plait_stage stage : {PLAIT_STAGE_bounds, PLAIT_STAGE_stats, PLAIT_STAGE_skin}) {
        SCOPED_TRACE(plait_stage_describe(stage)->name);
        faults.missing = stage;
        const auto context = make_context("faulty");
        plait::Sim sim(context, make_groom(tuft(3, 5)));
        run(sim, 2);
        size_t size = 8 * sizeof(float);
        std::vector<float> box(8);
        if (stage == PLAIT_STAGE_bounds) {
            EXPECT_EQ(plait_sim_read(sim, PLAIT_FIELD_BOUNDS, box.data(), &size),
                      PLAIT_UNSUPPORTED);
            EXPECT_NE(std::string(plait_last_error()).find("no stage \"bounds\""),
                      std::string::npos)
                << plait_last_error();
        }
        run(sim, 1);
    }
    faults.missing = PLAIT_STAGE_articulated;
    const auto context = make_context("faulty");
    plait_sim* sim = nullptr;
    EXPECT_EQ(plait_sim_create(context, make_groom(tuft(3, 5)), nullptr, &sim), PLAIT_UNSUPPORTED);
    EXPECT_EQ(sim, nullptr);
    faults.missing = PLAIT_STAGE_COUNT;
}

TEST(Faults, StepsThatFailHalfWayLeaveNothingBehind) {
    Faults& faults = faulty();
    const auto context = make_context("faulty");
    plait::Sim sim(context, make_groom(tuft(3, 5)));
    auto collider = smooth_collider();
    const auto id = sim.create_collider(collider);
    faults.lose_after = 0;
    for (int i = 0; i < 200; ++i) { // each fails while it uploads the collider
        collider.pose.t[0] += 0.01f;
        sim.set_collider_pose(id, collider.pose);
        ASSERT_EQ(plait_sim_step(sim, frame), PLAIT_DEVICE_LOST);
    }
}

TEST(Faults, ALostDeviceStaysLost) {
    Faults& faults = faulty();
    {
        const auto context = make_context("faulty");
        plait::Sim sim(context, make_groom(tuft(3, 5)));
        run(sim, 2);
        faults.lose_after = 0;
        EXPECT_EQ(plait_sim_step(sim, frame), PLAIT_DEVICE_LOST);
        faults.lose_after = -1; // it would work again, but nothing may be trusted
        EXPECT_EQ(plait_sim_step(sim, frame), PLAIT_DEVICE_LOST);
        EXPECT_EQ(plait_sim_wait(sim), PLAIT_DEVICE_LOST);
        uint64_t hash = 0;
        EXPECT_EQ(plait_sim_hash(sim, &hash), PLAIT_DEVICE_LOST);
        EXPECT_NE(std::string(plait_last_error()).find("unplugged"), std::string::npos);
        plait_sim* other = nullptr;
        EXPECT_EQ(plait_sim_create(context, make_groom(tuft(1, 3)), nullptr, &other),
                  PLAIT_DEVICE_LOST);
        const auto fresh = make_context("faulty");
        EXPECT_NO_THROW(plait::Sim(fresh, make_groom(tuft(1, 3))));
    }
    EXPECT_EQ(faults.live_buffers, 0);
    EXPECT_EQ(faults.live_devices, 0);
}

} // namespace
