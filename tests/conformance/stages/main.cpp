// plait-conformance: every stage's case on every device, compared with the float64 reference.
//
// Environment: PLAIT_TEST_DEVICE=part        only devices whose backend, platform or name has it
//              PLAIT_TEST_ALLOW_NO_OPENCL=1  if there is no such device, say so and exit with 77
//              PLAIT_TEST_LANES=n            strands per work-item, as in plait_open_info
//              PLAIT_TEST_IDLE_LOCAL=bytes   of each work-group, as in plait_open_info
//              PLAIT_TEST_MAX_VERTICES=V     leave out longer strands in the stages over lanes
#include "case.hpp"
#include "closed_forms.hpp"
#include "disturb.hpp"
#include "inputs.hpp"
#include "subjects.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>

namespace plait::conformance {
namespace {

using cases::Case;
using cases::Field;
using cases::FieldKind;
using cases::Outputs;

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

// The stages over lanes take an interpreter hours at full length.
bool is_too_long(plait_stage stage, const cases::Setup& setup) {
    static const std::string most = environment("PLAIT_TEST_MAX_VERTICES");
    return !most.empty() && plait_stage_describe(stage)->space == PLAIT_SPACE_LANES &&
           setup.width > std::stoul(most);
}

// What the formulae say, computed once per setup.
const Outputs& expected_of(const Case& stage_case, size_t setup) {
    static const std::shared_ptr<Subject> reference = find_backend("reference");
    static std::map<std::pair<plait_stage, size_t>, Outputs> known;
    Outputs& outputs = known[{stage_case.stage, setup}];
    if (outputs.empty() && reference && reference->device()) {
        std::string error;
        outputs = cases::run(reference->api(), reference->device(), stage_case.stage,
                             stage_case.setups[setup], error);
        EXPECT_EQ(error, "") << "on the reference";
    }
    return outputs;
}

// "" if the device's outputs for `given` are those expected of setup number `index`.
std::string difference(const Case& stage_case, size_t index, const cases::Setup& given,
                       Subject& subject) {
    const Outputs& expected = expected_of(stage_case, index);
    std::string error;
    const Outputs got = cases::run(subject.api(), subject.device(), stage_case.stage, given, error);
    if (!error.empty() || expected.empty())
        return error.empty() ? "no expected outputs" : error;
    return cases::compare(stage_case, stage_case.setups[index], expected, got);
}

class StageTest : public testing::Test {
  public:
    StageTest(Subject& subject, const Case& stage_case)
        : subject_(subject), stage_case_(stage_case) {}

  protected:
    bool open() {
        EXPECT_NE(subject_.device(), nullptr) << subject_.open_error();
        return subject_.device() != nullptr;
    }

    Subject& subject_;
    const Case& stage_case_;
};

// The device computes what the formulae say.
class Agrees : public StageTest {
  public:
    using StageTest::StageTest;
    void TestBody() override {
        if (!open())
            return;
        EXPECT_TRUE(subject_.api().supports(subject_.device(), stage_case_.stage));
        size_t compared = 0;
        for (size_t i = 0; i < stage_case_.setups.size(); ++i) {
            if (is_too_long(stage_case_.stage, stage_case_.setups[i]))
                continue;
            ++compared;
            EXPECT_EQ(difference(stage_case_, i, stage_case_.setups[i], subject_), "");
        }
        EXPECT_GT(compared, 0u);
    }
};

// Whether a vertex sticks, and to which capsule, is a decision: where rounding makes it, every
// device may be right. The inputs keep clear: changed by what float32 makes of positions in a step,
// some 1e-6 of them, they move what the formulae say by no more than a device may be off.
class KeepsClear : public StageTest {
  public:
    using StageTest::StageTest;
    void TestBody() override {
        if (!open())
            return;
        size_t compared = 0;
        for (size_t i = 0; i < stage_case_.setups.size(); ++i)
            for (uint32_t seed = 0; seed < 8 && has_contact(stage_case_.setups[i]); ++seed) {
                ++compared;
                EXPECT_EQ(moved(i, seed), "") << "rounded at random, seed " << seed;
            }
        EXPECT_GT(compared, 0u);
    }

