// The renderer: hair is there, where it should be, lit, the same every time.
#include "render/gif.hpp"
#include "render/render.hpp"
#include "render/sheet.hpp"
#include "support.hpp"

#include <cstdlib>
#include <vector>

using Eigen::Vector3f;
using render::Image;

namespace {

// A curtain of straight strands, 0.2 m wide and high, in the plane z = 0, hanging from y = 0.1.
struct Curtain {
    static constexpr uint32_t strands = 200, row = 4;
    std::vector<float> positions;
    std::vector<uint32_t> counts = std::vector<uint32_t>(strands, row);

    Curtain() {
        for (uint32_t strand = 0; strand < strands; ++strand)
            for (uint32_t v = 0; v < row; ++v)
                positions.insert(positions.end(),
                                 {0.2f * (static_cast<float>(strand) / (strands - 1) - 0.5f),
                                  0.1f - 0.2f * static_cast<float>(v) / (row - 1), 0.0f, 1.0f});
    }
    render::Hair hair() const { return {positions, counts, row, 0.002f}; }
};

Image draw(const render::Hair& hair, unsigned threads = 2) {
    render::Renderer renderer;
    const render::Camera camera{Vector3f(0, 0, 1), Vector3f::Zero(), Vector3f::UnitY(), 30.0f};
    return renderer.draw(hair, {}, camera, {}, {64, 64, 4, threads});
}

int difference(const Image& a, const Image& b, int x, int y) {
    int sum = 0;
    for (int channel = 0; channel < 3; ++channel)
        sum += std::abs(a.pixel(x, y)[channel] - b.pixel(x, y)[channel]);
    return sum;
}

// The half width of the view at the curtain is tan(15 deg) = 0.268 m: it covers pixels 20..44.
TEST(Pictures, hair_is_where_it_should_be) {
    const Curtain curtain;
    const Image hair = draw(curtain.hair()), empty = draw({{}, {}, 4, 0.0f});
    for (const auto& [x, y] : {std::pair{32, 32}, {24, 24}, {40, 40}, {24, 40}})
        EXPECT_GT(difference(hair, empty, x, y), 20) << x << ", " << y;
    for (const auto& [x, y] : {std::pair{5, 5}, {32, 10}, {10, 32}, {60, 60}})
        EXPECT_EQ(difference(hair, empty, x, y), 0) << x << ", " << y;
}

TEST(Pictures, are_the_same_on_any_number_of_threads) {
    const Curtain curtain;
    EXPECT_EQ(draw(curtain.hair(), 1).rgb, draw(curtain.hair(), 3).rgb);
}

// A second curtain between the first and the key light, which hangs above the camera to its left.
TEST(Pictures, hair_shades_hair) {
    Curtain both;
    const Image lit = draw(both.hair());
    const Curtain other;
    for (size_t i = 0; i < other.positions.size(); i += 4)
        both.positions.insert(both.positions.end(), {other.positions[i] - 0.2f,
                                                     other.positions[i + 1] + 0.25f, 0.2f, 1.0f});
    both.counts.resize(2 * Curtain::strands, Curtain::row);
    const Image shaded = draw(both.hair());
    int before = 0, after = 0;
    for (int y = 26; y < 38; ++y)
        for (int x = 26; x < 38; ++x) {
            before += lit.pixel(x, y)[0];
            after += shaded.pixel(x, y)[0];
        }
    EXPECT_LT(after, 0.95 * before);
}

class Sheets : public TemporaryFolder {};

TEST_F(Sheets, hold_their_pictures) {
    const Image image = draw(Curtain().hair());
    write_png(image, path("a.png"));
    EXPECT_EQ(render::read_png(path("a.png")).rgb, image.rgb);

    render::write_sheet(
        {"title", "subtitle", {{"A", {{image, "t = 0"}, {image, "t = 1"}}}, {"B", {{image, ""}}}}},
        path("sheet.png"));
    const Image sheet = render::read_png(path("sheet.png"));
    EXPECT_GE(sheet.width, 2 * image.width);
    EXPECT_GE(sheet.height, 2 * image.height);
    bool found = false; // the first picture, beside the margin of 24 pixels
    for (int y = 0; y + image.height < sheet.height && !found; ++y)
        found = sheet.pixel(24, y)[0] == image.pixel(0, 0)[0] &&
                sheet.pixel(24 + 32, y + 32)[0] == image.pixel(32, 32)[0] &&
                sheet.pixel(24 + 32, y + 32)[2] == image.pixel(32, 32)[2];
    EXPECT_TRUE(found);
    EXPECT_THROW(write_png(image, path("no/such/folder.png")), std::runtime_error);
}

// ---- films

// Reads the frames of a .gif as viewers do, by the format's specification.
class GifReader {
  public:
    explicit GifReader(const std::string& path) {
        std::ifstream stream(path, std::ios::binary);
        bytes_.assign(std::istreambuf_iterator<char>(stream), {});
        width = word(6), height = word(8);
        palette_ = 13;
        at_ = palette_ + 3 * 256;
        screen_ = Image(width, height);
        while (at_ < bytes_.size() && bytes_[at_] != 0x3b)
            bytes_[at_] == 0x21 ? skip_extension() : read_frame();
    }
    bool whole() const { return at_ + 1 == bytes_.size() && bytes_[at_] == 0x3b; }

