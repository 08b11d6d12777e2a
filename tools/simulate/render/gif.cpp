// Format: "Graphics Interchange Format, Version 89a", CompuServe 1990. Palette: median cut
// (Heckbert, "Color image quantization for frame buffer display", SIGGRAPH 1982) of the first
// frame.
#include "gif.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace render {

namespace {

constexpr size_t most_colours = 255;
constexpr uint8_t unchanged = 255; // the transparent index
constexpr int bits = 6;            // of a channel when the nearest colour is looked up

using Colour = std::array<uint8_t, 3>;

// Splits the box of colours that spreads widest at its middle, until there are enough.
std::vector<Colour> median_cut(std::vector<Colour> colours) {
    struct Span {
        size_t first, last;
        int channel, spread;
    };
    const auto measured = [&](size_t first, size_t last) {
        Span span{first, last, 0, -1};
        for (int channel = 0; channel < 3; ++channel) {
            const auto [least, most] = std::minmax_element(
                colours.begin() + static_cast<ptrdiff_t>(first),
                colours.begin() + static_cast<ptrdiff_t>(last),
                [&](const Colour& a, const Colour& b) { return a[channel] < b[channel]; });
            if ((*most)[channel] - (*least)[channel] > span.spread)
                span = {first, last, channel, (*most)[channel] - (*least)[channel]};
        }
        return span;
    };
    std::vector<Span> spans{measured(0, colours.size())};
    while (spans.size() < most_colours) {
        const auto widest =
            std::max_element(spans.begin(), spans.end(),
                             [](const Span& a, const Span& b) { return a.spread < b.spread; });
        if (widest->spread <= 1)
            break;
        const Span cut = *widest;
        const size_t middle = (cut.first + cut.last) / 2;
        const auto at = [&](size_t i) { return colours.begin() + static_cast<ptrdiff_t>(i); };
        std::nth_element(
            at(cut.first), at(middle), at(cut.last),
            [&](const Colour& a, const Colour& b) { return a[cut.channel] < b[cut.channel]; });
        *widest = measured(cut.first, middle);
        spans.push_back(measured(middle, cut.last));
    }
    std::vector<Colour> palette;
    for (const Span& span : spans) {
        std::array<size_t, 3> sum{};
        for (size_t i = span.first; i < span.last; ++i)
            for (int channel = 0; channel < 3; ++channel)
                sum[channel] += colours[i][channel];
        Colour mean{};
        for (int channel = 0; channel < 3; ++channel)
            mean[channel] = static_cast<uint8_t>(sum[channel] / (span.last - span.first));
        palette.push_back(mean);
    }
    return palette;
}

std::vector<Colour> colours_of(const Image& image) {
    constexpr size_t most = 40000;
    const size_t pixels = image.rgb.size() / 3, step = std::max<size_t>(1, pixels / most);
    std::vector<Colour> colours;
    for (size_t i = 0; i < pixels; i += step)
        colours.push_back({image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]});
    return colours;
}

// Codes of 9 to 12 bits, least significant bit first, in blocks of at most 255 bytes.
class BitStream {
  public:
    void put(uint32_t code, int length) {
        pending_ |= code << held_;
        for (held_ += length; held_ >= 8; held_ -= 8, pending_ >>= 8)
            put_byte(static_cast<uint8_t>(pending_));
    }
    std::vector<uint8_t> finish() {
        if (held_ > 0)
            put_byte(static_cast<uint8_t>(pending_));
        flush();
        out_.push_back(0);
        return std::move(out_);
    }

  private:
    void put_byte(uint8_t byte) {
        block_.push_back(byte);
        if (block_.size() == 255)
            flush();
    }
    void flush() {
        if (block_.empty())
            return;
        out_.push_back(static_cast<uint8_t>(block_.size()));
        out_.insert(out_.end(), block_.begin(), block_.end());
        block_.clear();
    }

    std::vector<uint8_t> out_, block_;
    uint32_t pending_ = 0;
    int held_ = 0;
};

// Lempel-Ziv-Welch as the format has it, for bytes.
class Compressor {
  public:
    std::vector<uint8_t> compress(const std::vector<uint8_t>& bytes) {
        clear();
        uint32_t prefix = bytes[0];
        for (size_t i = 1; i < bytes.size(); ++i) {
            uint16_t& longer = next_[prefix * 256 + bytes[i]];
            if (longer != 0) {
                prefix = longer;
                continue;
            }
            stream_.put(prefix, length_);
            learn(longer);
            prefix = bytes[i];
        }
        stream_.put(prefix, length_);
        // The reader has learnt one more word by then.
        if (codes_ == (1u << length_) && length_ < 12)
            ++length_;
        stream_.put(end_code, length_);
        return stream_.finish();
    }

  private:
    static constexpr uint32_t clear_code = 256, end_code = 257, most_codes = 4096;

    void clear() {
        stream_.put(clear_code, length_);
        std::fill(next_.begin(), next_.end(), uint16_t{0});
        codes_ = end_code + 1;
        length_ = 9;
    }
    void learn(uint16_t& longer) {
        if (codes_ == most_codes)
            return clear();
        longer = static_cast<uint16_t>(codes_);
        if (codes_ == (1u << length_) && length_ < 12)
            ++length_;
        ++codes_;
    }