  private:
    static bool has_contact(const cases::Setup& setup) {
        return setup.params_as<plait_lane_params>().collider_count > 0;
    }

    std::string moved(size_t index, uint32_t seed) {
        const cases::Setup& setup = stage_case_.setups[index];
        const Outputs& expected = expected_of(stage_case_, index);
        std::string error;
        Outputs got = cases::run(subject_.api(), subject_.device(), stage_case_.stage,
                                 rounded(setup, seed), error);
        if (!error.empty() || expected.empty())
            return error.empty() ? "no expected outputs" : error;
        const plait_stage_info& info = *plait_stage_describe(stage_case_.stage);
        for (size_t i = 0; i < got.size(); ++i)
            if (info.args[i].access == PLAIT_ACCESS_READ) // what was changed here
                got[i] = expected[i];
        return cases::compare(stage_case_, setup, expected, got);
    }

    // All but flags, which are no measures.
    cases::Setup rounded(cases::Setup setup, uint32_t seed) const {
        const cases::Setup given = setup;
        cases::Random random(seed);
        for (cases::Array& array : setup.buffers)
            for (float& value : array.floats)
                value *= 1 + (static_cast<float>(random.below(3)) - 1) * 0x1p-20f;
        for (const Component& component : components_of(stage_case_)) {
            std::vector<float>& floats = setup.buffers[component.buffer].floats;
            if (has(stage_case_.flags, component.name))
                for (size_t i = component.place; i < floats.size(); i += component.period)
                    floats[i] = given.buffers[component.buffer].floats[i];
        }
        return setup;
    }
};

// The comparison notices every parameter and every float of a buffer that is a little off, in one
// setup at least.
class Notices : public StageTest {
  public:
    using StageTest::StageTest;
    void TestBody() override {
        if (!open())
            return;
        const plait_stage_info& info = *plait_stage_describe(stage_case_.stage);
        size_t described = 0;
        for (const Field& field : cases::fields_of(info.params_type)) {
            described += 4 * field.words;
            if (field.kind != FieldKind::layout)
                check(field);
        }
        EXPECT_EQ(described, info.params_size) << info.params_type << ": fields.cpp has a gap";
        for (const Component& component : components_of(stage_case_))
            check(component.name, component);
    }

  private:
    void check(const Field& field) {
        for (size_t word = 0; word < field.words; ++word)
            if (field.kind != FieldKind::vector || word % 4 != 3)
                check(field.name, field, word);
    }

    template <typename... What> void check(const std::string& name, const What&... what) {
        if (has(stage_case_.decides, name))
            return;
        if (has(stage_case_.unread, name))
            EXPECT_FALSE(noticed(what...)) << name << " is called unread and is not";
        else
            EXPECT_TRUE(noticed(what...)) << name << " may be off without a test failing";
    }

    // In the order given: the first setups can do with a field of any value.
    bool noticed(const Field& field, size_t word) {
        for (size_t i = 0; i < stage_case_.setups.size(); ++i) {
            cases::Setup disturbed = stage_case_.setups[i];
            disturb(disturbed, field, word);
            if (differs(i, disturbed))
                return true;
        }
        return false;
    }

    bool noticed(const Component& component) {
        return std::any_of(order_.begin(), order_.end(), [&](size_t i) {
            cases::Setup disturbed = stage_case_.setups[i];
            return disturb(disturbed, stage_case_, component) && differs(i, disturbed);
        });
    }

    // The setups, lightest first: most of them notice.
    static std::vector<size_t> in_order(const std::vector<cases::Setup>& setups) {
        std::vector<size_t> order(setups.size());
        std::iota(order.begin(), order.end(), size_t{0});
        std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
            return size_t{setups[a].items} * setups[a].width <
                   size_t{setups[b].items} * setups[b].width;
        });
        return order;
    }

