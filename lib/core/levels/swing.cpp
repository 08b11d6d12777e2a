#include "core/levels/swing.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

constexpr uint32_t most_strands = 32;
constexpr double mean_over = 2, square_over = 1; // s

// Of the newest sample, `s` after the one before, in a mean that forgets over `over` s and has seen `known`.
double weight_of(double s, double over, double known) {
    return std::max(1 - std::exp(-s / over), s / (known + s));
}

} // namespace

Status Swing::open(Device& device, std::span<const uint32_t> counts, uint32_t row) {
    const auto some = counts.first(std::min<size_t>(counts.size(), most_strands));
    counts_.assign(some.begin(), some.end());
    row_ = row;
    read_.resize(size_t{4} * row * some.size());
    last_.assign(read_.size(), 0.0f);
    mean_.assign(read_.size(), 0.0);
    return device.create(probes_, PLAIT_ELEMENT_FLOAT4, read_.size() / 4, "held");
}

Result<uint64_t> Swing::ask(Device& device, const Buffer& position) {
    PLAIT_TRY(device.read_later(probes_, read_.data()));
    PLAIT_TRY(stillness.ask(device, position));
    auto fence = device.fence();
    if (fence) {
        fence_ = *fence;
        asked_ = waited_;
        waited_ = 0;
    }
    return fence;
}

Status Swing::take(Device& device, float scale) {
    if (fence_ == 0)
        return {};
    const auto reached = device.fence_reached(fence_, false);
    if (!reached)
        return reached.error();
    if (*reached) {
        fence_ = 0;
        add(scale);
    }
    return {};
}

// Vertices past a tip are copies of it, and do not count.
void Swing::add(float scale) {
    const double to_mean = weight_of(asked_, mean_over, known_);
    double sum = 0, moved = 0, count = 0;
    for (size_t strand = 0; strand < counts_.size(); ++strand)
        for (size_t i = 0; i < counts_[strand]; ++i) {
            ++count;
            for (size_t axis = 0; axis < 3; ++axis) {
                const size_t at = 4 * (strand * row_ + i) + axis;
                const double x = double(scale) * double(read_[at]);
                mean_[at] += to_mean * (x - mean_[at]);
                sum += (x - mean_[at]) * (x - mean_[at]);
                moved += (x - double(last_[at])) * (x - double(last_[at]));
                last_[at] = static_cast<float>(x);
            }
        }
    square_ += weight_of(asked_, square_over, known_) * (sum / count - square_);
    stillness.take(known_ > 0 ? std::sqrt(moved / count) : INFINITY, asked_, scale);
    known_ += asked_;
    rms_ = static_cast<float>(std::sqrt(square_));
}

} // namespace plait
