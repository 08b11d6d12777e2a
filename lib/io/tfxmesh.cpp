// TressFX 4.1 meshes: text of three sections, "numOfX N" and then N lines that begin with their number;
// # begins a comment. A mesh with bones has four of them, and their weights, in each vertex' line.
#include "io/formats.hpp"
#include "io/words.hpp"

#include <charconv>
#include <cmath>
#include <limits>

namespace plait {
namespace {

constexpr std::string_view LINE_BLANKS = " \t\r";
constexpr size_t VERTEX_NUMBERS = 14; // position, normal, four bones, their weights
constexpr size_t VERTEX_INFLUENCES = 4;

// False unless it is all of `word`.
template <typename T> bool number_of(std::string_view word, T& to) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), to);
    return error == std::errc() && end == word.data() + word.size();
}

class TfxmeshReader {
  public:
    TfxmeshReader(std::string_view text, const std::string& file, const ReadOptions& options)
        : left_(text), file_(file), scale_(options.scale), mesh_(options.memory) {}

    Result<RawMesh> read() {
        PLAIT_TRY(section("numOfBones", max_mesh_bones, [&] { return bone(); }));
        PLAIT_TRY(section("numOfVertices", std::numeric_limits<uint32_t>::max(),
                          [&] { return vertex(); }));
        PLAIT_TRY(section("numOfTriangles", std::numeric_limits<uint32_t>::max(),
                          [&] { return triangle(); }));
        return std::move(mesh_);
    }

  private:
    Error bad(const std::string& text) const {
        return {PLAIT_BAD_DATA,
                format("%s: line %" PRIu64 ": %s", file_.c_str(), line_, text.c_str())};
    }

    // Its line, without comments and empty ones before it.
    Status advance() {
        while (!left_.empty()) {
            const size_t end = std::min(left_.find('\n'), left_.size());
            rest_ = left_.substr(0, end);
            left_.remove_prefix(std::min(end + 1, left_.size()));
            ++line_;
            const size_t first = rest_.find_first_not_of(LINE_BLANKS);
            if (first != rest_.npos && rest_[first] != '#')
                return {};
        }
        return bad("the file ends before all is said that it counts");
    }

    // Counts are not believed: what is not there ends it.
    template <typename Line>
    Status section(const char* name, uint32_t most, const Line& read_line) {
        PLAIT_TRY(advance());
        const std::string_view keyword = next_word(rest_, LINE_BLANKS),
                               word = next_word(rest_, LINE_BLANKS);
        uint32_t count = 0;
        if (keyword != name)
            return bad(format("is \"%s\"; allowed is %s", shown(keyword).c_str(), name));
        if (!number_of(word, count) || count > most)
            return bad(
                format("%s is \"%s\"; allowed 0 to %" PRIu32, name, shown(word).c_str(), most));
        for (uint32_t i = 0; i < count; ++i) {
            PLAIT_TRY(advance());
            const std::string_view index = next_word(rest_, LINE_BLANKS);
            uint32_t number = 0;
            if (!number_of(index, number) || number != i)
                return bad(format("begins with \"%s\"; allowed is its number, %" PRIu32,
                                  shown(index).c_str(), i));
            PLAIT_TRY(read_line());
        }
        return {};
    }

    Status bone() {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(LINE_BLANKS), rest_.size()));
        mesh_.skin.bones.push_back(
            {bone_name(rest_.substr(0, rest_.find_last_not_of(LINE_BLANKS) + 1)), identity_bone});
        return {};
    }

    Status vertex() {
        std::array<float, VERTEX_NUMBERS> numbers{};
        std::array<int64_t, VERTEX_INFLUENCES> bones{};
        for (size_t i = 0; i < VERTEX_NUMBERS; ++i) {
            const std::string_view word = next_word(rest_, LINE_BLANKS);
            const bool is_bone = i >= 6 && i < 10;
            const bool good = is_bone ? number_of(word, bones[i - 6])
                                      : number_of(word, numbers[i]) && std::isfinite(numbers[i]);
            if (!good)
                return bad(format("number %zu of the vertex is \"%s\"; allowed are 6 finite "
                                  "numbers, 4 whole ones and 4 weights",
                                  i + 1, shown(word).c_str()));
        }
        mesh_.surface.positions.push_back(
            {scale_ * numbers[0], scale_ * numbers[1], scale_ * numbers[2]});
        return mesh_.skin.bones.empty() ? Status{} : skin(bones, &numbers[10]);
    }

    // An influence of weight 0 may name no bone. Files keep the four largest of possibly more
    // weights: they are scaled to sum 1.
    Status skin(const std::array<int64_t, VERTEX_INFLUENCES>& bones, const float* weights) {
        BoneIndices indices{};
        BoneWeights kept{};
        double sum = 0;
        for (size_t i = 0; i < VERTEX_INFLUENCES; ++i) {
            if (!(weights[i] >= 0 && weights[i] <= 1))
                return bad(format("bone weight is %g; allowed 0 to 1", double(weights[i])));
            if (weights[i] == 0)
                continue;
            const auto count = static_cast<int64_t>(mesh_.skin.bones.size());
            if (bones[i] < 0 || bones[i] >= count)
                return bad(
                    format("bone is %" PRId64 "; allowed 0 to %" PRId64, bones[i], count - 1));
            indices[i] = static_cast<uint32_t>(bones[i]);
            kept[i] = weights[i];
            sum += double(weights[i]);
        }
        if (!(sum > 0))
            return bad("the bone weights sum to 0; allowed above 0");
        mesh_.skin.indices.push_back(indices);
        mesh_.skin.weights.push_back(normalized(kept));
        return {};
    }

    Status triangle() {
        Triangle corners{};
        for (uint32_t& corner : corners) {
            const std::string_view word = next_word(rest_, LINE_BLANKS);
            const size_t vertices = mesh_.surface.positions.size();
            if (!number_of(word, corner) || corner >= vertices)
                return bad(format("corner is \"%s\"; %s", shown(word).c_str(),
                                  vertices == 0
                                      ? "there are no vertices"
                                      : format("allowed 0 to %zu", vertices - 1).c_str()));
        }
        mesh_.surface.triangles.push_back(corners);
        return {};
    }

    std::string_view left_, rest_; // of the file, of the line
    uint64_t line_ = 0;
    const std::string& file_;
    float scale_;
    RawMesh mesh_;
};

} // namespace

Result<RawMesh> read_tfxmesh(std::string_view text, const std::string& file,
                             const ReadOptions& options) {
    return TfxmeshReader(text, file, options).read();
}

} // namespace plait
