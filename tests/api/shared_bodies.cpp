// Colliders that sims share: each sim moves as with colliders of its own, bit for bit, however it steps.
#include "faulty.hpp"
#include "mesh_shapes.hpp"
#include "support.hpp"

#include <memory>
#include <memory_resource>
#include <optional>

namespace {

plait::Mesh make_mesh(const ShapeMesh& shape) {
    auto desc = plait_mesh_desc_defaults();
    desc.positions = {shape.positions.data(), shape.positions.size(), 0};
    desc.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    return plait::Mesh(desc);
}

plait::Mesh head() {
    return make_mesh(ellipsoid_mesh(0.08, 0.1, 0.09, 16, 10));
}

plait_collider_mesh_desc mesh_desc(plait_mesh_form form) {
    auto desc = plait_collider_mesh_desc_defaults();
    desc.form = form;
    desc.cells = 16;
    desc.pose.t[1] = -0.09f;
    return desc;
}

plait_pose moved(int number, float share = 1) {
    const float angle = 0.03f * share * static_cast<float>(number);
    return {{0, std::sin(angle / 2), 0, std::cos(angle / 2)},
            {0.004f * share * static_cast<float>(number), -0.09f, 0.01f}};
}

// A ball, a hull, a head by its field, and by their triangles a jaw and a sheet: made in one call each.
struct Bodies {
    plait_collider_id ball, hull, field, jaw, sheet;
};

// The sims of a character. What is done to bodies is done to one that shares, or to each by itself.
class Character {
  public:
    Character(const plait::Context& of, bool shares) : context_(of), shares_(shares) {
        sims.resize(4);
        for (size_t i = 0; i < 3; ++i)
            make(i);
        if (shares_) {
            sims[1]->share_colliders(sims[0]->get());
            sims[2]->share_colliders(sims[1]->get());
        }
        on_bodies([&](plait::Sim& sim) { make_bodies(sim); });
    }

    // Another one in each call, where they share.
    template <typename Call> void on_bodies(const Call& call) {
        if (!shares_) {
            for (auto& sim : sims)
                if (sim)
                    call(*sim);
            return;
        }
        do
            turn_ = (turn_ + 1) % sims.size();
        while (!sims[turn_]);
        call(*sims[turn_]);
    }

    void aim(int number, float scale) {
        for (auto& sim : sims)
            if (sim)
                sim->set_roots(roots(number, scale));
        on_bodies([&](plait::Sim& sim) {
            sim.set_collider_pose(bodies.ball, moved(number, -1));
            sim.set_collider_pose(bodies.hull, moved(number, 2));
            sim.set_collider_pose(bodies.field, moved(number));
            sim.set_collider_pose(bodies.sheet, moved(number, 0.5f));
        });
        on_bodies([&](plait::Sim& sim) {
            sim.set_collider_positions(bodies.jaw, plait::view(jaw(number, scale), 3));
        });
    }

    static plait_roots roots(int number, float scale) {
        auto roots = plait_roots_defaults();
        roots.head = moved(number);
        roots.head.t[1] = 0;
        roots.scale = scale;
        return roots;
    }

    const std::vector<float>& jaw(int number, float scale) {
        jaw_ = head_.read<float>(PLAIT_MESH_FIELD_POSITIONS);
        for (size_t i = 0; i < jaw_.size(); i += 3) {
            jaw_[i] *= 1 + 0.02f * static_cast<float>(number % 5);
            for (size_t k = 0; k < 3; ++k)
                jaw_[i + k] *= scale;
        }
        return jaw_;
    }

    void make(size_t i) {
        plait::SimDesc desc;
        desc.substeps = i == 1 ? 2 : 1;
        desc.step = i == 2 ? 1.0f / 90 : 1.0f / 60;
        const auto groom = make_groom(tuft(2 + i, 6 + i));
        if (i == 0) {
            const auto [guides, map] = make_groom(tuft(5, 7)).guides(3);
            desc.follow_map = map;
            sims[i].emplace(context_, guides, desc);
        } else {
            sims[i].emplace(context_, groom, desc);
        }
    }

