#include "case.hpp"

#include <algorithm>

namespace plait::cases {
namespace {

constexpr size_t guards = 13; // odd, so that a kernel rounding its range up runs into them
constexpr float guard_float = 8.125e7f;
constexpr uint32_t guard_word = 0xfeedbeefu;

size_t lanes(plait_element element) {
    return element == PLAIT_ELEMENT_FLOAT4 ? 4 : 1;
}

// Strands per tile of the device's lane layout.
uint32_t tile_of(const plait_device_api& api, plait_device* device) {
    plait_device_info info{};
    info.struct_size = sizeof info;
    return api.describe(device, &info) == PLAIT_OK ? std::max(1u, info.tile) : 1;
}

size_t strands_of(const Setup& setup, const Array& array) {
    uint32_t stride; // the first field of every parameter struct of a lane stage
    std::memcpy(&stride, setup.params.data(), sizeof stride);
    return array.floats.size() / (size_t{stride} * array.components);
}

// [strand][V][components] in whole tiles [tile][V][components][strands of the tile], and back. The
// strands that fill up the last tile are copies of the first.
Array laid_out(const Array& plain, const Setup& setup, uint32_t tile) {
    const size_t per_strand = plain.floats.size() / strands_of(setup, plain);
    const size_t strands = strands_of(setup, plain), tiles = (strands + tile - 1) / tile;
    Array lanes = plain;
    lanes.floats.resize(tiles * tile * per_strand);
    for (size_t s = 0; s < tiles * tile; ++s)
        for (size_t k = 0; k < per_strand; ++k)
            lanes.floats[(s / tile * per_strand + k) * tile + s % tile] =
                plain.floats[(s < strands ? s : 0) * per_strand + k];
    return lanes;
}

Array plain(const Array& lanes, const Array& like, const Setup& setup, uint32_t tile) {
    const size_t strands = strands_of(setup, like), per_strand = like.floats.size() / strands;
    Array result = like;
    for (size_t s = 0; s < strands; ++s)
        for (size_t k = 0; k < per_strand; ++k)
            result.floats[s * per_strand + k] =
                lanes.floats[(s / tile * per_strand + k) * tile + s % tile];
    return result;
}

// Every lane parameter struct begins with vertex_stride and tile.
Setup for_tile(const Setup& setup, uint32_t tile) {
    Setup result = setup;
    bool lanes = false;
    for (Array& array : result.buffers)
        if (array.components > 0) {
            array = laid_out(array, setup, tile);
            lanes = true;
        }
    static_assert(
        offsetof(plait_lane_params, tile) == 4 && offsetof(plait_lane_state_params, tile) == 4 &&
        offsetof(plait_lane_unpack_params, tile) == 4 &&
        offsetof(plait_lane_tile_params, tile) == 4 &&
        offsetof(plait_lane_history_params, tile) == 4 &&
        offsetof(plait_lane_orient_params, tile) == 4 &&
        offsetof(plait_lane_wind_params, tile) == 4 && offsetof(plait_lane_fit_params, tile) == 4 &&
        offsetof(plait_lane_pin_params, tile) == 4 &&
        offsetof(plait_lane_groom_params, tile) == 4 &&
        offsetof(plait_lane_move_params, tile) == 4 &&
        offsetof(plait_lane_grid_params, tile) == 4 &&
        offsetof(plait_lane_volume_params, tile) == 4 &&
        offsetof(plait_strand_contact_params, tile) == 4 &&
        offsetof(plait_level_wake_params, tile) == 4 &&
        offsetof(plait_follow_turns_params, tile) == 4);
    if (lanes)
        std::memcpy(result.params.data() + 4, &tile, sizeof tile);
    return result;
}

// Buffers of one dispatch; destroyed with it.
class Bindings {
  public:
    Bindings(const plait_device_api& api, plait_device* device) : api_(api), device_(device) {}
    Bindings(const Bindings&) = delete;
    Bindings& operator=(const Bindings&) = delete;
    ~Bindings() {
        for (plait_buffer* buffer : buffers_)
            if (buffer)
                api_.buffer_destroy(device_, buffer);
    }

    bool add(const char* name, Array array) {
        buffers_.push_back(nullptr);
        if (array.null)
            return true;
        if (array.element == PLAIT_ELEMENT_UINT)
            array.words.resize(array.words.size() + guards, guard_word);
        else
            array.floats.resize(array.floats.size() + guards * lanes(array.element), guard_float);
        const plait_buffer_desc desc = {array.element, array.count(), name};
        return api_.buffer_create(device_, &desc, &buffers_.back()) == PLAIT_OK &&
               api_.buffer_write(device_, buffers_.back(), 0, array.count(), data(array)) ==
                   PLAIT_OK;
    }

    // Reads buffer i back over `array`; true if the guards behind it are whole.
    bool read(size_t i, Array& array, bool& intact) {
        if (array.null)
            return true;
        const size_t count = array.count();
        Array all = array;
        all.words.resize(array.element == PLAIT_ELEMENT_UINT ? count + guards : 0);
        all.floats.resize(
            array.element == PLAIT_ELEMENT_UINT ? 0 : (count + guards) * lanes(array.element));
        if (api_.buffer_read(device_, buffers_[i], 0, all.count(), data(all)) != PLAIT_OK)
            return false;
        for (size_t k = array.floats.size(); k < all.floats.size(); ++k)
            intact = intact && all.floats[k] == guard_float;
        for (size_t k = array.words.size(); k < all.words.size(); ++k)
            intact = intact && all.words[k] == guard_word;
        all.floats.resize(array.floats.size());
        all.words.resize(array.words.size());
        array = all;
        return true;
    }

    plait_buffer* const* list() const { return buffers_.data(); }
    uint32_t count() const { return static_cast<uint32_t>(buffers_.size()); }

  private:
    static void* data(Array& array) {
        return array.element == PLAIT_ELEMENT_UINT ? static_cast<void*>(array.words.data())
                                                   : static_cast<void*>(array.floats.data());
    }

    const plait_device_api& api_;
    plait_device* device_;
    std::vector<plait_buffer*> buffers_;
};

} // namespace

Outputs run(const plait_device_api& api, plait_device* device, plait_stage stage,
            const Setup& given, std::string& error) {
    const uint32_t tile = tile_of(api, device);
    const Setup setup = for_tile(given, tile);
    Bindings bindings(api, device);
    for (const Array& array : setup.buffers)
        if (!bindings.add(setup.name.c_str(), array)) {
            error = setup.name + ": " + api.last_error(device);
            return {};
        }
    const plait_dispatch dispatch = {stage,
                                     setup.items,
                                     setup.width,
                                     setup.params.data(),
                                     static_cast<uint32_t>(setup.params.size()),
                                     bindings.count(),
                                     bindings.list(),
                                     0};
    if (api.submit(device, &dispatch, 1) != PLAIT_OK || api.wait(device) != PLAIT_OK) {
        error = setup.name + ": " + api.last_error(device);
        return {};
    }
    Outputs outputs = setup.buffers;
    for (size_t i = 0; i < outputs.size(); ++i) {
        bool intact = true;
        if (!bindings.read(i, outputs[i], intact))
            error = setup.name + ": " + api.last_error(device);
        else if (!intact)
            error = setup.name + ": wrote behind the end of buffer " + std::to_string(i);
        if (!error.empty())
            return {};
    }
    for (size_t i = 0; i < outputs.size(); ++i)
        if (outputs[i].components > 0)
            outputs[i] = plain(outputs[i], given.buffers[i], given, tile);
    return outputs;
}

} // namespace plait::cases