    BitStream stream_;
    std::vector<uint16_t> next_ = std::vector<uint16_t>(size_t{most_codes} * 256); // 0: none
    uint32_t codes_ = 0;
    int length_ = 9;
};

void put16(std::vector<uint8_t>& out, int value) {
    out.push_back(static_cast<uint8_t>(value & 255));
    out.push_back(static_cast<uint8_t>(value >> 8));
}

} // namespace

Gif::Gif(std::string path, int width, int height, double rate)
    : path_(std::move(path)), width_(width), height_(height), rate_(rate),
      file_(std::fopen((path_ + ".part").c_str(), "wb")), good_(file_ != nullptr),
      nearest_(size_t{1} << (3 * bits), int16_t{-1}) {}

Gif::~Gif() {
    if (file_) { // never closed: nobody wants it
        std::fclose(file_);
        std::error_code error;
        std::filesystem::remove(path_ + ".part", error);
    }
}

void Gif::put(const std::vector<uint8_t>& bytes) {
    good_ = good_ && std::fwrite(bytes.data(), 1, bytes.size(), file_) == bytes.size();
}

// Head, palette, and the extension that makes it repeat.
void Gif::begin(const Image& first) {
    palette_ = median_cut(colours_of(first));
    std::vector<uint8_t> head{'G', 'I', 'F', '8', '9', 'a'};
    put16(head, width_);
    put16(head, height_);
    head.insert(head.end(), {0xf7, 0, 0}); // 256 colours follow
    for (size_t i = 0; i < 256; ++i)
        for (int channel = 0; channel < 3; ++channel)
            head.push_back(i < palette_.size() ? palette_[i][channel] : 0);
    head.insert(head.end(), {0x21, 0xff, 11, 'N', 'E', 'T', 'S', 'C', 'A', 'P', 'E', '2', '.', '0',
                             3, 1, 0, 0, 0});
    put(head);
}

// Ordered dither of 4 x 4, the same in every frame, so that what is still stays still.
uint8_t Gif::index_of(const uint8_t* rgb, int x, int y) {
    static constexpr int pattern[4][4] = {
        {0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
    const int offset = (pattern[y & 3][x & 3] - 7) / 2;
    std::array<int, 3> colour{};
    size_t key = 0;
    for (int channel = 0; channel < 3; ++channel) {
        colour[channel] = std::clamp(rgb[channel] + offset, 0, 255) >> (8 - bits);
        key = key << bits | static_cast<size_t>(colour[channel]);
    }
    if (nearest_[key] < 0) {
        int best = 1 << 30;
        for (size_t i = 0; i < palette_.size(); ++i) {
            int distance = 0;
            for (int channel = 0; channel < 3; ++channel) {
                const int gap = (colour[channel] << (8 - bits)) + 2 - palette_[i][channel];
                distance += gap * gap;
            }
            if (distance < best) {
                best = distance;
                nearest_[key] = static_cast<int16_t>(i);
            }
        }
    }
    return static_cast<uint8_t>(nearest_[key]);
}

Gif::Box Gif::changed(const std::vector<uint8_t>& indices) const {
    if (shown_.empty())
        return {0, 0, width_, height_};
    Box box{width_, height_, 0, 0};
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
            const size_t at =
                static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
            if (indices[at] != shown_[at])
                box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x + 1),
                       std::max(box.bottom, y + 1)};
        }
    return box.right > box.left ? box : Box{0, 0, 1, 1}; // a frame has at least one pixel
}

void Gif::write_frame(const std::vector<uint8_t>& indices, Box box) {
    const auto hundredths = [&](uint32_t frame) {
        return static_cast<int>(std::lround(100.0 * frame / rate_));
    };
    std::vector<uint8_t> head{0x21, 0xf9, 4, 0x05}; // leave it standing; one index is transparent
    put16(head, std::max(2, hundredths(frames_ + 1) - hundredths(frames_)));
    head.insert(head.end(), {unchanged, 0, 0x2c});
    for (const int value : {box.left, box.top, box.right - box.left, box.bottom - box.top})
        put16(head, value);
    head.insert(head.end(), {0, 8}); // the common palette; bytes of 8 bits
    put(head);
    std::vector<uint8_t> bytes;
    for (int y = box.top; y < box.bottom; ++y)
        for (int x = box.left; x < box.right; ++x) {
            const size_t at =
                static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
            const bool same = !shown_.empty() && shown_[at] == indices[at];
            bytes.push_back(same ? unchanged : indices[at]);
        }
    put(Compressor().compress(bytes));
}

void Gif::add(const Image& frame) {
    if (frame.width != width_ || frame.height != height_)
        throw std::runtime_error(path_ + ": a frame of another size");
    if (!good_)
        return;
    if (frames_ == 0)
        begin(frame);
    std::vector<uint8_t> indices;
    indices.reserve(frame.rgb.size() / 3);
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x)
            indices.push_back(index_of(frame.pixel(x, y), x, y));
    write_frame(indices, changed(indices));
    shown_ = std::move(indices);
    ++frames_;
}

bool Gif::close() {
    if (!file_)
        return false;
    put({0x3b});
    good_ = std::fclose(file_) == 0 && good_ && frames_ > 0;
    file_ = nullptr;
    std::error_code error;
    if (good_)
        std::filesystem::rename(path_ + ".part", path_, error);
    else
        std::filesystem::remove(path_ + ".part", error);
    return good_ && !error;
}

} // namespace render