    // Where another has them, if there is one.
    void make_bodies(plait::Sim& sim, const plait::Sim* like = nullptr) {
        const auto at = [&](plait_collider_id id, plait_pose& pose) {
            if (like)
                pose = like->describe_collider(id).pose;
        };
        auto ball = plait_collider_desc_defaults();
        ball.capsule.radius_a = ball.capsule.radius_b = 0.03f;
        at(bodies.ball, ball.pose);
        bodies.ball = sim.create_collider(ball);
        auto hull = plait_collider_hull_desc_defaults();
        hull.pose = moved(0);
        at(bodies.hull, hull.pose);
        bodies.hull = sim.create_hull(make_mesh(box_mesh(0.02, 0.03, 0.02)), hull);
        auto field = mesh_desc(PLAIT_MESH_FORM_FIELD);
        at(bodies.field, field.pose);
        bodies.field = sim.create_collider(head_, field);
        auto jaw = mesh_desc(PLAIT_MESH_FORM_NEAREST);
        jaw.pose.t[0] = 0.1f;
        at(bodies.jaw, jaw.pose);
        bodies.jaw = sim.create_collider(head_, jaw);
        auto sheet = mesh_desc(PLAIT_MESH_FORM_NEAREST);
        sheet.two_sided = 1;
        sheet.pose.t[1] = -0.02f;
        at(bodies.sheet, sheet.pose);
        bodies.sheet = sim.create_collider(make_mesh(sheet_mesh(0.2)), sheet);
    }

    // One that comes when bodies are on their way; by itself it makes them where they were last sent.
    void come_late(int number, float scale) {
        make(3);
        plait::Sim& sim = *sims[3];
        sim.set_roots(roots(number, scale));
        if (shares_) {
            sim.share_colliders(sims[2]->get());
            return;
        }
        make_bodies(sim, &*sims[0]);
        sim.set_collider_positions(bodies.jaw, plait::view(jaw(number, scale), 3));
        sim.place_collider(bodies.jaw, sims[0]->describe_collider(bodies.jaw).pose);
    }

    std::vector<std::optional<plait::Sim>> sims;
    Bodies bodies{};

