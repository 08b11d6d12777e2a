// Objects of the API that go out of scope.
#pragma once

#include <plait/plait.h>

#include <memory>

namespace plait::opencl {

template <auto destroy> struct Destroy {
    template <typename Object> void operator()(Object* object) const { destroy(object); }
};
using OwnContext = std::unique_ptr<plait_context, Destroy<plait_context_destroy>>;
using OwnGroom = std::unique_ptr<plait_groom, Destroy<plait_groom_destroy>>;
using OwnMesh = std::unique_ptr<plait_mesh, Destroy<plait_mesh_destroy>>;
using OwnSim = std::unique_ptr<plait_sim, Destroy<plait_sim_destroy>>;

} // namespace plait::opencl
