// Hair meets triangles: a sheet that hangs in its way holds it on the side where it is.
#include "story.hpp"

using namespace story;

TEST(Mesh, a_sheet_holds_hair_up) {
    const plait::Context context;
    plait::Sim sim(context, hair(level));
    const std::vector<float> corners{-1, -0.1f, -1, 1, -0.1f, -1, 1, -0.1f, 1, -1, -0.1f, 1};
    const std::vector<std::uint32_t> triangles{0, 2, 1, 0, 3, 2};
    auto desc = plait_mesh_desc_defaults();
    desc.positions = plait::view(corners, 3);
    desc.triangles = plait::view(triangles, 3);
    auto sheet = plait_collider_mesh_desc_defaults();
    sheet.form = PLAIT_MESH_FORM_NEAREST;
    sheet.two_sided = 1;
    sim.create_collider(plait::Mesh(desc), sheet);
    pass(sim, 3);
    for (std::uint32_t i = 1; i < vertices; ++i)
        EXPECT_GT(vertex(sim, 0, i)[1], -0.1005f) << "vertex " << i;
    EXPECT_LT(tip_of(sim)[1], -0.098f) << "it has fallen on it";
}
