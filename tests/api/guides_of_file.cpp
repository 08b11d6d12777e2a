// A file that says which of its strands are guides and what the others follow: guides, map and groups.
#include "support.hpp"

#include <plait/plait_formats.h>
#include <plait/plait_offline.h>

#include <filesystem>
#include <fstream>
#include <random>

namespace {

namespace fs = std::filesystem;

struct Loaded {
    plait_groom* guides = nullptr;
    plait_follow_map* map = nullptr;

    explicit Loaded(const std::string& path) {
        plait::check(plait_groom_load_guides(path.c_str(), nullptr, &guides, &map));
    }
    Loaded(const Loaded&) = delete;
    Loaded& operator=(const Loaded&) = delete;
    ~Loaded() {
        plait_groom_destroy(guides);
        plait_follow_map_destroy(map);
    }
    template <typename T> std::vector<T> of_map(plait_follow_map_field field) const {
        size_t size = 0;
        plait::check(plait_follow_map_read(map, field, nullptr, &size));
        std::vector<T> values(size / sizeof(T));
        plait::check(plait_follow_map_read(map, field, values.data(), &size));
        return values;
    }
    std::vector<uint32_t> groups() const {
        size_t size = 0;
        plait::check(plait_groom_read(guides, PLAIT_GROOM_FIELD_GROUP, nullptr, &size));
        std::vector<uint32_t> values(size / sizeof(uint32_t));
        plait::check(plait_groom_read(guides, PLAIT_GROOM_FIELD_GROUP, values.data(), &size));
        return values;
    }
};

class GuidesOfAFile : public testing::Test {
  protected:
    GuidesOfAFile()
        : folder_(fs::temp_directory_path() /
                  ("plait-guides-" + std::to_string(std::random_device{}()))) {
        fs::create_directory(folder_);
    }
    ~GuidesOfAFile() override { fs::remove_all(folder_); }

    std::string corpus(const char* name) const {
        const auto to = folder_ / (std::string(name) + ".abc");
        fs::copy_file(fs::path(PLAIT_SOURCE_DIR "/tests/fuzz/corpus/alembic") / name, to);
        return to.string();
    }
    // Three guides, 10 apart along x, and strands at 1 and 19 with these lines of their own.
    std::string usd(const std::string& of_guides, const std::string& of_follows) const {
        const auto curves = [](const char* name, std::initializer_list<int> at,
                               const std::string& lines) {
            std::string counts, points;
            for (const int x : at) {
                counts += counts.empty() ? "2" : ", 2";
                points += (points.empty() ? "(" : ", (") + std::to_string(x) + ", 0, 0), (" +
                          std::to_string(x) + ", -2, 0)";
            }
            return std::string("def BasisCurves \"") + name +
                   "\"\n{\nuniform token type = \"linear\"\nint[] curveVertexCounts = [" + counts +
                   "]\npoint3f[] points = [" + points + "]\n" + lines + "\n}\n";
        };
        const auto path = (folder_ / "a.usda").string();
        std::ofstream(path) << "#usda 1.0\n(\nmetersPerUnit = 1\nupAxis = \"Y\"\n)\n"
                            << curves("guides", {0, 10, 20},
                                      "int primvars:groom_guide = 1\n" + of_guides)
                            << curves("hair", {1, 19},
                                      "int primvars:groom_guide = 0\n" + of_follows);
        return path;
    }
    void expect_refused(const std::string& of_guides, const std::string& of_follows,
                        const char* text) const {
        plait_groom* guides = nullptr;
        plait_follow_map* map = nullptr;
        expect_failure(
            plait_groom_load_guides(usd(of_guides, of_follows).c_str(), nullptr, &guides, &map),
            PLAIT_BAD_DATA, text);
        EXPECT_EQ(guides, nullptr);
        EXPECT_EQ(map, nullptr);
    }

  private:
    fs::path folder_;
};

const std::string ids = "int[] primvars:groom_id = [7, 3, 11]";
std::string closest(const std::string& guides, const std::string& weights) {
    return "int[] primvars:groom_closest_guides = " + guides +
           "\nfloat[] primvars:groom_guide_weights = " + weights;
}

// The greatest weight first; guides of weight 0 repeat it.
void expect_map(const Loaded& loaded) {
    EXPECT_EQ(loaded.of_map<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_GUIDES),
              (std::vector<uint32_t>{0, 1, 0, 0, 2, 2, 2, 2}));
    EXPECT_EQ(loaded.of_map<float>(PLAIT_FOLLOW_MAP_FIELD_WEIGHTS),
              (std::vector<float>{0.75f, 0.25f, 0, 0, 1, 0, 0, 0}));
}

// Written by Alembic's own library.
TEST_F(GuidesOfAFile, AreFollowedAsAnAlembicFileSays) {
    const Loaded loaded(corpus("follows"));
    expect_map(loaded);
    EXPECT_EQ(loaded.groups(), (std::vector<uint32_t>{0, 1, 1}));
}

