// The renderer: hair is there, where it should be, lit, the same every time.
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

} // namespace
