#include "core/levels/stillness.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plait {

void Stillness::set_speed(float speed) {
    speed_ = speed;
    if (still_ && fastest_ >= speed)
        stir();
}

void Stillness::stir() {
    still_ = has_last_ = false;
    calm_ = 0;
    ++stirs_;
}

void Stillness::stand(double s) {
    calm_ += s;
    if (!looks())
        return;
    still_ = true;
    fastest_ = 0;
}

Status Stillness::ask(Device& device, const Buffer& position) {
    asked_ = looks();
    asked_stirs_ = stirs_;
    if (!asked_)
        return {};
    all_.resize(position.bytes() / sizeof(float));
    return device.read_later(position, all_.data());
}

void Stillness::take(double way, double s, float scale) {
    const bool undisturbed = last_stirs_ == stirs_ && asked_stirs_ == stirs_;
    last_stirs_ = asked_stirs_;
    const bool slow = s <= longest_gap && undisturbed && way < double(speed_) * s;
    calm_ = slow ? calm_ + s : 0;
    look(slow, s, scale);
}

void Stillness::look(bool slow, double s, float scale) {
    still_ = false;
    if (asked_ && slow && has_last_) {
        double greatest = 0;
        for (size_t i = 0; i + 3 < all_.size(); i += 4) {
            double square = 0;
            for (size_t axis = 0; axis < 3; ++axis)
                square += std::pow(double(all_[i + axis]) - double(last_[i + axis]), 2);
            greatest = std::max(greatest, square);
        }
        fastest_ = static_cast<float>(double(scale) * std::sqrt(greatest) / s);
        still_ = fastest_ < speed_;
        calm_ = still_ ? calm_ : 0;
    }
    has_last_ = asked_ && slow && calm_ > 0;
    if (has_last_)
        std::swap(all_, last_);
}

} // namespace plait
