// A device chosen and opened.
#pragma once

#include "backend/device.hpp"
#include "base/log.hpp"
#include "base/memory.hpp"
#include "core/levels/director.hpp"

#include <bitset>
#include <optional>
#include <vector>

namespace plait {

class Sim;

// Every device of every backend, best first: backends by score, then as each lists them.
struct Candidate {
    const plait_backend_api* backend;
    int score;
    uint32_t index; // of the backend's own enumeration
    plait_device_info info;
};
std::vector<Candidate> list_candidates(const Log& log);

struct ContextRules {
    const char* backend = nullptr; // name, or any
    const char* device = nullptr;  // part of the device's or platform's name, or any
    Log log;
    plait_allocator allocator{};
    bool profile = false;
    const plait_stage_source* stage_sources = nullptr;
    size_t stage_source_count = 0;
    uint32_t lanes = 0; // strands per work-item; 0: the device's own
    const char* program_folder = nullptr;
    const void* native = nullptr; // the backend's own handles to adopt
};

// The first candidate that matches and opens. Falls back to the next only where the caller named
// nothing and the failure is the machine's, never on one that the caller should see.
Result<Device> open_device(const ContextRules& rules);

std::bitset<PLAIT_STAGE_COUNT> replaced_stages(const ContextRules& rules);

struct Context {
    Context(const ContextRules& rules, Device opened, const plait_device_info& described)
        : memory(rules.allocator), log(rules.log), profile(rules.profile),
          device(std::move(opened)), info(described), replaced(replaced_stages(rules)),
          director(&memory) {}

    Memory memory;
    Log log;
    bool profile;
    Device device;
    plait_device_info info;
    std::bitset<PLAIT_STAGE_COUNT> replaced; // stages whose kernel is the caller's
    Director director;                       // of all sims with levels
    // Whose work the device's clock measures at present (profile only).
    Sim* measured = nullptr;
};

} // namespace plait
