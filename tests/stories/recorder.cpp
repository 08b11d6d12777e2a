// Hair goes to where it is rendered: a file of it as it moves, whole or not there.
#include "story.hpp"

#include <plait/plait_recorder.h>

#include <filesystem>

using namespace story;

namespace fs = std::filesystem;

TEST(Recorder, writes_a_file_that_begins_where_the_hair_began) {
    const fs::path file = fs::temp_directory_path() / "plait_story.abc";
    fs::remove(file);
    const plait::Context context;
    plait::Sim sim(context, hair(level));

    plait_recorder* recorder = nullptr;
    plait::check(plait_recorder_create(file.string().c_str(), nullptr, &recorder));
    for (int frame = 0; frame < 24; ++frame) {
        plait::check(plait_recorder_add(recorder, sim, frame / 24.0));
        sim.step(1.0 / 24);
    }
    EXPECT_FALSE(fs::exists(file)) << "not before it is whole";
    plait::check(plait_recorder_close(recorder));
    plait_recorder_destroy(recorder);

    const std::size_t frame_bytes = 12 * vertices; // float[3] each
    EXPECT_GT(fs::file_size(file), 24 * frame_bytes);
    const plait::Groom first = plait::Groom::load(file.string()); // its first frame
    const auto positions = first.read<float>(PLAIT_GROOM_FIELD_POSITIONS);
    EXPECT_EQ(positions[3 * tip], length) << "to the bit: it has not moved yet";
    EXPECT_LT(tip_of(sim)[1], -0.05f) << "but it has since";
    fs::remove(file);
}
