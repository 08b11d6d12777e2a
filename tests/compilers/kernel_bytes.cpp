// kernel_bytes FOLDER: what kernels read and write, counted by running them on a real scene.
//
// FOLDER holds kernels as bytes.sh makes them, <program>.so and list.txt (program, stage and work-items
// of a group): compiled for a GPU up to LLVM's optimised code, with a call of plait_touch before every
// load and store, and from there for this machine. A backend that wraps `reference` gives every dispatch
// of the frames that count to them, too, on copies of its buffers. Prints a line of CSV for each program
// and scene: bytes per strand and step.
#include <plait/plait.hpp>
#include <plait/plait_backend.h>

#include <generator/generator.hpp>

#include <dlfcn.h>

#include <array>
#include <atomic>
#include <barrier>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

enum Kind {
    private_read,
    private_written,
    global_read,
    global_written,
    local_read,
    local_written,
    global_atomic,
    local_atomic,
    kinds
};
constexpr const char* kind_names = "private_read,private_written,global_read,global_written,local_"
                                   "read,local_written,global_atomic,local_atomic";

std::array<std::atomic<uint64_t>, kinds> touched; // bytes; of atomic additions their number

// A work-item's place, and what its group waits at.
struct Item {
    uint32_t group, size, local;
    std::barrier<>* barrier;
};
thread_local Item item;

} // namespace

// What the kernels call.
#pragma GCC visibility push(default)
extern "C" {
void plait_touch(uint32_t kind, uint64_t amount) {
    touched[kind].fetch_add(amount, std::memory_order_relaxed);
}
uint32_t plait_local_id() {
    return item.local;
}
uint32_t plait_local_size() {
    return item.size;
}
uint32_t plait_group_id() {
    return item.group;
}
void plait_barrier() {
    item.barrier->arrive_and_wait();
}
}
#pragma GCC visibility pop