  private:
    const plait::Context& context_;
    bool shares_;
    size_t turn_ = 0;
    plait::Mesh head_ = head();
    std::vector<float> jaw_;
};

class SharedBodies : public OnBackend {};
ON_EVERY_BACKEND(SharedBodies);

TEST_P(SharedBodies, GiveTheBitsOfBodiesOfOnesOwn) {
    Character shared(context, true), own(context, false);
    EXPECT_EQ(shared.sims[2]->colliders().size(), 5u);
    for (int number = 1; number <= 24; ++number) {
        SCOPED_TRACE(number);
        const float scale = number < 16 ? 1.0f : 1.3f;
        for (Character* each : {&shared, &own}) {
            auto& sims = each->sims;
            each->aim(number, scale);
            if (number == 5)
                each->on_bodies([&](plait::Sim& sim) {
                    sim.place_collider(each->bodies.ball, moved(9));
                    sim.place_collider(each->bodies.jaw, moved(9));
                });
            if (number == 12)
                each->on_bodies([&](plait::Sim& sim) {
                    auto ball = sim.describe_collider(each->bodies.ball);
                    ball.capsule.radius_a = 0.06f;
                    sim.set_collider_shape(each->bodies.ball, ball);
                });
            if (number == 9)
                sims[1].reset();
            if (number == 11)
                each->come_late(number, scale);
            if (number == 13) {
                const auto gone = each->bodies.jaw;
                each->on_bodies([&](plait::Sim& sim) {
                    sim.destroy_collider(gone);
                    each->bodies.jaw =
                        sim.create_collider(head(), mesh_desc(PLAIT_MESH_FORM_NEAREST));
                });
            }
            if (number == 18)
                sims[2]->teleport(Character::roots(40, scale));
            if (number == 20)
                sims[3]->reset();
            if (number == 22) {
                each->on_bodies([&](plait::Sim& sim) { sim.destroy_collider(each->bodies.field); });
                each->bodies.field = each->bodies.ball;
            }
            // together, one after another at rates of their own, and one of them not at all
            if (number % 3 == 0) {
                std::vector<plait_sim*> list;
                for (auto& sim : sims)
                    if (sim)
                        list.push_back(sim->get());
                context.step(list, frame);
            } else {
                for (size_t i = sims.size(); i-- > 0;)
                    if (sims[i] && !(i == 2 && number % 3 == 1))
                        sims[i]->step(frame * (i == 0 ? 0.7 : number % 2 ? 2 : 1));
            }
        }
        for (size_t i = 0; i < own.sims.size(); ++i) {
            if (!own.sims[i])
                continue;
            EXPECT_EQ(shared.sims[i]->hash(), own.sims[i]->hash()) << "sim " << i;
            EXPECT_EQ(shared.sims[i]->read(PLAIT_FIELD_POSITION),
                      own.sims[i]->read(PLAIT_FIELD_POSITION))
                << "sim " << i;
        }
    }
    for (const size_t i : {0, 2, 3})
        EXPECT_EQ(own.sims[i]->colliders().size(), 4u);
}

// Whoever made them may go.
TEST_P(SharedBodies, StayWhileASimHasThem) {
    const auto groom = make_groom(tuft(2, 6));
    auto first = std::make_unique<plait::Sim>(context, groom);
    plait::Sim second(context, groom), alone(context, groom);
    second.share_colliders(first->get());
    const auto id = first->create_collider(head(), mesh_desc(PLAIT_MESH_FORM_FIELD));
    alone.create_collider(head(), mesh_desc(PLAIT_MESH_FORM_FIELD));
    first.reset();
    second.set_collider_pose(id, moved(3));
    alone.set_collider_pose(id, moved(3));
    run(second, 3);
    run(alone, 3);
    EXPECT_EQ(second.hash(), alone.hash());
    second.destroy_collider(id);
    EXPECT_TRUE(second.colliders().empty());
}

TEST_P(SharedBodies, BecomeEachSimsOwnWhenSharingEnds) {
    const auto groom = make_groom(tuft(2, 6));
    plait::Sim a(context, groom), b(context, groom);
    b.share_colliders(a);
    b.share_colliders(a); // nothing changes
    a.share_colliders(b);
    const auto ball = b.create_collider(smooth_collider());
    const auto mesh = a.create_collider(head(), mesh_desc(PLAIT_MESH_FORM_FIELD));
    b.share_colliders(nullptr);
    b.share_colliders(nullptr);
    a.set_collider_pose(ball, moved(5));
    EXPECT_EQ(a.describe_collider(ball).pose.t[0], moved(5).t[0]);
    EXPECT_EQ(b.describe_collider(ball).pose.t[0], 0);
    b.destroy_collider(mesh);
    EXPECT_EQ(a.colliders().size(), 2u);
    run(a, 2);
    run(b, 2);
}

TEST_P(SharedBodies, WhatCannotBeIsRefused) {
    const auto other_context = make_context(GetParam());
    const auto groom = make_groom(tuft(2, 6));
    plait::Sim a(context, groom), b(context, groom), c(context, groom), d(context, groom),
        rigid(context, groom, tressfx_desc()), foreign(other_context, groom);
    const auto refused = [](plait_result result, plait_result expected, const char* text) {
        EXPECT_EQ(result, expected);
        EXPECT_NE(std::string(plait_last_error()).find(text), std::string::npos)
            << plait_last_error();
    };
    refused(plait_sim_share_colliders(a, a), PLAIT_INVALID_ARGUMENT, "with is the sim itself");
    refused(plait_sim_share_colliders(a, foreign), PLAIT_INVALID_ARGUMENT,
            "with is of another context");
    b.share_colliders(a);
    d.share_colliders(c);
    refused(plait_sim_share_colliders(b, c), PLAIT_INVALID_STATE, "shares the colliders of others");
    const auto ball = a.create_collider(smooth_collider());
    c.create_collider(smooth_collider());
    d.share_colliders(nullptr);
    d.set_collider_shape(ball, plait_collider_desc_defaults());
    refused(plait_sim_share_colliders(d, a), PLAIT_INVALID_STATE,
            "1 colliders of its own, which are not those of `with`");
    d.destroy_collider(ball);
    const plait_pose pose = moved(1);
    refused(plait_collider_set_pose(d, ball, &pose), PLAIT_NOT_FOUND, "is not in this sim");
    rigid.share_colliders(a); // no mesh is there
    const auto mesh = head();
    const auto desc = mesh_desc(PLAIT_MESH_FORM_FIELD);
    plait_collider_id id{};
    refused(plait_collider_create_mesh(b, mesh, &desc, &id), PLAIT_INVALID_STATE, "model 0");
    for (const plait::Sim* sim : {&a, &b, &rigid})
        EXPECT_EQ(sim->colliders().size(), 1u);
    rigid.share_colliders(nullptr);
    rigid.destroy_collider(ball);
    b.create_collider(mesh, desc);
    refused(plait_sim_share_colliders(rigid, a), PLAIT_INVALID_STATE, "model 0");
    b.destroy_collider(ball);
    refused(plait_collider_destroy(a, ball), PLAIT_NOT_FOUND, "is not in this sim");
    EXPECT_EQ(a.colliders().size(), 1u);
}

TEST_P(SharedBodies, SnapshotsHoldThemAsEachSimSeesThem) {
    Character shared(context, true), own(context, false);
    const auto pass = [&](int first, int last) {
        for (int number = first; number <= last; ++number)
            for (Character* each : {&shared, &own}) {
                each->aim(number, 1);
                for (size_t i = 0; i < 3; ++i)
                    if (i != 1 || number % 2)
                        each->sims[i]->step(frame);
            }
    };
    const auto same = [&] {
        for (size_t i = 0; i < 3; ++i)
            EXPECT_EQ(shared.sims[i]->save(), own.sims[i]->save()) << i;
    };
    pass(1, 4);
    std::vector<std::vector<unsigned char>> saved;
    for (size_t i = 0; i < 3; ++i)
        saved.push_back(own.sims[i]->save());
    same();
    pass(5, 7);
    const auto before = shared.sims[0]->hash();
    for (Character* each : {&shared, &own})
        each->sims[1]->restore(saved[1]); // of one alone
    EXPECT_EQ(shared.sims[0]->hash(), before);
    same();
    pass(8, 10);
    same();
    for (Character* each : {&shared, &own}) // back in time, all of them
        for (size_t i = 0; i < 3; ++i)
            each->sims[i]->restore(saved[i]);
    pass(5, 7);
    same();
    // those of another world
    plait::Sim plain(context, make_groom(tuft(3, 7)));
    plain.create_collider(smooth_collider());
    auto desc = plait::SimDesc();
    desc.substeps = 2;
    const auto others = plait::Sim(context, make_groom(tuft(3, 7)), desc).save();
    const auto hash = shared.sims[1]->hash();
    EXPECT_EQ(plait_sim_restore(*shared.sims[1], others.data(), others.size()),
              PLAIT_INVALID_STATE);
    EXPECT_NE(std::string(plait_last_error()).find("other colliders than the sim, which shares"),
              std::string::npos)
        << plait_last_error();
    EXPECT_EQ(shared.sims[1]->hash(), hash);
}

// A saved game: sims are made, restored, and share again; one that comes later is measured as before.
TEST_P(SharedBodies, AreSharedAgainAfterARestore) {
    Character before(context, true);
    for (int number = 1; number <= 4; ++number) {
        before.aim(number, 1);
        for (size_t i = 0; i < 3; ++i)
            before.sims[i]->step(frame);
    }
    Character after(context, false);
    for (size_t i = 0; i < 3; ++i) {
        after.sims[i]->restore(before.sims[i]->save());
        before.sims[i]->restore(before.sims[i]->save()); // the reference has more digits
    }
    uint64_t apart = 0, together = 0;
    for (size_t i = 0; i < 3; ++i)
        apart += after.sims[i]->describe().device_bytes;
    after.sims[1]->share_colliders(after.sims[0]->get());
    after.sims[2]->share_colliders(after.sims[0]->get());
    for (size_t i = 0; i < 3; ++i)
        together += after.sims[i]->describe().device_bytes;
    EXPECT_LT(together + 50000, apart);
    for (Character* each : {&before, &after}) {
        each->make(3);
        each->sims[3]->set_roots(Character::roots(4, 1));
        each->sims[3]->share_colliders(each->sims[1]->get());
        each->sims[0]->set_collider_pose(before.bodies.field, moved(8));
        for (size_t i = 0; i < 4; ++i)
            each->sims[i]->step(frame);
    }
    for (size_t i = 0; i < 4; ++i)
        EXPECT_EQ(before.sims[i]->save(), after.sims[i]->save()) << i;
}

// The geometry of meshes is there once: what a further sim takes is what depends on its hair and its way.
TEST_P(SharedBodies, TakeTheMemoryOfOne) {
    const auto bytes = [&](size_t count, bool shares) {
        const auto groom = make_groom(tuft(2, 6));
        std::vector<plait::Sim> sims;
        uint64_t sum = 0;
        for (size_t i = 0; i < count; ++i) {
            sims.emplace_back(context, groom);
            sum -= sims.back().describe().device_bytes;
            if (shares && i > 0)
                sims[i].share_colliders(sims[0]);
            else
                for (const auto form : {PLAIT_MESH_FORM_FIELD, PLAIT_MESH_FORM_NEAREST})
                    sims[i].create_collider(head(), mesh_desc(form));
        }
        for (const plait::Sim& sim : sims)
            sum += sim.describe().device_bytes;
        return sum;
    };
    const double one = double(bytes(1, false)), four = double(bytes(4, false));
    EXPECT_EQ(four, 4 * one);
    // of a FIELD of 16 cells and 300 triangles
    const double geometry = 16 * 18 * 16 * 4 + 300 * (6 + 3 + 2 * 2.5) * 4;
    EXPECT_LT(double(bytes(4, true)), four - 3 * 0.8 * geometry);
}

// ---- what fails ---------------------------------------------------------------------------------

// Three sims that share a head in both forms, and the same by themselves.
struct Trio {
    explicit Trio(const plait::Context& context) {
        const auto groom = make_groom(tuft(2, 6));
        for (int i = 0; i < 3; ++i) {
            sims.emplace_back(context, groom);
            if (i == 1)
                sims[1].share_colliders(sims[0]);
        }
        sims[0].create_collider(smooth_collider());
        for (const auto form : {PLAIT_MESH_FORM_FIELD, PLAIT_MESH_FORM_NEAREST})
            sims[0].create_collider(mesh, mesh_desc(form));
    }
    std::vector<uint64_t> pass() {
        std::vector<uint64_t> hashes;
        for (plait::Sim& sim : sims) {
            sim.step(frame);
            hashes.push_back(sim.hash());
        }
        return hashes;
    }
    plait::Mesh mesh = head();
    std::vector<plait::Sim> sims;
};

struct FailingCall {
    const char* name;
    plait_result (*make)(Trio&);
};
const FailingCall failing_calls[] = {
    {"a field",
     [](Trio& t) {
         const auto desc = mesh_desc(PLAIT_MESH_FORM_FIELD);
         plait_collider_id id{};
         return plait_collider_create_mesh(t.sims[1], t.mesh, &desc, &id);
     }},
    {"triangles",
     [](Trio& t) {
         const auto desc = mesh_desc(PLAIT_MESH_FORM_NEAREST);
         plait_collider_id id{};
         return plait_collider_create_mesh(t.sims[1], t.mesh, &desc, &id);
     }},
    {"a ball",
     [](Trio& t) {
         const auto desc = smooth_collider();
         plait_collider_id id{};
         return plait_collider_create(t.sims[1], &desc, &id);
     }},
    {"a field goes",
     [](Trio& t) { return plait_collider_destroy(t.sims[0], t.sims[0].colliders()[1]); }},
    {"triangles go",
     [](Trio& t) { return plait_collider_destroy(t.sims[0], t.sims[0].colliders()[2]); }},
    {"sharing", [](Trio& t) { return plait_sim_share_colliders(t.sims[2], t.sims[0]); }},
};

// All or none: whichever buffer there is no room for, they go on as if nothing had been asked, and have
// the same bodies, under the same ids.
TEST(SharedBodiesFault, EveryDeviceBufferMayFail) {
    Faults& faults = faulty();
    for (const FailingCall& call : failing_calls) {
        SCOPED_TRACE(call.name);
        const auto context = make_context("faulty");
        Trio tried(context), untouched(context);
        const int buffers = faults.live_buffers;
        for (int refused = 0;; ++refused) {
            ASSERT_LT(refused, 200);
            faults.fail_create_after = refused;
            const plait_result result = call.make(tried);
            faults.fail_create_after = -1;
            if (result == PLAIT_OK)
                break;
            ASSERT_EQ(result, PLAIT_OUT_OF_MEMORY) << plait_last_error();
            ASSERT_EQ(faults.live_buffers, buffers) << refused;
            ASSERT_EQ(tried.pass(), untouched.pass()) << "after failure of buffer " << refused;
        }
        ASSERT_EQ(call.make(untouched), PLAIT_OK);
        EXPECT_EQ(tried.pass(), untouched.pass());
        for (size_t i = 1; i < 3; ++i)
            if (!tried.sims[i].colliders().empty()) {
                EXPECT_EQ(tried.sims[0].colliders().size(), tried.sims[i].colliders().size());
            }
    }
}

struct Pool { // refuses allocation number `fail_at`
    int fail_at = -1;
    int made = 0;

