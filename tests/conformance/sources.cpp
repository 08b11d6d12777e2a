// A user's own kernel for a stage: built when the device is opened, refused with a reason.
#include "support.hpp"

namespace plait::opencl {
namespace {

constexpr char good[] = "#include <plait/params.h>\n"
                        "__kernel void plait_grid_clear(uint item_count,\n"
                        "                               plait_grid_clear_params params,\n"
                        "                               __global uint* words) {\n"
                        "    if (get_global_id(0) < item_count)\n"
                        "        words[get_global_id(0)] = params.value + 1u;\n"
                        "}\n";

class Sources : public OnDevice {
  protected:
    Error refusal(const char* stage, const std::string& source) {
        const auto device = open_device(
            GetParam(), {.sources = {{stage, source.c_str(), "mine.cl"}}, .log = &log_});
        EXPECT_FALSE(device.ok());
        return device.ok() ? Error{} : device.error();
    }

    static std::string replaced(std::string text, const std::string& from, const std::string& to) {
        EXPECT_NE(text.find(from), text.npos);
        return text.replace(text.find(from), from.size(), to);
    }

    std::string log_;
};
INSTANTIATE_TEST_SUITE_P(Devices, Sources, ::testing::ValuesIn(device_indices()), test_name);

void expect_holds(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), text.npos) << "`" << part << "` is not in:\n" << text;
}

TEST_P(Sources, replace_the_built_in_kernel) {
    auto device = open_device(GetParam(), {.sources = {{"grid_clear", good, nullptr}}});
    ASSERT_TRUE(device.ok()) << device.error().message;
    auto words = (*device)->create({PLAIT_ELEMENT_UINT, 3, "words"});
    ASSERT_TRUE(words.ok());
    const plait_grid_clear_params params{41};
    plait_buffer* const buffers[] = {reinterpret_cast<plait_buffer*>(words->get())};
    const plait_dispatch dispatch{PLAIT_STAGE_grid_clear, 3, 1,       &params,
                                  sizeof params,          1, buffers, 0};
    ASSERT_TRUE((*device)->submit({&dispatch, 1}).ok());
    uint32_t read[3] = {};
    ASSERT_TRUE((*device)->read(**words, 0, 3, read).ok());
    EXPECT_EQ(read[0], 42u);
    EXPECT_EQ(read[2], 42u);
}

TEST_P(Sources, a_build_failure_tells_file_line_and_the_compilers_words) {
    const Error error = refusal("grid_clear", replaced(good, "params.value", "params.valu"));
    EXPECT_EQ(error.code, PLAIT_COMPILE);
    expect_holds(error.message, "stage grid_clear");
    expect_holds(error.message, "mine.cl:6:");
    expect_holds(error.message, "valu");
    expect_holds(log_, error.message);
}

TEST_P(Sources, a_failure_inside_an_include_names_the_included_file) {
    const std::string source = std::string("#define pose_load )\n"
                                           "#include \"base/pose.clh\"\n") +
                               good;
    expect_holds(refusal("grid_clear", source).message, "cl/base/pose.clh:");
}

TEST_P(Sources, an_unknown_include_is_refused_with_its_place) {
    const Error error =
        refusal("grid_clear", std::string("\n#include \"nowhere.clh\"\n").append(good));
    EXPECT_EQ(error.code, PLAIT_COMPILE);
    expect_holds(error.message, "mine.cl:2: error: #include \"nowhere.clh\"");
}

TEST_P(Sources, a_wrong_argument_is_named_with_expected_and_found) {
    const Error type =
        refusal("grid_clear", replaced(good, "__global uint* w", "__global float* w"));
    EXPECT_EQ(type.code, PLAIT_COMPILE);
    expect_holds(type.message,
                 "argument 2: expected `__global uint* words`, found `__global float* words`");
    const Error name =
        refusal("grid_clear", replaced(replaced(good, "uint item_count", "uint items"),
                                       "< item_count", "< items"));
    expect_holds(name.message, "argument 0: expected `uint item_count`, found `uint items`");
    const Error access = refusal(
        "grid_clear", replaced(replaced(good, "__global uint*", "__global const uint*"),
                               "words[get_global_id(0)] = params.value + 1u", "(void)words"));
    expect_holds(access.message, "found `__global const uint* words`");
}

// PoCL tells an alias's own name, others the type behind it: neither is a reason to refuse.
TEST_P(Sources, an_alias_for_a_type_is_taken) {
    const std::string source = replaced(replaced(good, "__global uint* w", "__global word* w"),
                                        "__kernel", "typedef uint word;\n__kernel");
    const auto device = open_device(
        GetParam(), {.sources = {{"grid_clear", source.c_str(), "mine.cl"}}, .log = &log_});
    ASSERT_TRUE(device.ok()) << device.error().message;
    const bool told = log_.find("found `__global word* words`") != log_.npos;
    EXPECT_EQ(told, log_.find("the driver may spell") != log_.npos) << log_;
}

TEST_P(Sources, a_wrong_number_of_arguments_is_refused) {
    const Error error =
        refusal("grid_clear", replaced(good, "uint* words)", "uint* words, uint more)"));
    EXPECT_EQ(error.code, PLAIT_COMPILE);
    expect_holds(error.message, "expected 3 arguments, found 4");
}

TEST_P(Sources, a_missing_kernel_is_refused) {
    expect_holds(refusal("tangents", good).message,
                 "mine.cl defines no kernel named plait_tangents");
}

TEST_P(Sources, an_unknown_stage_is_refused_with_those_there_are) {
    const Error error = refusal("tangent", good);
    EXPECT_EQ(error.code, PLAIT_INVALID_ARGUMENT);
    expect_holds(error.message, "\"tangent\"");
    expect_holds(error.message, "tangents");
}

} // namespace
} // namespace plait::opencl