    bool differs(size_t index, const cases::Setup& disturbed) {
        const Outputs& expected = expected_of(stage_case_, index);
        std::string error;
        Outputs got =
            cases::run(subject_.api(), subject_.device(), stage_case_.stage, disturbed, error);
        EXPECT_EQ(error, "");
        if (!error.empty() || expected.empty())
            return false;
        const cases::Setup& original = stage_case_.setups[index];
        forgive(stage_case_, original, disturbed, expected, got);
        return !cases::compare(stage_case_, original, expected, got).empty();
    }

    const std::vector<size_t> order_ = in_order(stage_case_.setups);
};

// The device gives what can be worked out by hand.
class Solves : public testing::Test {
  public:
    Solves(Subject& subject, const ClosedForm& form) : subject_(subject), form_(form) {}
    void TestBody() override {
        ASSERT_NE(subject_.device(), nullptr) << subject_.open_error();
        Bench bench(subject_);
        form_.check(bench);
    }

  private:
    Subject& subject_;
    const ClosedForm& form_;
};

// A machine without a device must not look like one where all is well.
class OpenClIsHere : public testing::Test {
  public:
    void TestBody() override {
        EXPECT_FALSE(find_subjects("opencl").empty())
            << "no OpenCL device: install one (pocl-opencl-icd runs on any CPU), or set "
               "PLAIT_TEST_ALLOW_NO_OPENCL=1 to test the reference alone";
    }
};

template <typename Test, typename What>
void add(Subject& subject, const std::string& name, const What& what) {
    testing::RegisterTest(
        subject.name().c_str(), name.c_str(), nullptr, nullptr, __FILE__, __LINE__,
        [&subject, &what]() -> testing::Test* { return new Test(subject, what); });
}

void add_all(Subject& subject) {
    for (const Case& stage_case : cases::all_cases()) {
        const std::string stage = plait_stage_describe(stage_case.stage)->name;
        add<Agrees>(subject, stage, stage_case);
        add<Notices>(subject, stage + "_notices", stage_case);
        const std::string params = plait_stage_describe(stage_case.stage)->params_type;
        // a direction from an edge of a mesh half a millimetre off turns by more than a device may
        if (subject.name() == "reference" && params == "plait_lane_params" &&
            stage_case.stage != PLAIT_STAGE_mesh_nearest)
            add<KeepsClear>(subject, stage + "_keeps_clear", stage_case);
    }
    for (const auto* forms : {&strand_closed_forms(), &grid_closed_forms(), &energy_closed_forms(),
                              &section_closed_forms(), &air_closed_forms(), &volume_closed_forms(),
                              &mesh_closed_forms()})
        for (const ClosedForm& form : *forms)
            add<Solves>(subject, form.name, form);
}

} // namespace
} // namespace plait::conformance

int main(int argc, char** argv) {
    using namespace plait;
    using namespace plait::conformance;
    testing::InitGoogleTest(&argc, argv);
    const std::string wanted = environment("PLAIT_TEST_DEVICE");
    const bool may_lack = environment("PLAIT_TEST_ALLOW_NO_OPENCL") == "1";
    std::vector<Subject> subjects = find_subjects(wanted);
    if (subjects.empty()) {
        std::printf("no device contains \"%s\": nothing to test\n", wanted.c_str());
        return may_lack ? 77 : 1;
    }
    if (wanted.empty() && !may_lack)
        testing::RegisterTest("devices", "an_opencl_device_is_here", nullptr, nullptr, __FILE__,
                              __LINE__, []() -> testing::Test* { return new OpenClIsHere; });
    for (Subject& subject : subjects)
        add_all(subject);
    const int failed = RUN_ALL_TESTS();
    if (testing::UnitTest::GetInstance()->test_to_run_count() > 0)
        return failed;
    std::printf("no test is of this name on a device that contains \"%s\"\n", wanted.c_str());
    return 77;
}
