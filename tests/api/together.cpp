// Many sims in one call: plait_context_step.
#include "faulty.hpp"
#include "support.hpp"

#include <cstddef>
#include <cstring>
#include <memory>

namespace {

constexpr plait_model every_model[] = {PLAIT_MODEL_ARTICULATED, PLAIT_MODEL_TRESSFX};

// Of one context: both models, of another size each, alone and with everything.
class Crowd {
  public:
    explicit Crowd(const plait::Context& context) {
        for (const plait_model model : every_model)
            for (const bool everything : {false, true})
                add(context, model, everything);
    }

    // Heads, roots of their own and colliders move, each by a way of its own.
    void aim(int number) {
        for (size_t i = 0; i < sims.size(); ++i) {
            const float x = 0.004f * static_cast<float>(number) * static_cast<float>(i % 3);
            auto roots = head_at({x, 0.01f, -x});
            const std::vector<plait_pose> own(strands_of(i), {{0, 0, 0, 1}, {0, x, 0}});
            if (i % 4 == 1)
                roots.root_poses = plait::view(own);
            sims[i].set_roots(roots);
            for (const plait_collider_id id : sims[i].colliders())
                sims[i].set_collider_pose(id, roots.head);
        }
    }
    std::vector<plait_sim*> handles() const {
        return {sims.begin(), sims.end()}; // by Sim's conversion
    }

    std::vector<plait::Sim> sims;

  private:
    static size_t strands_of(size_t i) { return 3 + 17 * (i % 5); }

