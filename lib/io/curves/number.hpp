// A number as text that is read back to the bit, with a point in every country.
#pragma once

#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <string>

namespace plait {

// As short as it can be.
inline std::string number_text(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

// At most 24 characters from `at` on; gives their end. A recording is made of tens of millions of them, of
// which the shortest texts would be two thirds of its time. What is as large as coordinates are has the decimals
// that tell it from its neighbours, its last one too many at times.
inline char* put_number(char* at, float value) {
    struct Digits {
        uint32_t count, scale; // decimals of a step between neighbours, ten to that
    };
    constexpr int least = -6, most = 3; // 1/64 <= |value| < 16
    constexpr auto digits = [] {
        std::array<Digits, most - least + 1> of{};
        for (int exponent = least; exponent <= most; ++exponent) {
            const double step = 1.0 / double(uint64_t{1} << (23 - exponent));
            Digits& d = of[static_cast<size_t>(exponent - least)] = {0, 1};
            while (d.scale * step < 1)
                d = {d.count + 1, d.scale * 10};
        }
        return of;
    }();
    const auto bits = std::bit_cast<uint32_t>(value);
    const int exponent = static_cast<int>(bits >> 23 & 0xff) - 127;
    if (exponent < least || exponent > most)
        return std::to_chars(at, at + 24, value).ptr;
    const Digits& d = digits[static_cast<size_t>(exponent - least)];
    const float size = std::bit_cast<float>(bits & 0x7fffffff);
    if (bits >> 31)
        *at++ = '-';
    const auto whole = static_cast<uint32_t>(size);
    auto rest = static_cast<uint32_t>((double(size) - whole) * d.scale + 0.5);
    if (whole > 9)
        *at++ = '1';
    *at++ = static_cast<char>('0' + whole % 10);
    if (rest == 0)
        return at;
    *at++ = '.';
    for (char* digit = at + d.count; digit != at; rest /= 10)
        *--digit = static_cast<char>('0' + rest % 10);
    return at + d.count;
}

} // namespace plait
