// Hair keeps the room that it has in the groom: layers that fall on a floor stay layers.
#include "story.hpp"

using namespace story;

TEST(Volume, holds_layers_apart) {
    const plait::Context context;
    const auto height = [&](bool volume) {
        std::vector<Point> roots;
        for (int i = 0; i < 256; ++i)
            roots.push_back({0, 0.01f * float(i / 16), 0.01f * float(i % 16)});
        plait::SimDesc desc;
        desc.material.bend_stiffness = 0;
        desc.grid.on = true;
        desc.volume.on = volume;
        desc.grid.edge_count = 16;
        plait::Sim sim(context, hairs(roots, level), desc);
        auto floor = plait_collider_desc_defaults();
        floor.kind = PLAIT_COLLIDER_KIND_PLANE;
        floor.plane.normal[1] = 1;
        floor.plane.point[1] = -0.005f;
        sim.create_collider(floor);
        pass(sim, 2);
        const auto x = sim.read(PLAIT_FIELD_POSITION);
        double sum = 0; // of the outer halves, which no root holds up
        for (std::size_t i = 0; i < x.size() / 4; ++i)
            sum += i % vertices >= vertices / 2 ? double(x[4 * i + 1]) : 0;
        return sum / 128 / vertices;
    };
    EXPECT_GT(height(true), 1.5 * height(false));
}
