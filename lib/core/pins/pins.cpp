#include "core/pins/pins.hpp"

#include "base/format.hpp"

#include <cmath>
#include <cstring>
#include <utility>

namespace plait {
namespace {

constexpr float stiffest = PLAIT_PIN_HELD; // N/m
constexpr float farthest = 1e6f;           // m

void add_target(Schedule& schedule, const Layout& layout, const State& state, const Buffer& to,
                float scale) {
    schedule.add(PLAIT_STAGE_pins, layout.guide_vertices(),
                 plait_pins_params{layout.row, 1, 1 / scale, 1 / scale},
                 {&state.pin, &state.pin, &to});
}

} // namespace

Status open_pins(Device& device, const Layout& layout, State& state,
                 std::pmr::memory_resource* memory) {
    Buffer pin, at, from, to;
    PLAIT_TRY(make_rows(device, layout, pin, "pin", memory));
    PLAIT_TRY(make_rows(device, layout, at, "pin_at", memory));
    PLAIT_TRY(make_rows(device, layout, from, "pin_from", memory));
    PLAIT_TRY(make_rows(device, layout, to, "pin_to", memory));
    state.pin = std::move(pin);
    state.pin_at = std::move(at);
    state.pin_from = std::move(from);
    state.pin_to = std::move(to);
    return {};
}

void close_pins(State& state) {
    for (Buffer* buffer : {&state.pin, &state.pin_at, &state.pin_from, &state.pin_to})
        *buffer = {};
}

void advance_pins(State& state) {
    std::swap(state.pin_from, state.pin_to);
}

void append_pin_targets(Schedule& schedule, const Layout& layout, const State& state, float end,
                        float scale) {
    if (state.pin)
        schedule.add(PLAIT_STAGE_pins, layout.guide_vertices(),
                     plait_pins_params{layout.row, end, 1, 1 / scale},
                     {&state.pin_at, &state.pin, &state.pin_to});
}

void append_pins_arrived(Schedule& schedule, const Layout& layout, const State& state,
                         float scale) {
    if (state.pin)
        add_target(schedule, layout, state, state.pin_at, scale);
}

void append_stopped_pins(Schedule& schedule, const Layout& layout, const State& state,
                         float scale) {
    if (state.pin)
        for (const Buffer* to : {&state.pin_at, &state.pin_from, &state.pin_to})
            add_target(schedule, layout, state, *to, scale);
}

Status clear_pins(Device& device, const Layout& layout, const State& state,
                  std::pmr::memory_resource* memory) {
    if (!state.pin)
        return {};
    const std::pmr::vector<PinTable::Row> none(layout.guide_vertices(), PinTable::Row{}, memory);
    for (const Buffer* pins : {&state.pin, &state.pin_at, &state.pin_from, &state.pin_to})
        PLAIT_TRY(device.write(*pins, none.data()));
    return {};
}

Status check_pin_stiffness(std::span<const float> rows, uint32_t row) {
    for (size_t i = 0; i < rows.size() / 4; ++i) {
        const float stiffness = rows[4 * i + 3];
        if (i % row == 0 && stiffness != 0)
            return Error{
                PLAIT_INVALID_ARGUMENT,
                format("pin[%zu].w is %g: vertex 0 of strand %zu, which its root holds, must "
                       "have 0",
                       i, double(stiffness), i / row)};
        if (!(std::abs(stiffness) <= stiffest))
            return Error{
                PLAIT_INVALID_ARGUMENT,
                format("pin[%zu].w, of vertex %zu of strand %zu, is %g, range is [%g, %g] N/m", i,
                       i % row, i / row, double(stiffness), double(-stiffest), double(stiffest))};
    }
    return {};
}

Status PinTable::fill(Device& device, const Layout& layout, const State& state) {
    if (!rest_.empty())
        return {};
    row_ = layout.row;
    std::pmr::vector<Row> rest(layout.guide_vertices(), Row{}, rest_.get_allocator());
    std::pmr::vector<uint32_t> counts(layout.strands(), 0u, counts_.get_allocator());
    PLAIT_TRY(device.read(state.rest, rest.data()));
    PLAIT_TRY(device.read(state.vertex_count, counts.data()));
    counts.resize(layout.guides);
    rest_ = std::move(rest);
    counts_ = std::move(counts);
    return {};
}

Status PinTable::check(const plait_pin& pin, size_t index) const {
    const auto outside = [&](const char* field, double value, const char* range) {
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("pins[%zu] (strand %u, vertex %u): %s is %g, range is %s", index,
                            pin.strand, pin.vertex, field, value, range)};
    };
    if (pin.strand >= counts_.size())
        return outside("strand", pin.strand,
                       format("[0, %zu], the guides", counts_.size() - 1).c_str());
    if (pin.vertex == 0)
        return outside(
            "vertex", 0,
            format("[1, %u]: vertex 0 is held by its root", counts_[pin.strand] - 1).c_str());
    if (pin.vertex >= counts_[pin.strand])
        return outside("vertex", pin.vertex, format("[1, %u]", counts_[pin.strand] - 1).c_str());
    int32_t frame; // a C caller may have put anything there
    std::memcpy(&frame, &pin.frame, sizeof frame);
    if (frame < PLAIT_PIN_FRAME_REST || frame > PLAIT_PIN_FRAME_WORLD)
        return outside("frame", frame, "[0, 2]");
    if (!(pin.stiffness > 0 && pin.stiffness <= stiffest))
        return outside("stiffness", double(pin.stiffness), "(0, 1e6] N/m");
    for (size_t i = 0; i < 3 && frame != PLAIT_PIN_FRAME_REST; ++i)
        if (!(std::abs(pin.target[i]) <= farthest))
            return outside(format("target[%zu]", i).c_str(), double(pin.target[i]),
                           "[-1e6, 1e6] m");
    return {};
}

Result<std::pmr::vector<PinTable::Row>> PinTable::rows(std::span<const plait_pin> pins) const {
    std::pmr::vector<Row> rows(rest_.size(), Row{}, rest_.get_allocator());
    for (size_t i = 0; i < pins.size(); ++i) {
        const plait_pin& pin = pins[i];
        PLAIT_TRY(check(pin, i));
        const size_t at = size_t{pin.strand} * row_ + pin.vertex;
        if (rows[at][3] != 0)
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("pins[%zu]: vertex %u of strand %u is pinned before in the list", i,
                                pin.vertex, pin.strand)};
        const float* target = pin.frame == PLAIT_PIN_FRAME_REST ? rest_[at].data() : pin.target;
        rows[at] = {target[0], target[1], target[2],
                    pin.frame == PLAIT_PIN_FRAME_WORLD ? pin.stiffness : -pin.stiffness};
    }
    return rows;
}

} // namespace plait
