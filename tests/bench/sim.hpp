// Sims as an application makes them, for the rows of whole steps.
#pragma once

#include "results.hpp"

#include <plait/plait.hpp>

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace bench {

void check(plait_result result); // throws its sentence

template <auto destroy> struct Destroy {
    template <typename Object> void operator()(Object* object) const { destroy(object); }
};
using Context = std::unique_ptr<plait_context, Destroy<plait_context_destroy>>;
using Groom = std::unique_ptr<plait_groom, Destroy<plait_groom_destroy>>;
using Sim = std::unique_ptr<plait_sim, Destroy<plait_sim_destroy>>;

struct ContextOptions {
    bool profile = false;
    std::span<const plait_stage_source> sources = {};
};
Context make_context(const plait_device_info& device, const ContextOptions& options = {});
Sim make_sim(plait_context* context, plait_groom* groom, const plait::SimDesc& desc);

Groom groom_of(const std::vector<float>& positions, uint32_t vertices); // xyz [strands][vertices]

// Of model_vertices.
Groom long_hair(uint32_t strands); // on the mannequin
Groom ball_hair(uint32_t strands); // in a layer on a ball

constexpr uint32_t frames_of_turn = 60;  // there and back
plait_pose turned_head(uint32_t number); // where that frame ends

// What hair meets: nothing, the mannequin's 14 capsules (of a ball its one), or its head as a mesh.
enum class Shape { none, capsules, field, nearest };
struct Bodies {
    Shape shape = Shape::none;
    bool ball = false;  // of hair that lies on a ball, in place of the mannequin
    bool far = false;   // 3 m away
    bool bends = false; // a mesh whose vertices the caller poses each frame
};

// Hair on the mannequin, whose head turns.
class Character {
  public:
    Character(plait_context* context, plait_groom* groom, const plait::SimDesc& desc,
              Bodies bodies = {});

    void aim(); // at where the next frame ends
    plait_sim* sim() const { return sim_.get(); }

  private:
    void add_capsules();
    void add_mesh();

    Sim sim_;
    Bodies bodies_;
    std::vector<plait_collider_id> on_head_;
    std::vector<float> rest_; // xyz of the mesh's vertices, m
    uint32_t number_ = 0;
};

// What a sim's launches took since the last call, by stage. Its context has a profile.
std::map<std::string, StageSums> take_stage_sums(plait_sim* sim);

struct NamedModel {
    plait_model model;
    const char* name;
};
inline constexpr NamedModel models[] = {{PLAIT_MODEL_TRESSFX, "tressfx"},
                                        {PLAIT_MODEL_ARTICULATED, "articulated"}};

} // namespace bench
