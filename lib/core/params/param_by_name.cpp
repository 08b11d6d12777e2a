#include "core/params/param_by_name.hpp"

#include "base/format.hpp"
#include "core/params/param_table.hpp"
#include "core/params/params.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>

namespace plait {
namespace {

Status put_float(const plait_param_info& param, uint32_t component, double value,
                 unsigned char* at) {
    // What float32 cannot hold is outside of every range.
    if (!(std::abs(value) <= double(std::numeric_limits<float>::max())))
        return check_component(param, component, value);
    const auto number = static_cast<float>(value);
    std::memcpy(at, &number, sizeof number);
    return check_component(param, component, double(number));
}

Status put_whole(const plait_param_info& param, uint32_t component, double value,
                 unsigned char* at) {
    PLAIT_TRY(check_component(param, component, value));
    if (value != std::floor(value))
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("%s is %g, range is the whole numbers in [%g, %g]", param.name, value,
                            param.least, param.most)};
    const auto number = static_cast<uint32_t>(value);
    std::memcpy(at, &number, sizeof number);
    return {};
}

} // namespace

Result<const plait_param_info*> find_param(const char* name) {
    const std::string_view wanted(name);
    for (const plait_param_info& param : param_table())
        if (wanted == param.name)
            return &param;
    return Error{
        PLAIT_NOT_FOUND,
        format("no parameter is called \"%.64s\"; plait_params_list names them all", name)};
}

Result<NamedParams> with_param(const NamedParams& all, const plait_param_info& param,
                               std::span<const double> values) {
    if (!feature_is_on(param, all.params))
        return Error{PLAIT_INVALID_STATE,
                     format("%s belongs to %s, which is off: plait_sim_set_%s turns it on",
                            param.name, param.feature, param.feature)};
    if (values.size() != param.count)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("count is %zu, %s needs %u", values.size(), param.name, param.count)};
    NamedParams changed = all;
    unsigned char* const at = param_at(param, changed);
    const auto put = param.kind == PLAIT_PARAM_KIND_FLOAT ? put_float : put_whole;
    for (uint32_t i = 0; i < param.count; ++i)
        PLAIT_TRY(put(param, i, values[i], at + size_t{4} * i));
    PLAIT_TRY(check_params(changed.params));
    return changed;
}

} // namespace plait
