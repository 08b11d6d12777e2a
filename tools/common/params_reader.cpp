#include "common/params_reader.hpp"
#include "common/json_reader.hpp"

#include "common/params_list.hpp"

#include <plait/plait_offline.h>

#include <cstring>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace common {

const std::array<const char*, 2> model_names{"tressfx", "articulated"};
const std::array<const char*, 3> grid_names{"off", "slots", "exact"};
const std::array<const char*, 3> sag_free_names{"off", "rest", "stiffen"};

namespace {

// A field of a struct of the library's, whose components are read and written as bytes: the table says
// what they are.
class Field {
  public:
    Field(const plait_param_info& info, void* at) : info_(info), at_(at) {}

    void read(JsonReader& in) {
        switch (info_.kind) {
        case PLAIT_PARAM_KIND_FLOAT:
            return read_floats(in);
        case PLAIT_PARAM_KIND_UINT:
            return exchange<uint32_t>([&](uint32_t& value) {
                in.integer(info_.name, value, static_cast<uint32_t>(info_.least),
                           static_cast<uint32_t>(info_.most));
            });
        case PLAIT_PARAM_KIND_CHOICE:
            return exchange<int32_t>([&](int32_t& value) {
                in.choice(info_.name, value, {info_.choices, size_t(info_.most) + 1});
            });
        default:
            throw std::logic_error(std::string(info_.name) + " is of no kind this reader knows");
        }
    }

  private:
    template <typename T, typename Read> void exchange(const Read& read) {
        T value;
        std::memcpy(&value, at_, sizeof value);
        read(value);
        std::memcpy(at_, &value, sizeof value);
    }
    void read_floats(JsonReader& in) {
        if (info_.count == 1)
            return exchange<float>([&](float& value) {
                if (in.number(info_.name, value, info_.least, info_.most) && info_.least_excluded &&
                    double(value) <= info_.least)
                    in.fail(info_.name, "is " + Json(value).dump() + ", must be greater than " +
                                            Json(info_.least).dump());
            });
        std::vector<float> values(info_.count);
        std::memcpy(values.data(), at_, sizeof(float) * values.size());
        in.numbers(info_.name, values, info_.least, info_.most);
        std::memcpy(at_, values.data(), sizeof(float) * values.size());
    }

    const plait_param_info& info_;
    void* at_;
};

} // namespace

void read_params(JsonReader in, plait::SimDesc& desc) {
    for (const plait_param_info& info : all_params()) {
        if (!plait::has_feature(desc, info) && in.value(info.name))
            in.fail(info.name, "is of " + std::string(info.feature) +
                                   ", which is off, or not one of the model's");
        Field(info, plait::field_of(desc, info)).read(in);
    }
    in.finish();
}

void read_tressfx(JsonReader in, plait_tressfx_desc& desc) {
    for (const plait_param_info& info : all_params())
        if (std::string_view(info.feature) == "tressfx")
            Field(info, reinterpret_cast<unsigned char*>(&desc) + info.offset).read(in);
    in.finish();
}

void read_grid(JsonReader& in, plait::SimDesc& desc) {
    uint32_t name = 0;
    if (!in.choice("grid", name, grid_names))
        return;
    desc.grid.on = name > 0;
    if (desc.grid.on)
        desc.grid.form = static_cast<plait_grid_form>(name - 1);
}

const char* grid_name(const plait::SimDesc& desc) {
    return grid_names[desc.grid.on ? size_t(desc.grid.form) + 1 : 0];
}

} // namespace common
