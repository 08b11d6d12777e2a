#include "recording.hpp"
#include "scene/read_field.hpp"

#include <plait/plait_offline.h>

namespace simulate {

namespace {

// The diameters of the groom's file, in the order in which a sim shows its strands; none where it shows
// others, too.
std::vector<float> widths_of(const Scene& scene, const Figure& figure) {
    std::vector<float> widths = read_field<float>(figure.groom.get(), PLAIT_GROOM_FIELD_THICKNESS);
    if (scene.sim.follows_per_guide > 0)
        return {};
    if (!figure.follows || widths.empty())
        return widths;
    size_t size = 0;
    check(plait_follow_map_read(figure.follows.get(), PLAIT_FOLLOW_MAP_FIELD_STRANDS, nullptr,
                                &size));
    std::vector<uint32_t> strands(size / sizeof(uint32_t));
    check(plait_follow_map_read(figure.follows.get(), PLAIT_FOLLOW_MAP_FIELD_STRANDS,
                                strands.data(), &size));
    std::vector<float> shown;
    for (const uint32_t strand : strands)
        shown.push_back(widths[strand]);
    return shown;
}

} // namespace

bool Recording::is_for(const std::string& path) {
    return path.ends_with(".abc") || path.ends_with(".usda");
}

Recording::Recording(const std::string& path, const Scene& scene, const Figure& figure)
    : rate_(scene.rate) {
    plait_recorder_desc desc = plait_recorder_desc_defaults();
    desc.frames_per_second = scene.rate;
    desc.velocities = 1;
    const std::vector<float> widths = widths_of(scene, figure);
    desc.widths = {widths.data(), widths.size(), 0};
    plait_recorder* recorder = nullptr;
    check(plait_recorder_create(path.c_str(), &desc, &recorder));
    recorder_.reset(recorder);
}

void Recording::add(const Shot& shot) {
    packed_.clear();
    for (size_t strand = 0; strand < shot.vertex_count.size(); ++strand)
        for (uint32_t vertex = 0; vertex < shot.vertex_count[strand]; ++vertex) {
            const float* const p = &shot.positions[4 * (strand * shot.row + vertex)];
            packed_.insert(packed_.end(), p, p + 3);
        }
    const plait_view counts{shot.vertex_count.data(), shot.vertex_count.size(), 0};
    const plait_view positions{packed_.data(), packed_.size() / 3, 0};
    check(plait_recorder_add_positions(recorder_.get(), &counts, &positions,
                                       static_cast<double>(shot.frame) / rate_));
    any_ = true;
}

void Recording::close() {
    if (any_)
        check(plait_recorder_close(recorder_.get()));
}

} // namespace simulate
