// OpenCL does not promise that a struct is laid out as on the host: ask every device for the size
// and offset of every field of params.h, and pass every struct by value and look at its bytes.
#include "support.hpp"

#include "backend/opencl/build.hpp"
#include "backend/opencl/errors.hpp"
#include "backend/opencl/source.hpp"
#include "base/format.hpp"

#include <cstddef>
#include <numeric>

namespace plait::opencl {
namespace {

struct Field {
    std::string name;
    size_t offset;
    size_t size;
};

struct Struct {
    std::string name;
    size_t size;
    std::vector<Field> fields;
};

// From fields.inc, which list_fields.cmake writes from params.h.
std::vector<Struct> structs_of_host() {
    std::vector<Struct> list;
    std::vector<Field> fields;
#define PLAIT_FIELD(type, field)                                                                   \
    fields.push_back({#field, offsetof(type, field), sizeof(type::field)});
#define PLAIT_FIELDS_OF(type) list.push_back({#type, sizeof(type), std::exchange(fields, {})});
#include "fields.inc"
#undef PLAIT_FIELD
#undef PLAIT_FIELDS_OF
    return list;
}

// table: size of the struct, then offset and size of each field; bytes: the argument as it arrived.
std::string probe_text(const Struct& host) {
    const char* type = host.name.c_str();
    std::string text = format("#include <plait/params.h>\n"
                              "__kernel void probe(%s params, __global uint* table, "
                              "__global uchar* bytes) {\n    *table++ = sizeof(%s);\n",
                              type, type);
    for (const Field& field : host.fields) {
        const char* name = field.name.c_str();
        text += format("    *table++ = (uint)((uchar*)&params.%s - (uchar*)&params);\n"
                       "    *table++ = sizeof(params.%s);\n",
                       name, name);
    }
    return text + format("    for (uint i = 0; i < sizeof(%s); ++i)\n"
                         "        bytes[i] = ((uchar*)&params)[i];\n}\n",
                         type);
}

std::vector<cl_uint> table_of_host(const Struct& host) {
    std::vector<cl_uint> table{static_cast<cl_uint>(host.size)};
    for (const Field& field : host.fields) {
        table.push_back(static_cast<cl_uint>(field.offset));
        table.push_back(static_cast<cl_uint>(field.size));
    }
    return table;
}

class Layout : public OnDevice {
  protected:
    void SetUp() override {
        candidate_ = find_devices().usable[GetParam()];
        cl_int code = CL_SUCCESS;
        context_ =
            Context(clCreateContext(nullptr, 1, &candidate_.device, nullptr, nullptr, &code));
        ASSERT_EQ(code, CL_SUCCESS);
        queue_ = Queue(clCreateCommandQueue(context_.get(), candidate_.device, 0, &code));
        ASSERT_EQ(code, CL_SUCCESS);
    }

    Memory buffer(size_t size) {
        cl_int code = CL_SUCCESS;
        Memory memory(clCreateBuffer(context_.get(), CL_MEM_READ_WRITE, size, nullptr, &code));
        EXPECT_EQ(code, CL_SUCCESS);
        return memory;
    }

    void read(const Memory& memory, void* dst, size_t size) {
        EXPECT_EQ(clEnqueueReadBuffer(queue_.get(), memory.get(), CL_TRUE, 0, size, dst, 0, nullptr,
                                      nullptr),
                  CL_SUCCESS);
    }

    Kernel build(const std::string& text) {
        auto source = flatten("layout.cl", text);
        EXPECT_TRUE(source.ok());
        const char* flat = source->text.c_str();
        cl_int code = CL_SUCCESS;
        const Program program(clCreateProgramWithSource(context_.get(), 1, &flat, nullptr, &code));
        code =
            clBuildProgram(program.get(), 1, &candidate_.device,
                           build_options(candidate_, PLAIT_SPACE_WORD).c_str(), nullptr, nullptr);
        EXPECT_EQ(code, CL_SUCCESS) << text;
        return Kernel(clCreateKernel(program.get(), "probe", &code));
    }

    void compare(const Struct& host) {
        std::vector<unsigned char> sent(host.size), arrived(host.size);
        std::iota(sent.begin(), sent.end(), static_cast<unsigned char>(1));
        const auto expected = table_of_host(host);
        std::vector<cl_uint> found(expected.size());
        const Memory table = buffer(found.size() * sizeof(cl_uint)), bytes = buffer(host.size);
        const cl_mem memories[] = {table.get(), bytes.get()};
        const Kernel kernel = build(probe_text(host));
        ASSERT_EQ(clSetKernelArg(kernel.get(), 0, host.size, sent.data()), CL_SUCCESS);
        ASSERT_EQ(clSetKernelArg(kernel.get(), 1, sizeof(cl_mem), &memories[0]), CL_SUCCESS);
        ASSERT_EQ(clSetKernelArg(kernel.get(), 2, sizeof(cl_mem), &memories[1]), CL_SUCCESS);
        const size_t one = 1;
        ASSERT_EQ(clEnqueueNDRangeKernel(queue_.get(), kernel.get(), 1, nullptr, &one, &one, 0,
                                         nullptr, nullptr),
                  CL_SUCCESS);
        read(table, found.data(), found.size() * sizeof(cl_uint));
        read(bytes, arrived.data(), arrived.size());
        EXPECT_EQ(found, expected) << "size of struct, then offset and size of each field";
        EXPECT_EQ(arrived, sent) << "passed by value";
    }

  private:
    Candidate candidate_{};
    Context context_;
    Queue queue_;
};
INSTANTIATE_TEST_SUITE_P(Devices, Layout, ::testing::ValuesIn(device_indices()), test_name);

// Only 4-byte scalars and arrays of them: so fields fill their struct, and one that the list lacks
// would leave a hole.
TEST(Fields, fill_their_structs) {
    for (const Struct& host : structs_of_host()) {
        size_t end = 0;
        for (const Field& field : host.fields) {
            EXPECT_EQ(field.offset, end) << host.name << "." << field.name;
            end = field.offset + field.size;
        }
        EXPECT_EQ(end, host.size) << host.name;
    }
}

TEST(Fields, cover_every_stage) {
    const auto host = structs_of_host();
    for (int stage = 0; stage < PLAIT_STAGE_COUNT; ++stage) {
        const plait_stage_info& info = *plait_stage_describe(static_cast<plait_stage>(stage));
        const auto found = std::ranges::find(host, info.params_type, &Struct::name);
        ASSERT_NE(found, host.end()) << info.params_type;
        EXPECT_EQ(found->size, info.params_size) << info.params_type;
    }
}

TEST_P(Layout, is_the_hosts) {
    for (const Struct& host : structs_of_host()) {
        SCOPED_TRACE(host.name);
        compare(host);
    }
}

} // namespace
} // namespace plait::opencl