namespace {

using Call = void (*)(void* kernel, uint32_t items, const void* params, void* const* buffers);

template <typename Params, size_t... I>
void call_with(void* kernel, uint32_t items, const void* params, void* const* buffers,
               std::index_sequence<I...>) {
    using Kernel =
        void (*)(uint32_t, Params, decltype(static_cast<void>(I), static_cast<void*>(nullptr))...);
    reinterpret_cast<Kernel>(kernel)(items, *static_cast<const Params*>(params), buffers[I]...);
}

template <typename Params, size_t arguments>
void call(void* kernel, uint32_t items, const void* params, void* const* buffers) {
    call_with<Params>(kernel, items, params, buffers, std::make_index_sequence<arguments>());
}

// LOCAL arguments, too, which none of the stages that are counted has.
constexpr Call calls[] = {
#define PLAIT_STAGE(name, space, params, summary) call < params, 0
#define PLAIT_ARG(stage, name, element, access) +1
#define PLAIT_STAGE_END(name) >,
#include <plait/stages.def>
};

struct Program {
    std::string name;
    plait_stage stage;
    uint32_t group;
    void* kernel;
};

std::vector<Program> programs;
std::map<plait_buffer*, plait_buffer_desc> descs;
bool counting = false;
std::string scene;
std::map<std::pair<std::string, std::string>, std::array<double, kinds + 1>> results; // and strands

void run_group(const Program& program, const plait_dispatch& dispatch, void* const* buffers,
               uint32_t group) {
    std::barrier barrier(program.group);
    const auto run = [&](uint32_t local) {
        item = {group, program.group, local, &barrier};
        calls[program.stage](program.kernel, dispatch.item_count, dispatch.params, buffers);
    };
    if (program.group == 1)
        return run(0);
    std::vector<std::jthread> items;
    for (uint32_t local = 0; local < program.group; ++local)
        items.emplace_back(run, local);
}

// The buffers of a dispatch as they are, and how many strands its items are of.
using Words = std::vector<std::vector<uint32_t>>;

void count(const Program& program, const plait_dispatch& dispatch, Words words, double strands) {
    std::vector<void*> buffers;
    for (auto& buffer : words)
        buffers.push_back(buffer.empty() ? nullptr : buffer.data());
    for (auto& kind : touched)
        kind = 0;
    const uint32_t groups = (dispatch.item_count + program.group - 1) / program.group;
    for (uint32_t group = 0; group < groups; ++group)
        run_group(program, dispatch, buffers.data(), group);
    auto& sum = results[{scene, program.name}];
    for (size_t kind = 0; kind < kinds; ++kind)
        sum[kind] += static_cast<double>(touched[kind]);
    sum[kinds] += strands;
}

constexpr uint32_t vertices = 16;

const plait_backend_api* wrapped;

plait_result submit(plait_device* device, const plait_dispatch* list, size_t size) {
    for (size_t i = 0; i < size; ++i) {
        const plait_dispatch& dispatch = list[i];
        const bool by_vertex = plait_stage_describe(dispatch.stage)->space == PLAIT_SPACE_VERTEX;
        for (const Program& program : programs) {
            if (!counting || program.stage != dispatch.stage)
                continue;
            Words words;
            for (plait_buffer* buffer :
                 std::vector(dispatch.buffers, dispatch.buffers + dispatch.buffer_count)) {
                words.emplace_back();
                if (!buffer)
                    continue;
                const plait_buffer_desc& desc = descs.at(buffer);
                words.back().resize(desc.count * (desc.element == PLAIT_ELEMENT_FLOAT4 ? 4 : 1));
                if (wrapped->device->buffer_read(device, buffer, 0, desc.count,
                                                 words.back().data()) != PLAIT_OK)
                    return PLAIT_BACKEND;
            }
            count(program, dispatch, std::move(words),
                  dispatch.item_count / (by_vertex ? double(vertices) : 1));
        }
        if (const plait_result result = wrapped->device->submit(device, &dispatch, 1))
            return result;
    }
    return PLAIT_OK;
}

plait_result buffer_create(plait_device* device, const plait_buffer_desc* desc,
                           plait_buffer** out) {
    const plait_result result = wrapped->device->buffer_create(device, desc, out);
    if (result == PLAIT_OK)
        descs[*out] = *desc;
    return result;
}

// The reference's tables, with `submit` that counts; they live as long as the process.
void register_backend() {
    static plait_device_api device;
    static plait_backend_api backend;
    for (size_t i = 0; i < plait_backend_count(); ++i)
        if (std::strcmp(plait_backend_get(i)->name, "reference") == 0)
            wrapped = plait_backend_get(i);
    if (!wrapped)
        throw std::runtime_error("there is no backend `reference`");
    device = *wrapped->device;
    device.submit = submit;
    device.buffer_create = buffer_create;
    backend = *wrapped;
    backend.name = "counting";
    backend.device = &device;
    if (plait_backend_register(&backend) != PLAIT_OK)
        throw std::runtime_error(plait_last_error());
}

void load_programs(const std::string& folder) {
    std::ifstream list(folder + "/list.txt");
    std::string name, stage;
    uint32_t group = 0;
    while (list >> name >> stage >> group) {
        void* module = dlopen((folder + "/" + name + ".so").c_str(), RTLD_NOW);
        void* kernel = module ? dlsym(module, ("plait_" + stage).c_str()) : nullptr;
        if (!kernel)
            throw std::runtime_error(dlerror());
        for (int i = 0; i < PLAIT_STAGE_COUNT; ++i)
            if (stage == plait_stage_describe(static_cast<plait_stage>(i))->name)
                programs.push_back({name, static_cast<plait_stage>(i), group, kernel});
    }
    if (programs.empty())
        throw std::runtime_error(folder + "/list.txt: no programs");
}

// Long hair on the mannequin, whose head turns by 29 degrees to and fro at 1 Hz, in defaults otherwise.
constexpr uint32_t strands = 256, settling = 30, frames = 60, every = 5;

plait::Groom long_hair() {
    plait_generator::Style style = plait_generator::make_style(plait_generator::Hairstyle::Long);
    style.strands = strands;
    style.vertices = vertices;
    const plait_generator::Strands hair = plait_generator::make_groom(style);
    plait_groom_desc desc = plait_groom_desc_defaults();
    desc.positions = {hair.positions.data(), hair.positions.size() / 3, 0};
    desc.vertices_per_strand = vertices;
    return plait::Groom(desc);
}

std::vector<plait_collider_id> add_capsules(plait::Sim& sim) {
    std::vector<plait_collider_id> on_head;
    for (const plait_generator::Capsule& capsule : plait_generator::head_colliders()) {
        plait_collider_desc desc = plait_collider_desc_defaults();
        desc.friction = 0;
        for (int i = 0; i < 3; ++i) {
            desc.capsule.a[i] = capsule.a[i];
            desc.capsule.b[i] = capsule.b[i];
        }
        desc.capsule.radius_a = capsule.radius_a;
        desc.capsule.radius_b = capsule.radius_b;
        plait_collider_id id{};
        plait::check(plait_collider_create(sim.get(), &desc, &id));
        if (capsule.moves_with_head)
            on_head.push_back(id);
    }
    return on_head;
}

void play(const plait::Context& context, const plait::Groom& groom, const plait::SimDesc& desc,
          bool capsules) {
    plait::Sim sim(context, groom, desc);
    const auto on_head = capsules ? add_capsules(sim) : std::vector<plait_collider_id>{};
    for (uint32_t frame = 0; frame < settling + frames; ++frame) {
        const float turn = static_cast<float>(frame) / frames;
        const float half = 0.25f * std::sin(6.2831853f * turn); // rad, about y
        plait_roots roots = plait_roots_defaults();
        roots.head = {{0, std::sin(half), 0, std::cos(half)}, {0, 0, 0}};
        sim.set_roots(roots);
        for (const plait_collider_id id : on_head)
            plait::check(plait_collider_set_pose(sim.get(), id, &roots.head));
        counting = frame >= settling && frame % every == 0;
        sim.step(1.0 / 60 + 1e-9);
        sim.wait();
        counting = false;
    }
}

void play_all() {
    plait_context_desc context_desc = plait_context_desc_defaults();
    context_desc.backend = "counting";
    const plait::Context context(context_desc);
    const plait::Groom groom = long_hair();
    plait::SimDesc desc;
    desc.grid.on = false;
    for (const bool capsules : {false, true}) {
        scene = capsules ? "capsules" : "alone";
        play(context, groom, desc, capsules);
    }
    // Then the grid's own stages alone, of the default model.
    std::erase_if(programs, [](const Program& program) {
        return plait_stage_describe(program.stage)->name == std::string("articulated");
    });
    desc = plait::SimDesc();
    desc.grid.on = true;
    for (const plait_tent_form tent : {PLAIT_TENT_FORM_VOXEL, PLAIT_TENT_FORM_TRILINEAR}) {
        desc.grid.tent = tent;
        scene = tent == PLAIT_TENT_FORM_VOXEL ? "voxel" : "trilinear";
        play(context, groom, desc, false);
    }
    desc.volume.on = true;
    scene = "volume";
    play(context, groom, desc, false);
}

} // namespace

int main(int count, char** arguments) {
    try {
        if (count != 2)
            throw std::runtime_error("usage: kernel_bytes FOLDER");
        register_backend();
        load_programs(arguments[1]);
        play_all();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "kernel_bytes: %s\n", error.what());
        return 1;
    }
    std::printf("scene,program,%s\n", kind_names);
    for (const auto& [name, sum] : results) {
        std::printf("%s,%s", name.first.c_str(), name.second.c_str());
        for (size_t kind = 0; kind < kinds; ++kind)
            std::printf(",%.1f", sum[kind] / sum[kinds]);
        std::printf("\n");
    }
    return 0;
}
