#include "backend/opencl/arguments.hpp"

#include "backend/opencl/errors.hpp"
#include "base/format.hpp"

#include <span>
#include <string_view>

namespace plait::opencl {
namespace {

const char* element_name(plait_element element) {
    switch (element) {
    case PLAIT_ELEMENT_FLOAT:
        return "float";
    case PLAIT_ELEMENT_FLOAT4:
        return "float4";
    case PLAIT_ELEMENT_REAL:
        return "real";
    default:
        return "uint";
    }
}

std::string expected_buffer(const plait_stage_arg& arg) {
    if (arg.access == PLAIT_ACCESS_LOCAL)
        return format("__local %s* %s", element_name(arg.element), arg.name);
    return format("__global %s%s* %s", arg.access == PLAIT_ACCESS_READ ? "const " : "",
                  element_name(arg.element), arg.name);
}

cl_int query_text(cl_kernel kernel, cl_uint index, cl_kernel_arg_info what, std::string& text) {
    size_t size = 0;
    cl_int code = clGetKernelArgInfo(kernel, index, what, 0, nullptr, &size);
    if (code != CL_SUCCESS)
        return code;
    text.resize(size);
    code = clGetKernelArgInfo(kernel, index, what, size, text.data(), nullptr);
    text.resize(text.find('\0') == text.npos ? text.size() : text.find('\0'));
    return code;
}

const char* address_text(cl_kernel_arg_address_qualifier address) {
    switch (address) {
    case CL_KERNEL_ARG_ADDRESS_GLOBAL:
        return "__global ";
    case CL_KERNEL_ARG_ADDRESS_LOCAL:
        return "__local ";
    case CL_KERNEL_ARG_ADDRESS_CONSTANT:
        return "__constant ";
    default:
        return "";
    }
}

// Compilers differ in spaces and in whether the words struct and unsigned int appear.
std::string plain_type(std::string type) {
    std::erase(type, ' ');
    constexpr std::string_view structure = "struct", unsigned_int = "unsignedint";
    if (type.starts_with(structure))
        type.erase(0, structure.size());
    if (type.starts_with(unsigned_int))
        type.replace(0, unsigned_int.size(), "uint");
    return type;
}

cl_int found_argument(cl_kernel kernel, cl_uint index, std::string& text) {
    std::string name, type;
    cl_kernel_arg_address_qualifier address = 0;
    cl_kernel_arg_type_qualifier qualifier = 0;
    for (const cl_int code : {query_text(kernel, index, CL_KERNEL_ARG_NAME, name),
                              query_text(kernel, index, CL_KERNEL_ARG_TYPE_NAME, type),
                              clGetKernelArgInfo(kernel, index, CL_KERNEL_ARG_ADDRESS_QUALIFIER,
                                                 sizeof address, &address, nullptr),
                              clGetKernelArgInfo(kernel, index, CL_KERNEL_ARG_TYPE_QUALIFIER,
                                                 sizeof qualifier, &qualifier, nullptr)})
        if (code != CL_SUCCESS)
            return code;
    text = format("%s%s%s %s", address_text(address),
                  qualifier & CL_KERNEL_ARG_TYPE_CONST ? "const " : "", plain_type(type).c_str(),
                  name.c_str());
    return CL_SUCCESS;
}

Error mismatch(const plait_stage_info& stage, const std::string& file, const std::string& text) {
    return {PLAIT_COMPILE, format("kernel %s in %s: %s", stage.kernel, file.c_str(), text.c_str())};
}

} // namespace

std::vector<std::string> expected_arguments(const plait_stage_info& stage) {
    std::vector<std::string> list{"uint item_count", format("%s params", stage.params_type)};
    for (const plait_stage_arg& arg : std::span(stage.args, stage.arg_count))
        list.push_back(expected_buffer(arg));
    return list;
}

Status check_arguments(cl_kernel kernel, const plait_stage_info& stage, const std::string& file) {
    const auto expected = expected_arguments(stage);
    cl_uint count = 0;
    if (const cl_int code =
            clGetKernelInfo(kernel, CL_KERNEL_NUM_ARGS, sizeof count, &count, nullptr))
        return failure(code, "clGetKernelInfo");
    if (count != expected.size())
        return mismatch(stage, file,
                        format("expected %zu arguments, found %u", expected.size(), count));
    for (cl_uint index = 0; index < count; ++index) {
        std::string found;
        const cl_int code = found_argument(kernel, index, found);
        if (code == CL_KERNEL_ARG_INFO_NOT_AVAILABLE)
            return Error{PLAIT_UNSUPPORTED,
                         format("kernel %s: the driver keeps no argument information; only the "
                                "number of arguments was checked",
                                stage.kernel)};
        if (code != CL_SUCCESS)
            return failure(code, "clGetKernelArgInfo");
        if (found != expected[index])
            return mismatch(stage, file,
                            format("argument %u: expected `%s`, found `%s`", index,
                                   expected[index].c_str(), found.c_str()));
    }
    return {};
}

} // namespace plait::opencl
