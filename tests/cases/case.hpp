// A case: what one stage is given, and how far a float32 device may be from the float64 reference.
//
// Cases know stages only through <plait/plait_backend.h>, so a new backend gets all of them by
// being registered. Every case is run as it is, and again with each field of its parameters and
// each component of its buffers changed a little: a comparison that does not notice is too loose.
#pragma once

#include <plait/plait_backend.h>

#include <cstddef>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace plait::cases {

// Contents of a buffer.
struct Array {
    plait_element element = PLAIT_ELEMENT_FLOAT;
    std::vector<float> floats;   // FLOAT and FLOAT4
    std::vector<uint32_t> words; // UINT
    bool null = false;           // no buffer is passed
    uint32_t components = 0;     // > 0: [strand][V][components], to be laid out in lanes

    size_t count() const;
};

Array floats(std::vector<float> values);
Array float4s(std::vector<float> values);
Array uints(std::vector<uint32_t> values);
Array lane_floats(std::vector<float> values, uint32_t components);
Array null_array();
// For buffers a stage writes: contents that no stage produces, so that a gap shows.
Array unwritten_floats(size_t count);
Array unwritten_float4s(size_t count);

// One dispatch.
struct Setup {
    std::string name;
    uint32_t items = 0;
    uint32_t width = 1;
    std::vector<std::byte> params;
    std::vector<Array> buffers; // in the order of the stage's non-LOCAL arguments

    template <typename P> Setup& with(const P& value) {
        params.resize(sizeof value);
        std::memcpy(params.data(), &value, sizeof value);
        return *this;
    }
    template <typename P> P params_as() const {
        P value;
        std::memcpy(&value, params.data(), sizeof value);
        return value;
    }
};

using Outputs = std::vector<Array>; // the buffers after the dispatch
// "" if `got` is as good as `expected`, else what is wrong with it.
using Compare = std::string (*)(const Setup&, const Outputs& expected, const Outputs& got);

struct Case {
    plait_stage stage;
    std::vector<Setup> setups;
    // By argument: allowed absolute difference. Arguments without one, and all uints, must be
    // equal.
    std::map<std::string, double> tolerance;
    // Fields of the parameters that this stage does not read; what it does not read of a buffer of
    // floats, as argument or argument.component (see disturb.cpp). position.w, pinned or not, is
    // read only by the stages that move vertices.
    std::vector<std::string> unread = {};
    // By argument: instead of the element-wise comparison.
    std::map<std::string, Compare> compare = {};
    // Floats of buffers, as in `unread`, of which only counts what part of one another they are, or
    // whether they are 0.
    std::vector<std::string> ratios = {}, flags = {"position.w"};
    // What is read, as in `unread`, but only decides which of two is taken: a hundredth of it is not
    // noticed in every set of inputs, and is not looked for.
    std::vector<std::string> decides = {};
};

// Defined in <stage>.cpp; the table is generated from stages.def, so a stage without a case does
// not link.
const std::vector<Case>& all_cases();

// A field of a parameter struct, as the sensitivity check sees it.
enum class FieldKind {
    real,   // float: 1 % off
    vector, // float[4k], every fourth unused: 1 % off
    count,  // uint: one more
    choice, // uint: the other of two
    layout  // uint that sizes the buffers: left alone
};
struct Field {
    const char* name;
    size_t offset;
    size_t words;
    FieldKind kind;
};
const std::vector<Field>& fields_of(const char* params_type);

// Element-wise comparison of all buffers by the case's tolerances; "" or the first difference.
std::string compare(const Case& stage_case, const Setup& setup, const Outputs& expected,
                    const Outputs& got);

// Runs the setup; on failure `error` says why and the result is empty. Every buffer is longer than
// needed by a few guard elements, which must come back as they were.
Outputs run(const plait_device_api& api, plait_device* device, plait_stage stage,
            const Setup& setup, std::string& error);

} // namespace plait::cases
