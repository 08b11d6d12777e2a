// What a sim says about itself without asking the device, and what it warns of.
#include "core/base/units.hpp"
#include "core/params/param_table.hpp"
#include "core/params/param_warnings.hpp"
#include "core/params/params.hpp"
#include "core/sim/sim.hpp"

#include "base/format.hpp"

#include <cmath>
#include <cstring>
#include <utility>

namespace plait {
namespace {

using Count = unsigned long long;

// A strand that is held by joints so much stiffer than its material is hardly of that material, or
// not of that size: what a joint holds grows with the cube of the unit.
constexpr double much_stiffening = 1000;

void append(std::string& text, const std::string& sentence) {
    if (!text.empty() && !sentence.empty())
        text += "; ";
    text += sentence;
}

std::string residual_warning(const SagReport& sag, uint64_t guides, plait_sag_free mode) {
    if (sag.unreached == 0)
        return {};
    return format(
        "sag-free start: %llu of %llu strands are not in balance (residual above %g), the "
        "worst, strand %llu, lacks %.2g of its weight x length%s",
        Count(sag.unreached), Count(guides), SagReport::reached, Count(sag.residual_strand),
        sag.residual,
        mode == PLAIT_SAG_FREE_REST ? ": too weak, PLAIT_SAG_FREE_STIFFEN holds such" : "");
}

// `told`: that the lengths are wrong has been said.
std::string stiffening_warning(const SagReport& sag, bool told) {
    if (sag.stiffening <= much_stiffening)
        return {};
    return format("sag-free start: %llu of %llu joints were stiffened, the worst, of strand %llu, "
                  "%.3g times: %s",
                  Count(sag.stiffened), Count(sag.joints), Count(sag.stiffening_strand),
                  sag.stiffening,
                  told ? "as such lengths need"
                       : "if the groom is in centimetres, import it with scale 0.01; if not, "
                         "bend_stiffness is far from what holds this hairstyle");
}

// In such a step hair falls farther than the pressure's sweeps bring back.
std::string volume_warning(const Params& p, float step, const GridCube& cube) {
    if (!p.volume.on)
        return {};
    const float voxel =
        (p.grid.edge > 0 ? p.grid.edge : cube.edge) / static_cast<float>(p.grid.edge_count);
    const float g = std::hypot(p.gravity[0], p.gravity[1], p.gravity[2]);
    const float fall = g * step * step;
    if (fall <= voxel / 4)
        return {};
    return format(
        "volume: hair falls by %.2g m in a step of %.2g s, more than a quarter of a voxel "
        "of %.2g m: shorter steps or larger voxels hold it",
        double(fall), double(step), double(voxel));
}

// A kernel of the caller's that is not run.
constexpr const char* accelerate_off =
    "the context has a kernel of yours for the stage accelerate, and this sim leaves it out: "
    "plait_sim_set_acceleration turns it on";
constexpr const char* accelerate_none =
    "the context has no kernel of yours for the stage accelerate";

} // namespace

const char* Sim::no_accelerate() const {
    if (!context_.replaced[PLAIT_STAGE_accelerate])
        return accelerate_none;
    return state_.acceleration ? "" : accelerate_off;
}

std::string Sim::warning() const {
    const SagReport sag = model_->sag();
    std::string text = size_warning_;
    const bool told = !text.empty();
    append(text, groom_warning_);
    append(text, residual_warning(sag, layout_.guides, desc_.sag_free));
    append(text, stiffening_warning(sag, told));
    append(text, volume_warning(params_, desc_.step, cube_));
    return text;
}

void Sim::log_warning(const std::string& said) const {
    if (!context_.log.callback)
        return;
    if (const std::string text = warning(); !text.empty() && text != said)
        context_.log(PLAIT_LOG_LEVEL_WARNING, "sim: " + text);
}

void Sim::log_ignored() {
    const NamedParams now{params_, materials_->table.front()};
    const NamedParams said = std::exchange(said_, now);
    if (!context_.log.callback)
        return;
    const bool begins = clock_.steps == 0;
    if (begins && no_accelerate() == accelerate_off)
        context_.log(PLAIT_LOG_LEVEL_WARNING, format("sim: %s", accelerate_off));
    const Readers readers{desc_.model, desc_.follows_per_guide > 0, no_accelerate()};
    for (const plait_param_info& param : param_table())
        if (const std::string text = ignored_warning(param, said, now, readers); !text.empty())
            context_.log(PLAIT_LOG_LEVEL_WARNING, "sim: " + text);
}

plait_sim_info Sim::describe() const {
    plait_sim_info info{};
    info.model = desc_.model;
    info.guides = layout_.guides;
    info.strands = layout_.strands();
    info.follows_per_guide = desc_.follows_per_guide;
    info.vertices_per_strand = layout_.row;
    info.step = desc_.step;
    info.substeps = desc_.substeps;
    info.steps = clock_.steps;
    info.steps_dropped = clock_.dropped;
    info.time = clock_.time();
    info.device_bytes = device_bytes();
    info.colliders = colliders_.count();
    info.sag_free = desc_.sag_free;
    const SagReport sag = model_->sag();
    info.sag_joints = sag.joints;
    info.joints_stiffened = sag.stiffened;
    info.sag_unreached = sag.unreached;
    info.sag_unstable = sag.unstable;
    info.worst_residual_strand = sag.residual_strand;
    info.worst_stiffening_strand = sag.stiffening_strand;
    info.sag_residual = static_cast<float>(sag.residual);
    info.worst_stiffening = static_cast<float>(sag.stiffening);
    info.scale = scale_;
    const std::string text = warning();
    text.copy(info.warning, sizeof info.warning - 1);
    return info;
}

} // namespace plait