    int width, height;
    std::vector<Image> frames;

  private:
    int word(size_t at) const { return bytes_.at(at) | bytes_.at(at + 1) << 8; }

    std::vector<uint8_t> blocks() {
        std::vector<uint8_t> data;
        for (uint8_t size = 0; (size = bytes_.at(at_++)) != 0; at_ += size)
            data.insert(data.end(), bytes_.begin() + static_cast<ptrdiff_t>(at_),
                        bytes_.begin() + static_cast<ptrdiff_t>(at_ + size));
        return data;
    }
    void skip_extension() {
        at_ += 2;
        blocks();
    }
    void read_frame() {
        const int left = word(at_ + 1), top = word(at_ + 3), wide = word(at_ + 5);
        at_ += 11;
        const std::vector<uint8_t> indices = unpack(blocks());
        ASSERT_EQ(indices.size() % static_cast<size_t>(wide), 0u);
        for (size_t i = 0; i < indices.size(); ++i)
            if (indices[i] != 255) // transparent
                for (size_t channel = 0; channel < 3; ++channel)
                    screen_.pixel(left + static_cast<int>(i) % wide,
                                  top + static_cast<int>(i) / wide)[channel] =
                        bytes_[palette_ + 3u * indices[i] + channel];
        frames.push_back(screen_);
    }
    static std::vector<uint8_t> unpack(const std::vector<uint8_t>& data) {
        std::vector<std::vector<uint8_t>> words;
        std::vector<uint8_t> out, before;
        int length = 9;
        for (size_t bit = 0; bit + static_cast<size_t>(length) <= 8 * data.size();) {
            uint32_t code = 0;
            for (int i = 0; i < length; ++i, ++bit)
                code |= static_cast<uint32_t>(data[bit / 8] >> (bit % 8) & 1) << i;
            if (code == 257)
                return out;
            if (code == 256) {
                words.clear();
                before.clear();
                length = 9;
                continue;
            }
            std::vector<uint8_t> word;
            if (code < 256)
                word = {static_cast<uint8_t>(code)};
            else if (code - 258 < words.size())
                word = words[code - 258];
            else {
                word = before;
                word.push_back(before.at(0));
            }
            out.insert(out.end(), word.begin(), word.end());
            if (!before.empty() && words.size() + 258 < 4096) {
                before.push_back(word[0]);
                words.push_back(before);
            }
            if (words.size() + 258 == 1u << length && length < 12)
                ++length;
            before = word;
        }
        ADD_FAILURE() << "no end code";
        return out;
    }

    std::vector<uint8_t> bytes_;
    size_t palette_ = 0, at_ = 0;
    Image screen_;
};

// Noise, so that the table of words fills and is begun anew several times.
TEST_F(Sheets, films_are_read_back_as_they_were) {
    Image first(310, 190);
    for (size_t i = 0; i < first.rgb.size(); ++i)
        first.rgb[i] = static_cast<uint8_t>(60 + (i / 3 * 2654435761u >> 20) % 120);
    Image second = first;
    for (int y = 50; y < 90; ++y)
        for (int x = 100; x < 180; ++x)
            second.pixel(x, y)[0] = second.pixel(x, y)[1] = second.pixel(x, y)[2] = 90;
    {
        render::Gif gif(path("a.gif"), 310, 190, 15);
        for (const Image* image : {&first, &second, &second})
            gif.add(*image);
        EXPECT_FALSE(std::filesystem::exists(path("a.gif"))) << "not before it is whole";
        EXPECT_TRUE(gif.close());
    }
    const GifReader read(path("a.gif"));
    EXPECT_TRUE(read.whole());
    ASSERT_EQ(read.frames.size(), 3u);
    for (const auto& [image, frame] : {std::pair{&first, 0u}, {&second, 1u}, {&second, 2u}}) {
        int worst = 0;
        for (size_t i = 0; i < image->rgb.size(); ++i)
            worst = std::max(worst, std::abs(image->rgb[i] - read.frames[frame].rgb[i]));
        EXPECT_LE(worst, 12) << "frame " << frame; // dither of 4, and 255 colours
    }
    EXPECT_THROW(render::Gif(path("b.gif"), 5, 5, 15).add(first), std::runtime_error);
    EXPECT_FALSE(std::filesystem::exists(path("b.gif.part"))) << "nobody wanted it";
    EXPECT_FALSE(render::Gif(path("no/such/c.gif"), 5, 5, 15).close());
}

TEST_F(Sheets, columns_of_a_film_are_of_even_size) {
    const Image image(33, 21);
    const Image both = render::side_by_side({{image, "A"}, {image, "B"}});
    EXPECT_EQ(both.width % 2, 0);
    EXPECT_EQ(both.height % 2, 0);
    EXPECT_GE(both.width, 66);
    EXPECT_GT(both.height, 21);
}

} // namespace
