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

Argument expected_buffer(const plait_stage_arg& arg) {
    const char* address = arg.access == PLAIT_ACCESS_LOCAL  ? "__local "
                          : arg.access == PLAIT_ACCESS_READ ? "__global const "
                                                            : "__global ";
    return {address, std::string(element_name(arg.element)) + "*", arg.name};
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

cl_int found_argument(cl_kernel kernel, cl_uint index, Argument& found) {
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
    found.address = address_text(address);
    found.address += qualifier & CL_KERNEL_ARG_TYPE_CONST ? "const " : "";
    found.type = plain_type(type);
    found.name = name;
    return CL_SUCCESS;
}

Error mismatch(const plait_stage_info& stage, const std::string& file, const std::string& text) {
    return {PLAIT_COMPILE, format("kernel %s in %s: %s", stage.kernel, file.c_str(), text.c_str())};
}

// Could an argument of another stage, or another argument of this one, be of this type?
bool names_a_type(const std::string& type) {
    for (const plait_element element : {PLAIT_ELEMENT_FLOAT4, PLAIT_ELEMENT_UINT})
        if (type == std::string(element_name(element)) + "*")
            return true;
    for (int stage = 0; stage < PLAIT_STAGE_COUNT; ++stage)
        if (type == plait_stage_describe(static_cast<plait_stage>(stage))->params_type)
            return true;
    return type == "uint" || type == "float*" || type == "real*";
}

// A vector of as many floats as there are lanes.
bool is_real(const std::string& type) {
    return type == "float*" || type == "float4*" || type == "float8*" || type == "float16*";
}

} // namespace

std::vector<Argument> expected_arguments(const plait_stage_info& stage) {
    std::vector<Argument> list{{"", "uint", "item_count"}, {"", stage.params_type, "params"}};
    for (const plait_stage_arg& arg : std::span(stage.args, stage.arg_count))
        list.push_back(expected_buffer(arg));
    return list;
}

Match match(const Argument& expected, const Argument& found) {
    if (found.address != expected.address || found.name != expected.name)
        return Match::other;
    if (found.type == expected.type)
        return Match::same;
    const bool looked_through = expected.type == "real*" && is_real(found.type);
    return looked_through || !names_a_type(found.type) ? Match::spelled : Match::other;
}

Result<std::vector<std::string>> check_arguments(cl_kernel kernel, const plait_stage_info& stage,
                                                 const std::string& file) {
    const auto expected = expected_arguments(stage);
    std::vector<std::string> unchecked;
    cl_uint count = 0;
    if (const cl_int code =
            clGetKernelInfo(kernel, CL_KERNEL_NUM_ARGS, sizeof count, &count, nullptr))
        return failure(code, "clGetKernelInfo");
    if (count != expected.size())
        return mismatch(stage, file,
                        format("expected %zu arguments, found %u", expected.size(), count));
    for (cl_uint index = 0; index < count; ++index) {
        Argument found;
        const cl_int code = found_argument(kernel, index, found);
        if (code == CL_KERNEL_ARG_INFO_NOT_AVAILABLE)
            return std::vector{format("kernel %s: the driver keeps no argument information; only "
                                      "the number of arguments was checked",
                                      stage.kernel)};
        if (code != CL_SUCCESS)
            return failure(code, "clGetKernelArgInfo");
        const Match matched = match(expected[index], found);
        const std::string text = format("argument %u: expected `%s`, found `%s`", index,
                                        expected[index].text().c_str(), found.text().c_str());
        if (matched == Match::other)
            return mismatch(stage, file, text);
        if (matched == Match::spelled)
            unchecked.push_back(format("kernel %s in %s: %s, which the driver may spell so",
                                       stage.kernel, file.c_str(), text.c_str()));
    }
    return unchecked;
}

} // namespace plait::opencl
