// Sims as an application makes them, for the rows of whole steps.
#pragma once

#include <plait/plait.hpp>

#include <memory>
#include <vector>

namespace bench {

void check(plait_result result); // throws its sentence

template <auto destroy> struct Destroy {
    template <typename Object> void operator()(Object* object) const { destroy(object); }
};
using Context = std::unique_ptr<plait_context, Destroy<plait_context_destroy>>;
using Groom = std::unique_ptr<plait_groom, Destroy<plait_groom_destroy>>;
using Sim = std::unique_ptr<plait_sim, Destroy<plait_sim_destroy>>;

Context make_context(const plait_device_info& device);
Sim make_sim(plait_context* context, plait_groom* groom, const plait::SimDesc& desc);

Groom long_hair(uint32_t strands); // of model_vertices, on the mannequin

constexpr uint32_t frames_of_turn = 60;  // there and back
plait_pose turned_head(uint32_t number); // where that frame ends

// Hair on the mannequin, whose head turns; `bodies`: and its 14 capsules.
class Character {
  public:
    Character(plait_context* context, plait_groom* groom, const plait::SimDesc& desc, bool bodies);

    void aim(); // at where the next frame ends
    plait_sim* sim() const { return sim_.get(); }

  private:
    Sim sim_;
    std::vector<plait_collider_id> on_head_;
    uint32_t number_ = 0;
};

struct NamedModel {
    plait_model model;
    const char* name;
};
inline constexpr NamedModel models[] = {{PLAIT_MODEL_TRESSFX, "tressfx"},
                                        {PLAIT_MODEL_ARTICULATED, "articulated"}};

} // namespace bench
