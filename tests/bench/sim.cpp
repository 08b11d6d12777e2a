#include "sim.hpp"

#include <stdexcept>

namespace bench {

void check(plait_result result) {
    if (result != PLAIT_OK)
        throw std::runtime_error(plait_last_error());
}

Context make_context(const plait_device_info& device) {
    plait_context_desc desc = plait_context_desc_defaults();
    desc.backend = "opencl";
    desc.device = device.name;
    plait_context* context = nullptr;
    check(plait_context_create(&desc, &context));
    return Context(context);
}

Sim make_sim(plait_context* context, plait_groom* groom, const plait_sim_desc& desc) {
    plait_sim* sim = nullptr;
    check(plait_sim_create(context, groom, &desc, &sim));
    return Sim(sim);
}

} // namespace bench
