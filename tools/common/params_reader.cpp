#include "common/params_reader.hpp"

#include "common/params_list.hpp"

#include <plait/plait_offline.h>

#include <cstring>
#include <stdexcept>
#include <vector>

namespace common {

const std::array<const char*, 2> model_names{"tressfx", "articulated"};
const std::array<const char*, 3> interhair_names{"off", "slots", "exact"};
const std::array<const char*, 3> sag_free_names{"off", "rest", "stiffen"};

namespace {

// A field of `params`, whose components are read and written as bytes: the table says what they
// are.
class Field {
  public:
    Field(const plait_param_info& info, plait_sim_params& params)
        : info_(info), at_(reinterpret_cast<unsigned char*>(&params) + info.offset) {}

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
    unsigned char* at_;
};

} // namespace

void read_params(JsonReader in, plait_sim_params& params) {
    for (const plait_param_info& info : all_params())
        Field(info, params).read(in);
    in.finish();
}

void take_tressfx(const plait_sim_params& from, plait_sim_params& to) {
    for (const plait_param_info& info : all_params())
        if (info.models == 1u << PLAIT_MODEL_TRESSFX)
            std::memcpy(reinterpret_cast<unsigned char*>(&to) + info.offset,
                        reinterpret_cast<const unsigned char*>(&from) + info.offset,
                        size_t{4} * info.count);
}

} // namespace common
