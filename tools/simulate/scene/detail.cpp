#include "detail.hpp"
#include "common/json_reader.hpp"

namespace simulate {

namespace {

Detail read_fields(JsonReader& in, uint64_t seed) {
    plait_detail_desc detail = plait_detail_desc_defaults();
    in.numbers("clump", detail.clump, 0, 1);
    in.integer("clumps", detail.clumps, 0, 1000000);
    in.numbers("curl", detail.curl, 0, 1);
    in.number("curl_pitch", detail.curl_pitch, 1e-4, 100);
    in.number("curl_scatter", detail.curl_scatter, 0, 1);
    in.numbers("frizz", detail.frizz, 0, 1);
    in.number("frizz_length", detail.frizz_length, 1e-4, 100);
    in.finish();
    detail.seed = static_cast<uint32_t>(seed);
    return detail;
}

} // namespace

Detail read_detail(const JsonReader& top, const Json& value, uint64_t seed) {
    JsonReader in = top.object(value, "detail");
    return read_fields(in, seed);
}

std::vector<DetailChoice> read_details(JsonReader& top, uint64_t seed) {
    std::vector<DetailChoice> list;
    top.each("compare_detail", [&](JsonReader in) {
        DetailChoice choice;
        if (!in.text("name", choice.name) || choice.name.empty())
            in.fail("name", "is missing");
        choice.detail = read_fields(in, seed);
        list.push_back(choice);
    });
    return list;
}

} // namespace simulate
