#include "core/follows/follow_map.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace plait {
namespace {

constexpr size_t most = FollowMap::per_strand;
constexpr double rounding = 1e-3; // of a sum of weights that is meant to be 1

struct Share {
    uint32_t guide;
    float weight;
};

Error outside(const char* what, size_t strand, size_t k, double value, const std::string& range) {
    return {PLAIT_INVALID_ARGUMENT,
            format("%s[%zu][%zu] is %g, range is %s", what, strand, k, value, range.c_str())};
}

Status check(const Share* shares, size_t strand, uint32_t guide_count) {
    double sum = 0;
    for (size_t k = 0; k < most; ++k) {
        const auto [guide, weight] = shares[k];
        if (!(weight >= 0 && weight <= 1 + float(rounding)))
            return outside("weights", strand, k, double(weight), "[0, 1]");
        if (weight > 0 && guide >= guide_count)
            return outside("guides", strand, k, guide,
                           format("[0, %u], there are %u guides", guide_count - 1, guide_count));
        sum += double(weight);
    }
    if (!(std::abs(sum - 1) <= rounding))
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("weights[%zu] add up to %g, range is 1 +- %g", strand, sum, rounding)};
    return {};
}

void append(FollowMap& map, const Share* shares) {
    double sum = 0;
    for (size_t k = 0; k < most; ++k)
        sum += double(shares[k].weight);
    for (size_t k = 0; k < most; ++k) {
        const bool used = shares[k].weight > 0;
        map.guides.push_back(used ? shares[k].guide : shares[0].guide);
        map.weights.push_back(static_cast<float>(double(shares[k].weight) / sum));
    }
}

} // namespace

Status set_guides(FollowMap& map, std::span<const uint32_t> guides,
                  std::span<const float> weights) {
    for (size_t strand = 0; strand < map.count(); ++strand) {
        std::array<Share, most> shares{};
        for (size_t k = 0; k < most; ++k)
            shares[k] = {guides[most * strand + k], weights[most * strand + k]};
        PLAIT_TRY(check(shares.data(), strand, map.guide_count));
        std::ranges::sort(shares, [](const Share& a, const Share& b) {
            return a.weight > b.weight || (a.weight == b.weight && a.guide < b.guide);
        });
        append(map, shares.data());
    }
    return {};
}

} // namespace plait