    static void* allocate(size_t size, size_t alignment, void* user) {
        auto* pool = static_cast<Pool*>(user);
        if (pool->made++ == pool->fail_at)
            return nullptr;
        return ::operator new(size, std::align_val_t(alignment), std::nothrow);
    }
    static void release(void* memory, size_t, size_t alignment, void*) {
        ::operator delete(memory, std::align_val_t(alignment));
    }
};

TEST(SharedBodiesFault, EveryHostAllocationMayFail) {
    for (const FailingCall& call : failing_calls) {
        SCOPED_TRACE(call.name);
        Pool pool;
        auto desc = plait_context_desc_defaults();
        desc.backend = "reference";
        desc.allocator = {Pool::allocate, Pool::release, &pool};
        const plait::Context context(desc);
        Trio tried(context), untouched(context);
        int refused = 0;
        for (;; ++refused) {
            ASSERT_LT(refused, 2000);
            pool.made = 0;
            pool.fail_at = refused;
            const plait_result result = call.make(tried);
            pool.fail_at = -1;
            if (result == PLAIT_OK)
                break;
            ASSERT_EQ(result, PLAIT_OUT_OF_MEMORY) << plait_last_error();
            if (refused % 5 == 0) {
                ASSERT_EQ(tried.pass(), untouched.pass()) << "after failure of " << refused;
            }
        }
        ASSERT_EQ(call.make(untouched), PLAIT_OK);
        EXPECT_EQ(tried.pass(), untouched.pass()) << refused;
    }
}

} // namespace