TEST_F(GuidesOfAFile, AreFollowedAsAUsdFileSays) {
    for (const char* list : {"[7, 3, -1, 0, 0, 11]", "[(7, 3, -1), (0, 0, 11)]"}) {
        const Loaded loaded(usd(ids, closest(list, "[3, 1, 0, 0, 0, 2]")));
        expect_map(loaded);
        EXPECT_TRUE(loaded.groups().empty());
    }
}

TEST_F(GuidesOfAFile, MayHaveIndices) {
    const Loaded loaded(
        usd("int[] primvars:groom_id = [11, 3, 7]\nint[] primvars:groom_id:indices = "
            "[2, 1, 0]",
            closest("[(0, 0, 11), (7, 3, -1)]", "[0, 0, 2, 3, 1, 0]") +
                "\nint[] primvars:groom_closest_guides:indices = [1, 0]\nint[] "
                "primvars:groom_guide_weights:indices = [1, 0]"));
    expect_map(loaded);
    expect_refused(
        "int[] primvars:groom_id = [11, 3, 7]\nint[] primvars:groom_id:indices = [2, 1, 3]", "",
        "index 2 of primvars:groom_id is 3; there are 3 values");
}

TEST_F(GuidesOfAFile, SayWhatBecameOfBoth) {
    const Loaded loaded(usd(ids, closest("[7, 3, 3, 7, 3, 11]", "[1, 0, 0, 0, 0, 1]") +
                                     "\ncolor3f[] primvars:colour = [(1, 0, 0)]"));
    size_t size = 0;
    plait::check(plait_groom_read_notes(loaded.guides, nullptr, &size));
    std::string notes(size, '\0');
    plait::check(plait_groom_read_notes(loaded.guides, notes.data(), &size));
    EXPECT_NE(notes.find("3 of its 5 curves are guides"), std::string::npos) << notes;
    EXPECT_NE(notes.find("1 properties are not read: primvars:colour"), std::string::npos) << notes;
}

TEST_F(GuidesOfAFile, AreFollowedByTheNearestWhereNothingIsSaid) {
    const Loaded loaded(usd("", ""));
    const auto guides = loaded.of_map<uint32_t>(PLAIT_FOLLOW_MAP_FIELD_GUIDES);
    EXPECT_EQ(guides[0], 0u);
    EXPECT_EQ(guides[4], 2u);
}

// The strand between two guides goes where both go, and groups choose materials.
TEST_F(GuidesOfAFile, AreSimulated) {
    const Loaded loaded(corpus("follows"));
    const auto groups = loaded.groups();
    auto materials = std::vector{plait_material_defaults(), plait_material_defaults()};
    auto desc = plait_sim_desc_defaults();
    desc.follow_map = loaded.map;
    desc.materials = materials.data();
    desc.material_count = materials.size();
    desc.strand_material = plait::view(groups);
    const plait::Context context = make_context("reference");
    plait_sim* sim = nullptr;
    plait::check(plait_sim_create(context, loaded.guides, &desc, &sim));
    auto info = plait_sim_info_defaults();
    plait::check(plait_sim_describe(sim, &info));
    EXPECT_EQ(info.guides, 3u);
    EXPECT_EQ(info.strands, 5u);
    plait::check(plait_sim_step(sim, frame));
    plait_sim_destroy(sim);
}

TEST_F(GuidesOfAFile, AreRefusedWithPlaceAndValue) {
    expect_refused(ids, closest("[7, 3, 3, 0, 4, 11]", "[1, 0, 0, 0, 1, 1]"),
                   "follow 1: closest_guides[1] is 4, the id of none of the 3 guides");
    expect_refused(ids, closest("[7, 3, 3, 7, 3, 11]", "[1, -1, 0, 0, 1, 1]"),
                   "follow 0: guide_weights[1] is -1, allowed is 0 and more");
    expect_refused(ids, closest("[7, 3, 3, 7, 3, 11]", "[1, 0, 0, 0, 0, 0]"),
                   "follow 1: its guide_weights add up to 0, allowed is more than 0 and finite");
    expect_refused("int[] primvars:groom_id = [7, 3, 7]",
                   closest("[7, 3, 3, 7, 3, 11]", "[1, 0, 0, 0, 0, 1]"),
                   "id 7 is that of guide 0 and of guide 2");
    expect_refused("", closest("[7, 3, 3, 7, 3, 11]", "[1, 0, 0, 0, 0, 1]"),
                   "strands have closest_guides, and not all guides have an id");
    expect_refused(ids, closest("[7, 3, 3]", "[1, 0, 0]"),
                   "closest_guides has 3 values; allowed are 6, 3 for each curve");
    expect_refused(ids, "int[] primvars:groom_closest_guides = [7, 3, 3, 7, 3, 11]",
                   "one is given, both belong together");
    expect_refused("int[] primvars:groom_id = [7, -3, 11]", "",
                   "id of curve 1 is -3; allowed are 0 to 2^31 - 1");
    expect_refused("int primvars:groom_group_id = -1", "",
                   "group id of curve 0 is -1; allowed are 0 to 2^31 - 1");
    expect_refused(ids, closest("[(7, 3), (7, 3)]", "[1, 0, 0, 0, 0, 1]"), "a.usda");
}

} // namespace