    void add(const plait::Context& context, plait_model model, bool everything) {
        plait::SimDesc desc;
        desc.model = model;
        if (everything) {
            desc.substeps = 2;
            desc.follows_per_guide = 2;
            desc.interpolate_output = desc.keep_last_frame = 1;
            desc.grid.on = true;
        }
        sims.emplace_back(context, make_groom(tuft(strands_of(sims.size()), 8)), desc);
        auto collider = smooth_collider();
        collider.capsule.radius_a = collider.capsule.radius_b = 0.03f;
        collider.pose.t[1] = -0.05f;
        if (everything)
            sims.back().create_collider(collider);
    }
};

class Together : public OnBackend {};
ON_EVERY_BACKEND(Together);

// Bit for bit, whatever a sim has, also where a call has several fixed steps or none.
TEST_P(Together, IsOneAfterAnother) {
    Crowd together(context), apart(context);
    const double calls[] = {frame, frame, 3 * frame, 0.4 * frame, 0.7 * frame, 0, frame};
    int number = 0;
    for (const double dt : calls) {
        together.aim(++number);
        apart.aim(number);
        context.step(together.handles(), dt);
        for (plait::Sim& sim : apart.sims)
            sim.step(dt);
    }
    for (size_t i = 0; i < apart.sims.size(); ++i) {
        plait::Sim &one = together.sims[i], &other = apart.sims[i];
        EXPECT_GT(other.measure().max_speed, 1e-3f) << i;
        EXPECT_EQ(one.describe().steps, other.describe().steps) << i;
        EXPECT_EQ(one.hash(), other.hash()) << i;
        EXPECT_EQ(one.read(PLAIT_FIELD_POSITION), other.read(PLAIT_FIELD_POSITION)) << i;
        EXPECT_EQ(one.read(PLAIT_FIELD_TANGENT), other.read(PLAIT_FIELD_TANGENT)) << i;
        if (i % 2 == 1) {
            EXPECT_EQ(one.read(PLAIT_FIELD_POSITION_LAST_FRAME),
                      other.read(PLAIT_FIELD_POSITION_LAST_FRAME))
                << i;
        }
    }
}

// A wait for one is a wait for all: what they have made can be read, and they go on alone.
TEST_P(Together, GoOnOneByOne) {
    Crowd crowd(context), apart(context);
    for (int i = 1; i < 5; ++i) {
        crowd.aim(i);
        apart.aim(i);
        if (i % 2)
            context.step(crowd.handles(), frame);
        for (plait::Sim& sim : i % 2 ? apart.sims : crowd.sims)
            sim.step(frame);
        if (i % 2 == 0)
            context.step(apart.handles(), frame);
    }
    crowd.sims.front().wait();
    for (size_t i = 0; i < crowd.sims.size(); ++i)
        EXPECT_EQ(crowd.sims[i].hash(), apart.sims[i].hash()) << i;
}

TEST_P(Together, WhatCannotBeSteppedIsNamedAndNothingMoves) {
    const auto other = make_context(GetParam());
    const auto groom = make_groom(tuft(2, 5));
    plait::Sim a(context, groom), b(context, groom), foreign(other, groom);
    const auto refused = [&](const std::vector<plait_sim*>& sims, double dt, const char* text) {
        EXPECT_EQ(plait_context_step(context, sims.data(), sims.size(), dt),
                  PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find(text), std::string::npos)
            << plait_last_error();
        EXPECT_EQ(a.describe().steps + b.describe().steps + foreign.describe().steps, 0u);
    };
    refused({a, nullptr}, frame, "sims[1] is NULL");
    refused({a, b, foreign}, frame, "sims[2] is of another context");
    refused({a, b, a}, frame, "sims[2] is sims[0] again");
    refused({a, b}, -1, "dt is -1, range is [0, 1e9] s");
    refused({a, b}, NAN, "dt is ");
    EXPECT_EQ(plait_context_step(context, nullptr, 2, frame), PLAIT_INVALID_ARGUMENT);
    plait_sim* const list[] = {a};
    EXPECT_EQ(plait_context_step(nullptr, list, 1, frame), PLAIT_INVALID_ARGUMENT);
    EXPECT_EQ(plait_context_step(context, nullptr, 0, frame), PLAIT_OK);
    context.step({a, b}, frame);
    EXPECT_EQ(a.describe().steps + b.describe().steps, 2u);
}

// Launches and times are each sim's own.
TEST_P(Together, AreTimedOneByOne) {
    auto desc = plait_context_desc_defaults();
    desc.backend = GetParam().c_str();
    desc.profile = 1;
    const plait::Context timed(desc);
    const auto names = [](plait::Sim& sim) {
        std::vector<std::string> list;
        for (const plait_launch& launch : sim.take_launches())
            list.push_back(launch.stage + std::string(" ") + std::to_string(launch.items));
        return list;
    };
    Crowd together(timed), apart(timed);
    for (Crowd* crowd : {&together, &apart}) {
        crowd->aim(1);
        for (plait::Sim& sim : crowd->sims) {
            sim.take_launches();
            sim.stage_times(true);
        }
    }
    timed.step(together.handles(), frame);
    for (plait::Sim& sim : apart.sims)
        sim.step(frame);
    for (size_t i = 0; i < apart.sims.size(); ++i) {
        plait::Sim &one = together.sims[i], &other = apart.sims[i];
        const auto expected = names(other);
        EXPECT_GT(expected.size(), 2u);
        EXPECT_EQ(names(one), expected) << i;
        const auto times = one.stage_times(), others = other.stage_times();
        ASSERT_EQ(times.size(), others.size()) << i;
        for (size_t k = 0; k < times.size(); ++k)
            EXPECT_EQ(times[k].calls, others[k].calls) << i << ", " << times[k].stage;
    }
}

// Those before the one that fails have moved, those after it have not; and they go on.
TEST(TogetherOnFaulty, TheSimThatFailedIsNamed) {
    Faults& faults = faulty();
    const auto context = make_context("faulty");
    const auto groom = make_groom(tuft(3, 5));
    plait::Sim a(context, groom), b(context, groom), c(context, groom);
    for (plait::Sim* sim : {&a, &b, &c})
        sim->create_collider(smooth_collider()); // is uploaded
    faults.fail_upload_after = 1;
    plait_sim* const list[] = {a, b, c};
    EXPECT_EQ(plait_context_step(context, list, 3, frame), PLAIT_OUT_OF_MEMORY);
    const std::string text = plait_last_error();
    EXPECT_NE(text.find("sims[1]: "), std::string::npos) << text;
    EXPECT_NE(text.find("no way there (injected)"), std::string::npos) << text;
    EXPECT_EQ(a.describe().steps, 1u);
    EXPECT_EQ(c.describe().steps, 0u);
    faults.fail_upload_after = -1;
    c.step(frame);
    EXPECT_EQ(a.hash(), c.hash());
    context.step({a, b, c}, frame);
    EXPECT_EQ(a.describe().steps, 2u);
}

// ---- what a backend is asked --------------------------------------------------------------------

// The best backend there is, under another name, that writes down what it is asked: s a list of
// stages, u an upload, w a wait, b and n and e the sequences, ? whatever else moves memory.
std::string asked;
const plait_backend_api* inner = nullptr;

plait_result submit(plait_device* device, const plait_dispatch* list, size_t count) {
    asked += 's';
    return inner->device->submit(device, list, count);
}
plait_result upload(plait_device* device, plait_buffer* buffer, size_t first, size_t count,
                    const void* src) {
    asked += 'u';
    return inner->device->buffer_upload(device, buffer, first, count, src);
}
plait_result write(plait_device* device, plait_buffer* buffer, size_t first, size_t count,
                   const void* src) {
    asked += '?';
    return inner->device->buffer_write(device, buffer, first, count, src);
}
plait_result wait(plait_device* device) {
    asked += 'w';
    return inner->device->wait(device);
}
plait_result overlap(plait_device* device, plait_overlap what) {
    asked += what == PLAIT_OVERLAP_BEGIN ? 'b' : what == PLAIT_OVERLAP_NEXT ? 'n' : 'e';
    return inner->device->overlap ? inner->device->overlap(device, what) : PLAIT_OK;
}

void register_watched(const char* name, uint32_t struct_size) {
    inner = plait_backend_get(0);
    static std::vector<std::unique_ptr<plait_device_api>> devices;
    static std::vector<std::unique_ptr<plait_backend_api>> backends;
    auto& device = *devices.emplace_back(std::make_unique<plait_device_api>(*inner->device));
    device.struct_size = struct_size;
    device.submit = submit;
    device.buffer_upload = upload;
    device.buffer_write = write;
    device.wait = wait;
    device.overlap = overlap;
    auto& api = *backends.emplace_back(std::make_unique<plait_backend_api>(*inner));
    api.name = name;
    api.score = [] { return -100; };
    api.device = &device;
    ASSERT_EQ(plait_backend_register(&api), PLAIT_OK) << plait_last_error();
}

std::string once_each(const std::string& text) { // without repetitions
    std::string result;
    for (const char c : text)
        if (result.empty() || result.back() != c)
            result += c;
    return result;
}

TEST(WhatABackendIsAsked, IsASequenceForEachSim) {
    register_watched("watched", sizeof(plait_device_api));
    const auto context = make_context("watched");
    const auto groom = make_groom(tuft(3, 5));
    plait::Sim a(context, groom), b(context, groom), c(context, groom);
    b.create_collider(smooth_collider());
    asked.clear();
    context.step({a, b, c}, frame);
    EXPECT_EQ(once_each(asked), "bsnusnse");
    asked.clear();
    context.step({a}, frame);
    EXPECT_EQ(once_each(asked), "s") << "alone it overlaps with nothing";
}

// Else the first step takes the time of what creation left on the queue.
TEST(WhatABackendIsAsked, IsDoneWhenASimHasBeenMade) {
    register_watched("watched at creation", sizeof(plait_device_api));
    const auto context = make_context("watched at creation");
    for (const plait_model model : every_model) {
        plait::SimDesc desc;
        desc.model = model;
        desc.keep_last_frame = 1;
        asked.clear();
        plait::Sim sim(context, make_groom(tuft(3, 5)), desc);
        ASSERT_NE(asked.find('s'), std::string::npos);
        EXPECT_EQ(asked.back(), 'w') << asked;
    }
}

// One that was compiled before the function was there, and one that leaves it out.
TEST(WhatABackendIsAsked, MayBeWithoutSequences) {
    register_watched("older", offsetof(plait_device_api, overlap));
    const auto context = make_context("older");
    const auto groom = make_groom(tuft(3, 5));
    plait::Sim a(context, groom), b(context, groom), alone(context, groom);
    asked.clear();
    context.step({a, b}, frame);
    EXPECT_EQ(once_each(asked), "s");
    alone.step(frame);
    EXPECT_EQ(a.hash(), alone.hash());
    EXPECT_EQ(b.hash(), alone.hash());
}

TEST(WhatABackendIsAsked, HasAllThatIsNotOptional) {
    plait_device_api device = *plait_backend_get(0)->device;
    plait_backend_api api = *plait_backend_get(0);
    api.name = "too short";
    api.device = &device;
    for (const size_t size : {offsetof(plait_device_api, overlap) - 1, sizeof device + 8}) {
        device.struct_size = static_cast<uint32_t>(size);
        EXPECT_EQ(plait_backend_register(&api), PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find("device->struct_size"), std::string::npos)
            << plait_last_error();
    }
}

} // namespace
